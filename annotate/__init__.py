"""Label skylines in the browser: the detector proposes, a few clicks correct, nothing is lost.

The engine works without any server:

    wire = LiveWire(photo, Detector())
    wire.anchor(column, row)
    wire.skyline.rows
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
