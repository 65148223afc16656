"""What the project needs of the machine: names, memory, files that end well. Knows no photo."""
