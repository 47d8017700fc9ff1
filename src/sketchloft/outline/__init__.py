"""Outlines: the closed curves that sections of exact runs are bounded by, one kind a file."""
