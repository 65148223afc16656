"""What is kept: labels, their history, and which photo each belongs to."""
