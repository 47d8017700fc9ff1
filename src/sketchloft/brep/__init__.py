"""The kernel room: solids from skins and primitives, their checks, triangles and files.

It is the only room that imports the CAD kernel (OCP), which takes half a second; importing this package
alone, or its `format` and `model`, does not.
"""
