"""Copies of scenes whose cloud is a list of points in any order, as coarse as those of simple sensors are."""

import zlib

import numpy as np
import yaml
from PIL import Image

from benchmark_lib.clouds import write_cloud
from benchmark_lib.meshes import bounds_m

PIXELS = (26, 60)  # along the part's longest side
COPIED = ("camera.yaml", "depth.png", "gt.json", "roi.yaml")
CLOUD = "cloud.pcd"


def step_of(part_px, rng):
    """Every so many-th pixel is taken: a part of so many pixels has a number within PIXELS left, if that can be."""
    wanted_px = np.exp(rng.uniform(*np.log(PIXELS)))
    least, most = np.ceil(part_px / PIXELS[1]), np.floor(part_px / PIXELS[0])
    return int(max(1, least, min(most, round(part_px / wanted_px))))


def coarse_points(depth_m, camera, part_m, rng):
    """Every so many-th point of a depth image in random order; metres, camera frame."""
    seen = depth_m > 0
    step = step_of(part_m * camera["fx"] / np.median(depth_m[seen]), rng)
    first_row, first_column = rng.integers(0, step, 2)
    chosen = np.zeros_like(seen)
    chosen[first_row::step, first_column::step] = True
    rows, columns = np.nonzero(chosen & seen)
    z = depth_m[rows, columns]
    x = (columns - camera["cx"]) / camera["fx"] * z
    y = (rows - camera["cy"]) / camera["fy"] * z
    return rng.permutation(np.column_stack([x, y, z]))


def write_same_scene(source, folder):
    """A copy of a scene's folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in COPIED:
        (folder / name).unlink(missing_ok=True)
        (folder / name).symlink_to(source / name)


def write_coarse_scene(source, folder):
    """The same with a coarse cloud beside the depth image. The scene's place in its data set is the seed."""
    write_same_scene(source, folder)
    camera = yaml.safe_load((source / "camera.yaml").read_text())
    with Image.open(source / "depth.png") as image:
        depth_m = np.array(image) * camera["depth_unit_m"]
    seed = zlib.crc32(f"{source.parent.name}/{source.name}".encode())
    low, high = bounds_m(source.parent / "part.yaml")
    part_m = float((high - low).max())
    points = coarse_points(depth_m, camera, part_m, np.random.default_rng(seed))
    write_cloud(points, folder / CLOUD)
