"""What docs/scale.md says of many photos.

``python -m benchmarks.scale`` for lines, ``python -m benchmarks.scale.sky`` for a sky model.
"""
