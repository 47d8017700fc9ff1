"""The fit: how likely the points are, and the climb to where they are most likely."""
