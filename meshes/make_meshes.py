#!/usr/bin/python3
"""Makes the meshes of this folder: binary STL, millimetres, closed, wound outwards.

Run it in any folder to write the files there; names of parts as arguments make these alone. A part
is a signed distance function (negative inside), turned into triangles by surface nets, a profile
turned about the z axis, or a solid that OpenSCAD makes of the .scad file beside this script.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import yaml

FOLDER = Path(__file__).resolve().parent
SYMMETRY_TOLERANCE = 0.05  # a turn that maps the part onto itself may be off by so much


def length(x, y):
    return np.sqrt(x * x + y * y)


def box(p, center, size, radius=0.0):
    """Distance to a box whose edges are rounded by radius."""
    q = np.abs(p - np.array(center)) - np.array(size) / 2 + radius
    return np.linalg.norm(np.maximum(q, 0), axis=-1) + np.minimum(q.max(axis=-1), 0) - radius


def cylinder(p, center, axis, radius, height, edge=0.0):
    """Distance to a cylinder along a coordinate axis whose rims are rounded by edge."""
    q = p - np.array(center)
    across = [k for k in range(3) if k != axis]
    radial = length(q[..., across[0]], q[..., across[1]]) - radius + edge
    along = np.abs(q[..., axis]) - height / 2 + edge
    outside = length(np.maximum(radial, 0), np.maximum(along, 0))
    return outside + np.minimum(np.maximum(radial, along), 0) - edge


def blend(a, b, radius):
    """Union with a fillet of about the given radius."""
    h = np.maximum(radius - np.abs(a - b), 0) / radius
    return np.minimum(a, b) - h * h * radius / 4


def cut(a, b):
    """a without b, the rims rounded."""
    return -blend(-a, b, 3)


def bracket(p):
    """An asymmetric casting: foot with a bored boss, upright with an ear, one rib."""
    foot = box(p, (0, 0, 4), (72, 38, 8), 2)
    upright = box(p, (-31, 2, 20), (9, 34, 40), 2)
    ear = cylinder(p, (-31, 9, 42), 0, 11, 13, 2)
    boss = cylinder(p, (17, -4, 9), 2, 11, 18, 2)
    x, z = p[..., 0], p[..., 2]
    slope = (x + 0.9 * z - 4) / np.sqrt(1 + 0.9**2)
    rib = np.maximum(box(p, (-14, -9, 15), (34, 6, 30), 1), slope)
    body = blend(blend(blend(foot, upright, 5), ear, 5), boss, 4)
    body = blend(body, rib, 3)
    body = cut(body, cylinder(p, (17, -4, 9), 2, 5.5, 40))
    return cut(body, cylinder(p, (-31, 9, 42), 0, 5, 40))


def tee(p):
    """A pipe fitting: straight run along x, branch along z, a collar at each end."""
    run = cylinder(p, (0, 0, 0), 0, 10, 62, 2)
    branch = cylinder(p, (0, 0, 15), 2, 9, 30, 1)
    body = blend(run, branch, 4)
    for side in (-1, 1):
        body = blend(body, cylinder(p, (side * 27, 0, 0), 0, 13, 9, 2), 4)
    body = blend(body, cylinder(p, (0, 0, 26), 2, 12, 9, 2), 4)
    body = cut(body, cylinder(p, (0, 0, 0), 0, 6.5, 80))
    return cut(body, cylinder(p, (0, 0, 20), 2, 6, 40))


# Radius and height of a shouldered bolt, from its tip to the top of its head.
BOLT_PROFILE = [
    (3.5, 0), (5, 1.5), (5, 26), (7, 27), (7, 44), (12, 45), (13, 46), (13, 53), (12, 54),
]  # fmt: skip


def surface_nets(distance, low, high, step):
    """Triangles of the zero set: a vertex in each cell it crosses, a quad at each edge."""
    axes = [np.arange(a, b + step, step) for a, b in zip(low, high)]
    corners = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    inside = distance(corners) < 0
    cells = np.array(inside.shape) - 1
    count = sum(
        inside[tuple(slice(o, o + n) for o, n in zip(offset, cells))].astype(int)
        for offset in np.ndindex(2, 2, 2)
    )
    crossed = (count > 0) & (count < 8)
    index = np.full(crossed.shape, -1)
    index[crossed] = np.arange(crossed.sum())
    vertices = np.argwhere(crossed) * step + np.array(low) + step / 2
    quads = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        change = np.diff(inside.astype(int), axis=axis)
        for at in np.argwhere(change != 0):
            around = [at.copy() for _ in range(4)]
            around[1][u] -= 1
            around[2][[u, v]] -= 1
            around[3][v] -= 1
            quad = [index[tuple(cell)] for cell in around]
            quads.append(quad if change[tuple(at)] < 0 else quad[::-1])
    quads = np.array(quads)
    vertices = relax(distance, vertices, quads)
    return vertices[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])]


def project(distance, points):
    """Moves points onto the zero set by Newton's method, in steps of at most half a millimetre."""
    for _ in range(6):
        shifts = 1e-3 * np.eye(3)
        slope = np.stack([distance(points + s) - distance(points - s) for s in shifts], -1) / 2e-3
        square = np.maximum((slope**2).sum(-1), 0.25)
        points = points - (np.clip(distance(points), -0.5, 0.5) / square)[:, None] * slope
    return points


