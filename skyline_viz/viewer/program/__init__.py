"""The Rerun viewer as a program: started, served, filled, photographed, and ended."""
