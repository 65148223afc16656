"""Labels of a damaged folder: what can be read is saved."""