def relax(distance, vertices, quads):
    """Spreads the vertices evenly over the surface: to the mean of the neighbours, and back."""
    links = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    valence = np.bincount(links[:, 0], minlength=len(vertices))[:, None]
    for _ in range(6):
        mean = np.zeros_like(vertices)
        np.add.at(mean, links[:, 0], vertices[links[:, 1]])
        vertices = project(distance, (vertices + mean / valence) / 2)
    return vertices


def lathe(profile, segments=48):
    """Triangles of a profile turned about z, closed by a disc at each end."""
    angle = 2 * np.pi * np.arange(segments) / segments
    rings = [
        np.stack([r * np.cos(angle), r * np.sin(angle), np.full(segments, float(z))], -1)
        for r, z in profile
    ]
    triangles = []
    for i in range(segments):
        j = (i + 1) % segments
        for lower, upper in zip(rings, rings[1:]):
            triangles += [(lower[i], lower[j], upper[j]), (lower[i], upper[j], upper[i])]
        triangles.append(((0, 0, profile[0][1]), rings[0][j], rings[0][i]))
        triangles.append(((0, 0, profile[-1][1]), rings[-1][i], rings[-1][j]))
    return np.array(triangles, dtype=float)


def solid(name):
    """Triangles of the solid that OpenSCAD makes of a .scad file of this folder, in a fixed order."""
    with tempfile.TemporaryDirectory() as folder:
        off = Path(folder) / "solid.off"
        subprocess.run(["openscad", "--quiet", "-o", off, FOLDER / f"{name}.scad"], check=True)
        numbers = off.read_text().split()
    vertex_count, face_count = int(numbers[1]), int(numbers[2])
    end = 4 + 3 * vertex_count
    vertices = np.array(numbers[4:end], dtype=float).reshape(-1, 3)
    faces = np.array(numbers[end : end + 4 * face_count], dtype=int).reshape(-1, 4)
    if (faces[:, 0] != 3).any():
        raise RuntimeError(f"{name}: a face is no triangle")
    corners = np.sort(faces[:, 1:], axis=1)
    whole = (np.diff(corners, axis=1) > 0).all(axis=1)  # a turned profile has others on its axis
    triangles = vertices[faces[whole, 1:]] + 0.0  # no negative zeros
    return triangles[np.lexsort(triangles.reshape(-1, 9).T)]


def volume(triangles):
    """Negative if the triangles are wound inwards."""
    return np.linalg.det(triangles).sum() / 6


def check(triangles):
    """Each edge is used exactly once in each direction: closed and wound alike. No triangle is
    without area."""
    longest = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).max(axis=1)
    area = np.linalg.norm(np.cross(*np.moveaxis(triangles[:, 1:] - triangles[:, :1], 1, 0)), axis=1)
    if (area < 1e-4 * longest).any():
        raise RuntimeError("a triangle has no area")
    _, index = np.unique(triangles.astype("<f4").reshape(-1, 3), axis=0, return_inverse=True)
    corner = index.reshape(-1, 3)
    edges = np.concatenate([corner[:, [0, 1]], corner[:, [1, 2]], corner[:, [2, 0]]])
    unique = np.unique(edges, axis=0)
    if len(unique) != len(edges) or len(np.unique(np.sort(edges), axis=0)) * 2 != len(edges):
        raise RuntimeError("the surface is not closed, or touches itself")
    if volume(triangles) <= 0:
        raise RuntimeError("the surface is wound inwards: turn the triangles around")


