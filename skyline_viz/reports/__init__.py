"""Reports to be mailed: photos with what was found and why, as one HTML file that needs nothing."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
