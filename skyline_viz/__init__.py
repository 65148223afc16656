"""skyline-viz: look inside a mountain-skyline detector.

    import skyline_viz as sv
    photo = sv.read_photo("photo.jpg")
    detection = sv.Detector().detect(photo)
    detection.skyline.rows

The public names stand in ``__init__.pyi``, each with its module. They are loaded when first used,
so that ``import skyline_viz`` costs nothing.
"""

import lazy_loader

from skyline_viz._version import __version__ as __version__

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
