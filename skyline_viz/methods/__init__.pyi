from .registry import find_method as find_method
