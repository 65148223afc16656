"""All that logs to Rerun, its layouts, and the viewers that show it."""
