"""Who may ask for what: the application, its routes, and what guards them."""
