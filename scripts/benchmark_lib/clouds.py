"""Point clouds without order as PCD files."""

import numpy as np

from .programs import BenchmarkError


def write_cloud(points, path):
    """points: n x 3, as float."""
    head = (
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n"
    )
    path.write_bytes(head.encode() + points.astype("<f4").tobytes())


def read_cloud(path):
    """The points of a binary file all of whose fields are floats; n x 3, in the file's unit."""
    head, marker, body = path.read_bytes().partition(b"DATA binary\n")
    entries = {}
    for line in head.decode("ascii", errors="replace").splitlines():
        key, _, value = line.partition(" ")
        entries[key] = value.split()
    fields = entries.get("FIELDS", [])
    simple = set(entries.get("SIZE", [])) == {"4"} and set(entries.get("TYPE", [])) == {"F"}
    simple = simple and set(entries.get("COUNT", "1")) == {"1"} and bool(marker)
    points = int(entries.get("POINTS", ["0"])[0])
    if fields[:3] != ["x", "y", "z"] or not simple or len(body) != points * len(fields) * 4:
        raise BenchmarkError(f"{path} is no whole binary PCD file of floats that begin with x y z.")
    return np.frombuffer(body, "<f4").reshape(-1, len(fields))[:, :3].astype(float)
