"""Maps of values as Rerun entities: which, how exactly, and with what aids to read them."""
