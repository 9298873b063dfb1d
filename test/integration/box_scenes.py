"""Parts made of boxes: their part files, and what a depth camera sees of them. No ROS master needed."""
import os
import struct

import numpy as np

# Corners of touching boxes [mm]; steps and tower have no symmetry.
PARTS = {
    "steps": [
        ((0, 0, 0), (60, 40, 10)),
        ((0, 0, 10), (20, 40, 30)),
        ((40, 0, 10), (60, 15, 20)),
    ],
    "tower": [
        ((0, 0, 0), (50, 30, 12)),
        ((8, 0, 12), (20, 20, 45)),
        ((20, 5, 12), (42, 15, 24)),
    ],
    "crumb": [((0, 0, 0), (8, 6, 5))],
}
FLOOR_M = 0.5  # distance of the plane that the parts lie on
# The box above the floor, camera frame.
REGION = {"min": [-0.15, -0.15, 0.3], "max": [0.15, 0.15, 0.498]}


def write_part(folder, name, text="unit: mm\n"):
    """Writes the mesh and the part file of a part; returns the part file's path."""
    os.makedirs(folder, exist_ok=True)
    facets = [facet for box in PARTS[name] for facet in _facets(*box)]
    with open(os.path.join(folder, name + ".stl"), "wb") as out:
        out.write(b"made of boxes".ljust(80) + struct.pack("<I", len(facets)))
        for facet in facets:
            normal = np.cross(facet[1] - facet[0], facet[2] - facet[0])
            normal /= np.linalg.norm(normal)
            out.write(struct.pack("<12fH", *normal, *facet.ravel(), 0))
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w") as out:
        out.write("mesh: %s.stl\n" % name + text)
    return path


def _facets(low, high):
    """The twelve outward triangles of a box."""
    for axis in range(3):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        for side in (low, high):
            corners = np.zeros((4, 3))
            corners[:, axis] = side[axis]
            corners[:, a] = [low[a], high[a], high[a], low[a]]
            corners[:, b] = [low[b], low[b], high[b], high[b]]
            if side is low:
                corners = corners[::-1]
            yield corners[[0, 1, 2]]
            yield corners[[0, 2, 3]]


def lying(x_m, y_m, turn_rad):
    """T_camera_model of a part that lies on the floor, its z axis towards the camera."""
    c, s = np.cos(turn_rad), np.sin(turn_rad)
    pose = np.eye(4)
    pose[:3, :3] = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.diag([1, -1, -1])
    pose[:3, 3] = [x_m, y_m, FLOOR_M]
    return pose


def scan(placed, width=320, height=240, floor_m=FLOOR_M):
    """Points of the floor and of (name, T_camera_model) on it: float32 [height, width, 3], metres."""
    focal = 1.25 * width
    v, u = np.mgrid[:height, :width]
    rays = np.dstack([(u - width / 2) / focal, (v - height / 2) / focal, np.ones(u.shape)])
    rays = rays.reshape(-1, 3)
    depth = np.full(len(rays), floor_m)
    for name, pose in placed:
        inverse = np.linalg.inv(pose)
        rays_model = rays @ inverse[:3, :3].T
        for low, high in PARTS[name]:
            with np.errstate(divide="ignore", invalid="ignore"):
                a = (np.array(low) * 1e-3 - inverse[:3, 3]) / rays_model
                b = (np.array(high) * 1e-3 - inverse[:3, 3]) / rays_model
            near, far = np.minimum(a, b).max(axis=1), np.maximum(a, b).min(axis=1)
            hit = (near <= far) & (near > 0) & (near < depth)
            depth[hit] = near[hit]
    return (rays * depth[:, None]).astype("<f4").reshape(height, width, 3)
