"""Meshes of parts as arrays."""

import numpy as np
import yaml

# A triangle of a binary STL file, after a head of 80 bytes and their number.
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
UNITS_M = {"m": 1.0, "mm": 0.001}


def read_facets(path):
    """Of a binary STL file."""
    return np.fromfile(path, dtype=FACET, offset=84)


def bounds_m(part_file):
    """Opposite corners of the box around a part, in its mesh's frame. part_file: names a binary STL file beside it."""
    part = yaml.safe_load(part_file.read_text())
    corners = read_facets(part_file.parent / part.get("mesh", "model.stl"))["corners"]
    corners = corners.reshape(-1, 3).astype(float) * UNITS_M[part["unit"]]
    return corners.min(axis=0), corners.max(axis=0)
