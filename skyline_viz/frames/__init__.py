"""What of a photo shows a skyline: frames around pictures, and where a line can be seen."""
