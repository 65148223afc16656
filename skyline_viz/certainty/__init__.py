"""How sure a line is: column by column, beside other lines, and as a whole."""
