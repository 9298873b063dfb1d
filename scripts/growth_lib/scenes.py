"""Scenes and meshes that differ in one thing: points of the cloud, parts in the bin, noise, triangles."""

import shutil

import numpy as np
import yaml
from PIL import Image

from benchmark_lib.cases import Scene
from benchmark_lib.detection import Bench
from benchmark_lib.meshes import FACET, read_facets
from benchmark_lib.scene_files import camera_text

PART = "bracket"
COUNT = 16  # parts, where these are not what differs
PRESET = "industrial"
SEED = 401


class Copy:
    """A changed copy of a scene's folder, for detect_poses."""

    def __init__(self, source, folder):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / "roi.yaml", folder / "roi.yaml")
        self.camera = yaml.safe_load((source / "camera.yaml").read_text())
        with Image.open(source / "depth.png") as image:
            self.depth = np.array(image)

    def write(self):
        """Returns the arguments that name the scene to detect_poses."""
        Image.fromarray(self.depth.astype(np.uint16)).save(self.folder / "depth.png")
        (self.folder / "camera.yaml").write_text(camera_text(self.camera))
        return arguments(self.folder)


def arguments(folder):
    """How detect_poses is told a scene."""
    return (
        *("--depth", folder / "depth.png", "--camera", folder / "camera.yaml"),
        *("--roi", folder / "roi.yaml"),
    )


def cut_into_four(triangles):
    """Each of n x 3 corners x 3 coordinates by the middles of its edges."""
    a, b, c = np.moveaxis(triangles, 1, 0)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.concatenate([np.stack(corners, axis=1) for corners in parts])


class Scenes:
    """Simulates what is needed and changes it."""

    def __init__(self, folder):
        self.folder = folder
        self.bench = Bench(folder, {})

    def simulate(self, scenes):
        self.bench.simulate_all(scenes)

    def standard(self, part=PART):
        return Scene(part, COUNT, PRESET, SEED)

    def part_file(self, part=PART):
        return self.bench.part_folder(part) / "part.yaml"

    def of_points(self, millions):
        """The standard scene with another number of pixels, each the nearest one's."""
        copy = Copy(self.bench.scene_path(self.standard()), self.folder / f"points-{millions}")
        rows, columns = copy.depth.shape
        scale = (millions * 1e6 / copy.depth.size) ** 0.5
        new_rows, new_columns = round(rows * scale), round(columns * scale)
        down = np.minimum((np.arange(new_rows) + 0.5) * rows / new_rows, rows - 1).astype(int)
        right = np.minimum((np.arange(new_columns) + 0.5) * columns / new_columns, columns - 1)
        copy.depth = copy.depth[np.ix_(down, right.astype(int))]
        camera = copy.camera
        camera["width"], camera["height"] = new_columns, new_rows
        for axis, factor in (("x", new_columns / columns), ("y", new_rows / rows)):
            camera[f"f{axis}"] *= factor
            camera[f"c{axis}"] = (camera[f"c{axis}"] + 0.5) * factor - 0.5
        return copy.write()

    def of_count(self, count):
        return arguments(self.bench.scene_path(Scene(PART, count, PRESET, SEED)))

    def of_triangles(self, times):
        """The part with each triangle of its mesh cut into four, some times. Returns its part file and its triangles."""
        source, folder = self.bench.part_folder(PART), self.folder / f"cut-{times}"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / "part.yaml", folder / "part.yaml")
        facets = read_facets(source / "model.stl")
        corners = facets["corners"].astype(float)
        for _ in range(times):
            corners = cut_into_four(corners)
        facets = np.zeros(len(corners), dtype=FACET)
        facets["corners"] = corners
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        facets["normal"] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        with (folder / "model.stl").open("wb") as file:
            file.write(bytes(80) + np.uint32(len(facets)).tobytes() + facets.tobytes())
        return folder / "part.yaml", len(facets)

    def of_noise(self, noise_mm):
        """The standard scene with Gaussian noise on its depth."""
        copy = Copy(self.bench.scene_path(self.standard()), self.folder / f"noise-{noise_mm}")
        levels = noise_mm / 1000 / copy.camera["depth_unit_m"]
        noise = np.random.default_rng(SEED).normal(0, levels, copy.depth.shape)
        seen = copy.depth > 0
        copy.depth = np.where(seen, np.clip(np.rint(copy.depth + noise), 1, 65535), 0)
        return copy.write()
