"""The model of the exact method: a stack of walls with the noise and the density of the cloud."""
