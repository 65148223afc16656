"""How a method is found by what somebody calls it: a name, a file, or a class of theirs."""
