"""The earlier methods, each in a file, behind the protocol of `methods.protocol`."""
