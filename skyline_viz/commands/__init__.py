"""The commands of ``skyline-viz``, a module each: a frozen dataclass of options with a ``run``.

Importing one is cheap, so that help is instant; what detects and draws is imported by ``run``.
"""
