"""The earlier methods, each in a file, and how methods are named, kept and brought along."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
