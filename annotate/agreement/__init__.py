"""What comes after labelling: how far passes agree, and what they have in common."""
