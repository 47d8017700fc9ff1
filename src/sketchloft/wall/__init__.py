"""Walls: the surfaces that bound a run between two heights, one family a file."""
