"""What all commands share: options, messages, exit codes. The commands are in `commands`."""
