"""Data sets on disk: their layouts, and the ground truth in files of every kind."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
