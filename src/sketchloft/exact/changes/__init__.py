"""Changes: what a stack could be instead, and whether it explains the points better than it costs."""
