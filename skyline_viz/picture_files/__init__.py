"""Picture files of every kind, read exactly: a module for each thing that can be odd about one."""
