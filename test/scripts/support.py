"""What several tests of scripts need."""

import numpy as np

from benchmark_lib.meshes import FACET


def write_part(folder, corners_mm):
    """A part of one triangle: part.yaml and its mesh."""
    facets = np.zeros(1, FACET)
    facets["corners"] = [corners_mm]
    (folder / "model.stl").write_bytes(bytes(84) + facets.tobytes())
    (folder / "part.yaml").write_text("unit: mm\n")
