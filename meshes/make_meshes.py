#!/usr/bin/python3
"""Makes the meshes of this folder: binary STL, millimetres, closed, wound outwards.

Run it in any folder to write the files there. Each part is a signed distance function (negative
inside), turned into triangles by surface nets, or a profile turned about the z axis.
"""
import numpy as np


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


def check(triangles):
    """Each edge is used exactly once in each direction: closed and wound alike."""
    _, index = np.unique(triangles.astype("<f4").reshape(-1, 3), axis=0, return_inverse=True)
    corner = index.reshape(-1, 3)
    edges = np.concatenate([corner[:, [0, 1]], corner[:, [1, 2]], corner[:, [2, 0]]])
    unique = np.unique(edges, axis=0)
    if len(unique) != len(edges) or len(np.unique(np.sort(edges), axis=0)) * 2 != len(edges):
        raise RuntimeError("the surface is not closed: change the step of the grid")
    if np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() < 0:
        raise RuntimeError("the surface is wound inwards: turn the triangles around")


def write_stl(name, triangles):
    check(triangles)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    record = np.zeros(len(triangles), dtype=[("numbers", "<f4", (4, 3)), ("attribute", "<u2")])
    record["numbers"] = np.concatenate([normals[:, None], triangles], axis=1)
    with open(name, "wb") as file:
        file.write(b"made by make_meshes.py, unit mm".ljust(80, b" "))
        file.write(np.uint32(len(triangles)).tobytes())
        file.write(record.tobytes())
    size = np.ptp(triangles.reshape(-1, 3), axis=0)
    print(f"{name}: {len(triangles)} triangles, {size.round(1)} mm")


if __name__ == "__main__":
    write_stl("bracket.stl", surface_nets(bracket, (-40, -24, -4), (40, 24, 58), 2))
    write_stl("tee.stl", surface_nets(tee, (-34, -16, -16), (34, 16, 34), 2))
    write_stl("bolt.stl", lathe(BOLT_PROFILE))
