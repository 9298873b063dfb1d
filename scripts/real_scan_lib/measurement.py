"""What is found in the variants of the real scans."""

import json
from dataclasses import dataclass

import numpy as np
import yaml

from ablation_lib.copies import REAL_PART, CopiedBench, copy_files, reliable_poses, suspicious_poses
from benchmark_lib.programs import BenchmarkError, Progress

from .seen import VERDICTS, cloud_view, head_and_tail_m, picture_view, verdict

VARIANT = "default"


@dataclass(frozen=True)
class RealScene:
    """A variant of a scan, and where it is searched."""

    name: str
    loose: bool  # a cloud without order
    whole_cloud: bool  # without a region of interest
    part: str = REAL_PART


class RealScan(CopiedBench):
    """A bench with the scans' variants."""

    def __init__(self, folder, data, configs):
        super().__init__(folder, configs)
        for name in ("part.yaml", "camera.yaml", "bins.yaml"):
            if not (data / name).is_file():
                raise BenchmarkError(f"{data / name} is missing: name the data folder with --data.")
        mesh = yaml.safe_load((data / "part.yaml").read_text())["mesh"]
        copy_files(data, self.part_folder(REAL_PART), ("part.yaml", mesh))
        self.ends_m = head_and_tail_m(data / "part.yaml")
        self.picture = picture_view(yaml.safe_load((data / "camera.yaml").read_text()))

    def scene_arguments(self, scene):
        folder = self.scene_path(scene)
        cloud = ("--cloud", folder / "cloud.pcd", "--cloud-unit", "mm")
        image = ("--depth", folder / "depth.png", "--camera", folder / "camera.yaml")
        region = () if scene.whole_cloud else ("--roi", folder / "roi.yaml")
        return (*(cloud if scene.loose else image), *region)

    def poses(self, scene, variant=VARIANT):
        """The reliable ones, each T_cloud_model, 4 x 4."""
        poses = json.loads(self.result_path(variant, scene).read_text())["poses"]
        return [np.reshape(pose["pose"], (4, 4)) for pose in poses if pose["reliable"]]

    def verdicts(self, scene, turn, variant=VARIANT):
        """How many of the reliable poses are each of seen.VERDICTS. turn: of the scene's camera from the scan's."""
        back = np.eye(4)
        back[:3, :3] = np.transpose(turn)
        view = cloud_view() if scene.loose else self.picture
        found = [verdict(back @ pose, self.ends_m, view) for pose in self.poses(scene, variant)]
        return [found.count(name) for name in VERDICTS]

    def draw(self, scene, path):
        """A picture of the reliable poses over the scan."""
        path.parent.mkdir(parents=True, exist_ok=True)
        suspicious_poses(self, VARIANT, scene, "--image", path)


def write_images(bench, draws):
    """Makes the scenes of depth images. Returns of each variant its scenes by the bin's name. draws: as image_draws()."""
    scenes = {}
    for k, (name, scan) in enumerate(draws.items()):
        scenes[name] = {
            region: RealScene(f"image-{k}-{region}", loose=False, whole_cloud=False)
            for region in scan.regions
        }
        for region, scene in scenes[name].items():
            scan.write(region, bench.scene_path(scene))
    return scenes


def in_images(bench, draws):
    """Rows: variant, reliable poses in the part's bin, how many of them are each of seen.VERDICTS, suspicious ones of them,
    reliable poses in the other bins. And the first variant's scene with the part. draws: as image_draws().
    """
    images = write_images(bench, draws)
    rows = []
    progress = Progress("depth images", len(images))
    for name, scenes in images.items():
        made = [bench.detect(VARIANT, scene) for scene in scenes.values()]
        pins = scenes[REAL_PART]
        verdicts = bench.verdicts(pins, draws[name].turn)
        suspicious = suspicious_poses(bench, VARIANT, pins)
        others = [
            reliable_poses(bench, VARIANT, scene) for scene in scenes.values() if scene != pins
        ]
        rows.append([name, sum(verdicts), *verdicts, suspicious, sum(others)])
        progress.step(name, any(made))
    return rows, next(iter(images.values()))[REAL_PART]


def in_clouds(bench, draws):
    """Rows: variant, then within the bin and in the whole cloud: reliable poses, how many of them are each of seen.VERDICTS,
    suspicious ones of them. And the first variant's scenes, within the bin and whole. draws: as cloud_draws().
    """
    rows, first = [], None
    progress = Progress("loose clouds", len(draws))
    for k, (name, scan) in enumerate(draws.items()):
        row, scenes, made = [name], [], False
        for place in ("bin", "everywhere"):
            scene = RealScene(f"cloud-{k}-{place}", loose=True, whole_cloud=place == "everywhere")
            scan.write(bench.scene_path(scene))
            made |= bench.detect(VARIANT, scene)
            verdicts = bench.verdicts(scene, scan.turn)
            row += [sum(verdicts), *verdicts, suspicious_poses(bench, VARIANT, scene)]
            scenes.append(scene)
        rows.append(row)
        first = first or scenes
        progress.step(name, made)
    return rows, first
