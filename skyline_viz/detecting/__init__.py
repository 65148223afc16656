"""All stages in their order: what they find in a photo, and what need not be found again."""
