"""Pillow without its global pixel limit and its warnings, and libraries without their own lines."""

import contextlib
import ctypes
import logging
import threading
import warnings
from functools import cache

from PIL import Image, _imaging

for _library in ("PIL", "tifffile"):  # else they would write on stderr what we say in a sentence
    logging.getLogger(_library).addHandler(logging.NullHandler())


class QuietPillow:
    """A context in which Pillow is quiet, while at least one photo is read.

    Limit and warnings are state of the whole process, so the first reader to come puts them aside
    and the last to go puts them back.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._readers = 0
        self._undo = contextlib.ExitStack()

    def __enter__(self) -> None:
        with self._lock:
            if self._readers == 0:
                self._undo.callback(setattr, Image, "MAX_IMAGE_PIXELS", Image.MAX_IMAGE_PIXELS)
                self._undo.enter_context(warnings.catch_warnings())
                Image.MAX_IMAGE_PIXELS = None
                warnings.filterwarnings("ignore", module=r"PIL\.")
            self._readers += 1

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._readers -= 1
            if self._readers == 0:
                self._undo.close()


QUIET = QuietPillow()
"""The one of this process."""


@cache
def silence_libtiff() -> None:
    """Keep libtiff from writing lines of its own to the screen, where Pillow's can be reached."""
    try:
        libtiff = ctypes.CDLL(_imaging.__file__)
        for setter in (libtiff.TIFFSetErrorHandler, libtiff.TIFFSetWarningHandler):
            setter.restype = ctypes.c_void_p
            setter(ctypes.c_void_p(None))
    except (OSError, AttributeError):  # built in another way
        return
