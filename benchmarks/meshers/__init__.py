"""Meshers: methods of others that make triangles of a cloud, which `peers.py` compares sketchloft with."""

from meshers.alpha_shape import ALPHA_SHAPE
from meshers.half_density import HALF_DENSITY
from meshers.mesher import Mesher
from meshers.splash import SPLASH

__all__ = ["MESHERS", "Mesher"]

MESHERS: tuple[Mesher, ...] = (ALPHA_SHAPE, SPLASH, HALF_DENSITY)
