"""A data set as a table in the viewer: the worst photos first."""
