"""The commands of ``skyline-annotate``, a module each."""
