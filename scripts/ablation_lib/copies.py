"""Scenes of the data folder, copied with a little more noise so that a bench can work on them."""

import json
import shutil
import zlib
from dataclasses import dataclass

import numpy as np
import yaml
from PIL import Image

from benchmark_lib.detection import Bench
from benchmark_lib.programs import BenchmarkError, digest, run

from compare_lib.comparison import bin_region_text

NOISE_M = 0.00005  # standard deviation added to the depth, of the order of the sensor's own
REAL_PART = "pins"  # also the bin that holds the part; the others hold none


@dataclass(frozen=True)
class CopiedScene:
    """A scene of a CopiedBench."""

    part: str
    name: str


class CopiedBench(Bench):
    """A bench whose scenes and parts are files that others made."""

    def part_digest(self, part):
        return digest(*files_in(self.part_folder(part)))

    def scene_key(self, scene):
        return digest(*files_in(self.scene_path(scene)))


def files_in(folder):
    """In a fixed order."""
    return sorted(path for path in folder.iterdir() if path.is_file())


def copy_files(source, folder, names):
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        shutil.copyfile(source / name, folder / name)


def copy_part(source, folder):
    copy_files(source, folder, [path.name for path in files_in(source)])


def with_noise(levels, unit_m, seed):
    """Gaussian noise on what is measured in a depth image."""
    noise = np.random.default_rng(seed).normal(0, NOISE_M / unit_m, levels.shape)
    noisy = np.clip(np.rint(levels + noise), 1, np.iinfo(np.uint16).max)
    return np.where(levels > 0, noisy, 0).astype(np.uint16)


def add_noise(path, unit_m, seed):
    """The same to a file."""
    with Image.open(path) as image:
        levels = np.array(image)
    Image.fromarray(with_noise(levels, unit_m, seed)).save(path)


def copy_bins(data, bench, seeds):
    """Each scene of the data set once a seed, with its bin as the region. Returns the scenes by seed."""
    sources = sorted(path.parent for path in data.glob("*/*/gt.json"))
    if not sources:
        raise BenchmarkError(f"{data} has no scenes: name the data folder with --data.")
    scenes = {seed: [] for seed in seeds}
    for source in sources:
        part = source.parent.name
        copy_part(source.parent, bench.part_folder(part))
        unit_m = yaml.safe_load((source / "camera.yaml").read_text())["depth_unit_m"]
        region = bin_region_text(json.loads((source / "gt.json").read_text()))
        for seed in seeds:
            scene = CopiedScene(part, f"{source.name}-noise-{seed}")
            folder = bench.scene_path(scene)
            copy_files(source, folder, ("depth.png", "camera.yaml", "gt.json"))
            add_noise(folder / "depth.png", unit_m, zlib.crc32(f"{part}/{scene.name}".encode()))
            (folder / "roi.yaml").write_text(region)
            scenes[seed].append(scene)
    return scenes


def reliable_poses(bench, variant, scene):
    """How many a result holds."""
    result = json.loads(bench.result_path(variant, scene).read_text())
    return sum(pose["reliable"] for pose in result["poses"])


def suspicious_poses(bench, variant, scene, *options):
    """How many of the reliable poses check_poses finds suspicious. options: further ones of it."""
    printed = run(
        "check_poses",
        bench.result_path(variant, scene),
        *("--part", bench.part_folder(scene.part) / "part.yaml"),
        *("--config", bench.configs[variant]),
        *bench.scene_arguments(scene),
        *options,
    )
    return int(printed.splitlines()[-1].split()[-2])
