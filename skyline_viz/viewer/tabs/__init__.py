"""The viewer's tabs: for each what it shows, and how it lies in the window."""
