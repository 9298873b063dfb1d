"""What is found in the variants of the real scans."""

import json
from dataclasses import dataclass

import numpy as np
import yaml

from ablation_lib.copies import CopiedBench, copy_files, suspicious_poses
from benchmark_lib.detection import write_configs
from benchmark_lib.programs import Progress, run
from growth_lib.scenes import FACET

from .scans import PART, cloud_draws, image_draws

VARIANT = "default"
MM = 0.001  # unit of the part's mesh


@dataclass(frozen=True)
class RealScene:
    """A variant of a scan, and where it is searched."""

    name: str
    loose: bool  # a cloud without order
    whole: bool  # without a region of interest
    part: str = PART


class RealScan(CopiedBench):
    """A bench with the scans' variants."""

    def __init__(self, folder, data):
        super().__init__(folder, write_configs(folder / "configs", [VARIANT], []))
        mesh = yaml.safe_load((data / "part.yaml").read_text())["mesh"]
        copy_files(data, self.part_folder(PART), ("part.yaml", mesh))
        corners = np.fromfile(data / mesh, dtype=FACET, offset=84)["corners"].reshape(-1, 3)
        self.center_m = (corners.min(axis=0) + corners.max(axis=0)) / 2 * MM

    def scene_arguments(self, scene):
        folder = self.scene_path(scene)
        image = ("--depth", folder / "depth.png", "--camera", folder / "camera.yaml")
        region = () if scene.whole else ("--roi", folder / "roi.yaml")
        return (*(("--cloud", folder / "cloud.pcd") if scene.loose else image), *region)

    def centers(self, scene):
        """Of the part at each reliable pose; n x 3, in the cloud's frame [m]."""
        poses = json.loads(self.result_path(VARIANT, scene).read_text())["poses"]
        found = [np.reshape(pose["pose"], (4, 4)) for pose in poses if pose["reliable"]]
        return np.array([pose[:3, :3] @ self.center_m + pose[:3, 3] for pose in found])

    def draw(self, scene, path):
        """A picture of the reliable poses over the scan."""
        path.parent.mkdir(parents=True, exist_ok=True)
        run(
            "check_poses",
            self.result_path(VARIANT, scene),
            *("--part", self.part_folder(PART) / "part.yaml"),
            *("--config", self.configs[VARIANT]),
            *self.scene_arguments(scene),
            *("--image", path),
        )


def in_images(bench, data):
    """Rows: variant, reliable poses in the part's bin, suspicious ones of them, reliable poses in the other bins. And the
    first variant's scene with the part."""
    rows, first = [], None
    draws = image_draws(data)
    progress = Progress("depth images", len(draws))
    for k, (name, scan) in enumerate(draws.items()):
        found = {}
        for region in scan.regions:
            scene = RealScene(f"image-{k}-{region}", loose=False, whole=False)
            scan.write(region, bench.scene_path(scene))
            made = bench.detect(VARIANT, scene)
            found[region] = len(bench.centers(scene))
            if region == PART:
                suspicious = suspicious_poses(bench, VARIANT, scene)
                first = first or scene
        others = sum(count for region, count in found.items() if region != PART)
        rows.append([name, found[PART], suspicious, others])
        progress.step(name, made)
    return rows, first


def in_clouds(bench, data):
    """Rows: variant, then within the bin reliable and suspicious poses, then in the whole cloud these and those outside the
    bin. And the first variant's scenes, within the bin and whole."""
    rows, first = [], None
    draws = cloud_draws(data)
    progress = Progress("loose clouds", len(draws))
    for k, (name, scan) in enumerate(draws.items()):
        row, scenes = [name], []
        for whole in (False, True):
            scene = RealScene(
                f"cloud-{k}-{'whole' if whole else 'inside'}", loose=True, whole=whole
            )
            scan.write(bench.scene_path(scene))
            made = bench.detect(VARIANT, scene)
            row += [len(bench.centers(scene)), suspicious_poses(bench, VARIANT, scene)]
            scenes.append(scene)
        row.append(int((~scan.inside(bench.centers(scenes[1]))).sum()))
        rows.append(row)
        first = first or scenes
        progress.step(name, made)
    return rows, first
