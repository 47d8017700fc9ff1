"""The start: the direction, the segments along it, and the first stack."""