def spread(triangles, count):
    """Points spread evenly over the surface, the same at each call."""
    area = np.linalg.norm(np.cross(*np.moveaxis(triangles[:, 1:] - triangles[:, :1], 1, 0)), axis=1)
    random = np.random.default_rng(1)
    corners = triangles[random.choice(len(triangles), count, p=area / area.sum())]
    weights = random.dirichlet((1, 1, 1), count)
    return np.einsum("nk,nkj->nj", weights, corners)


def to_segment(point, start, end):
    """Distances of a point to line segments."""
    along = end - start
    share = np.einsum("ij,ij->i", point - start, along) / np.einsum("ij,ij->i", along, along)
    return np.linalg.norm(start + np.clip(share, 0, 1)[:, None] * along - point, axis=1)


def distance_to(triangles, point):
    """Distance of a point to the surface: to each triangle's plane where the point lies above the
    triangle, and to each edge."""
    a, b, c = np.moveaxis(triangles, 1, 0)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    above = np.ones(len(a), bool)
    for start, end in ((a, b), (b, c), (c, a)):
        above &= np.einsum("ij,ij->i", np.cross(normal, end - start), point - start) >= 0
    height = np.abs(np.einsum("ij,ij->i", normal, point - a))
    edges = [to_segment(point, *ends).min() for ends in ((a, b), (b, c), (c, a))]
    return min(height[above].min(initial=np.inf), *edges)


def turned(points, symmetry, angle):
    """Points turned about a symmetry's line."""
    axis = np.array(symmetry["axis"], float) / np.linalg.norm(symmetry["axis"])
    rest = points - np.array(symmetry.get("point", (0, 0, 0)), float)
    along = np.outer(rest @ axis, axis)
    cosine, sine = np.cos(angle), np.sin(angle)
    return points + (cosine - 1) * (rest - along) + sine * np.cross(axis, rest)


def check_symmetries(name, triangles):
    """The turns that the part file names map the surface onto itself. Returns the largest error."""
    part = yaml.safe_load((FOLDER.parent / f"config/parts/{name}.yaml").read_text())
    turns = [(s, np.radians(s["angle_deg"])) for s in part.get("symmetries_discrete", [])]
    turns += [(s, angle) for s in part.get("symmetries_continuous", []) for angle in (0.4, 1, 2.5)]
    points = spread(triangles, 1000)
    worst = 0
    for symmetry, angle in turns:
        moved = turned(points, symmetry, angle)
        error = max(distance_to(triangles, point) for point in moved)
        if error > SYMMETRY_TOLERANCE:
            raise RuntimeError(f"{name}: a turn about {symmetry} is off by {error:.3f} mm")
        worst = max(worst, error)
    return worst


def write_stl(name, triangles):
    check(triangles)
    error = check_symmetries(name, triangles)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    record = np.zeros(len(triangles), dtype=[("numbers", "<f4", (4, 3)), ("attribute", "<u2")])
    record["numbers"] = np.concatenate([normals[:, None], triangles], axis=1)
    with open(f"{name}.stl", "wb") as file:
        file.write(b"made by make_meshes.py, unit mm".ljust(80, b" "))
        file.write(np.uint32(len(triangles)).tobytes())
        file.write(record.tobytes())
    size = np.ptp(triangles.reshape(-1, 3), axis=0)
    print(
        f"{name}: {len(triangles)} triangles, {size.round(1)} mm, {volume(triangles):.0f} mm^3, ",
        end="",
    )
    print(f"symmetric to {error:.3f} mm")


OWN = {
    "bracket": lambda: surface_nets(bracket, (-40, -24, -4), (40, 24, 58), 2),
    "tee": lambda: surface_nets(tee, (-34, -16, -16), (34, 16, 34), 2),
    "bolt": lambda: lathe(BOLT_PROFILE),
}

if __name__ == "__main__":
    for part in sys.argv[1:] or [*OWN, *sorted(path.stem for path in FOLDER.glob("*.scad"))]:
        write_stl(part, OWN[part]() if part in OWN else solid(part))
