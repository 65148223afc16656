"""What of a photo shows a skyline: frames around pictures, and where the line can be seen in one."""
