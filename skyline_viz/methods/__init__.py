"""The earlier methods, each in a file, behind the protocol of `skyline_viz.method`."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
