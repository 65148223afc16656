"""The earlier methods, each in a file, behind the protocol of `skyline_viz.method`."""
