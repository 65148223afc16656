"""Frames around pictures: what they are, and how they are found."""
