"""The version, in one place: the package and its metadata have it from here."""

__version__ = "0.2.0"
