"""How a sky model learns: examples, their variations, the network, the fit.

The one folder, besides `skyline_viz.methods`, that needs torch and onnx (extra ``deep``).
"""
