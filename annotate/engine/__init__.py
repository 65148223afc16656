"""What the line is: edits, the plan that follows from them, the live wire that solves it."""
