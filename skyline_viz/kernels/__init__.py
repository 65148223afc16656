"""The loops that numpy cannot say, compiled by numba: one idea a module, plain arrays in and out.

Three habits make them fast. A loop touches few arrays, so that the compiler can prove cheaply that
they do not overlap, and works on many pixels at once. Numbers stay as narrow as their range allows.
What a row leaves behind is used while it is in the cache. No loop lets the compiler reorder sums,
unless its module says so: results are the same on every processor.
"""
