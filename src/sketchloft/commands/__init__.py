"""The commands of `sketchloft`, one file each."""
