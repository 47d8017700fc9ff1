"""Stage 6: the shapes that a section may have, one file each, and which one it gets."""
