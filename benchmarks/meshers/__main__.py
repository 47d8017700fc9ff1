"""One mesher with one setting on one cloud, as a process of its own.

    python -m meshers NAME SETTING SPACING CLOUD.npy MODEL.npz

SETTING is a place in the mesher's settings, SPACING the mean spacing of the points. Neither end imports
sketchloft, and the model is written as plain arrays, so that the time is the method's own.
"""

import sys

import numpy as np

from meshers import MESHERS

name, setting, spacing, cloud, model = sys.argv[1:]
mesher = next(one for one in MESHERS if one.name == name)
vertices, triangles = mesher.build(np.load(cloud), float(spacing), **mesher.settings[int(setting)])
np.savez(model, vertices=vertices, triangles=triangles)
