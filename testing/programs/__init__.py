"""Real programs at work: a browser, a viewer, Node, commands that are ended or meet a full disk."""
