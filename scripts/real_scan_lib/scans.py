"""The real scans, and the same as they might have come out as well: turned, with more noise, in another order, in another region."""

from dataclasses import dataclass, replace

import numpy as np
import yaml
from PIL import Image

from ablation_lib.copies import NOISE_M, with_noise
from benchmark_lib.clouds import read_cloud, write_cloud
from benchmark_lib.scene_files import camera_text, region_text

LEFT_OUT = 0.03  # share of a loose cloud's points
FLOOR_M = 0.002  # that a region begins lower or higher
CLOUD_UNIT_M = 0.001  # of one_bin.pcd
QUARTER_TURN = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])  # what was right is above
# Inside of its bin, in its camera's frame [m]: depth and height as those of the bins in bins.yaml, which are of the same
# kind and stand as far away; the sides as far apart as its walls are.
INSIDE = (np.array([-0.042, -0.065, 0.445]), np.array([0.040, 0.098, 0.4955]))
FLOORS = {
    f"region {FLOOR_M * 1000:g} mm shallower": -FLOOR_M,
    f"region {FLOOR_M * 1000:g} mm deeper": FLOOR_M,
}


@dataclass(frozen=True)
class ImageScan:
    """A depth image with a box around the inside of each bin."""

    levels: np.ndarray
    camera: dict  # as camera.yaml
    regions: dict  # corners min, max by the bin's name; camera frame [m]
    turn: np.ndarray  # 3 x 3, from the scan's camera

    def turned(self):
        """The camera a quarter turn about its axis."""
        camera = {
            **self.camera,
            **{"width": self.camera["height"], "height": self.camera["width"]},
            **{"fx": self.camera["fy"], "fy": self.camera["fx"]},
            **{"cx": self.camera["cy"], "cy": self.camera["width"] - 1 - self.camera["cx"]},
        }
        regions = {
            name: np.sort([QUARTER_TURN @ low, QUARTER_TURN @ high], axis=0)
            for name, (low, high) in self.regions.items()
        }
        return ImageScan(np.rot90(self.levels), camera, regions, QUARTER_TURN @ self.turn)

    def noisy(self, seed):
        """Gaussian noise on what is measured."""
        return replace(self, levels=with_noise(self.levels, self.camera["depth_unit_m"], seed))

    def deeper(self, by_m):
        """The regions reach so much farther from the camera."""
        shift = np.array([[0, 0, 0], [0, 0, by_m]])
        return replace(self, regions={name: box + shift for name, box in self.regions.items()})

    def write(self, region, folder):
        """A scene's folder for one of the bins."""
        folder.mkdir(parents=True, exist_ok=True)
        Image.fromarray(np.ascontiguousarray(self.levels)).save(folder / "depth.png")
        (folder / "camera.yaml").write_text(camera_text(self.camera))
        low, high = self.regions[region]
        (folder / "roi.yaml").write_text(region_text({"min": low, "max": high}))


@dataclass(frozen=True)
class CloudScan:
    """A loose cloud; metres, camera frame."""

    points: np.ndarray
    turn: np.ndarray  # 3 x 3, from the scan's camera
    deeper_m: float = 0.0  # that the region reaches farther from the camera than the inside

    def turned(self, degrees):
        """The camera turned about its axis."""
        cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        turn = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
        return replace(self, points=self.points @ turn.T, turn=turn @ self.turn)

    def shuffled(self, seed):
        """The points in another order."""
        return replace(self, points=np.random.default_rng(seed).permutation(self.points))

    def thinned(self, seed):
        """Some of the points left out."""
        kept = np.random.default_rng(seed).random(len(self.points)) >= LEFT_OUT
        return replace(self, points=self.points[kept])

    def write(self, folder):
        """A scene's folder, with the inside of the bin as region. The cloud has the unit of the scan's file, so that what is not
        changed has its very numbers."""
        folder.mkdir(parents=True, exist_ok=True)
        write_cloud(self.points / CLOUD_UNIT_M, folder / "cloud.pcd")
        low, high = INSIDE[0], INSIDE[1] + [0, 0, self.deeper_m]
        pose = np.eye(4)
        pose[:3, :3] = self.turn
        region = {"min": low, "max": high, "pose": pose.ravel()}
        (folder / "roi.yaml").write_text(region_text(region))


def image_draws(data):
    """Variants of the depth image by name; the first is as it is."""
    with Image.open(data / "depth.png") as image:
        levels = np.array(image)
    regions = yaml.safe_load((data / "bins.yaml").read_text())["regions"]
    boxes = {name: (np.array(box["min"]), np.array(box["max"])) for name, box in regions.items()}
    scan = ImageScan(levels, yaml.safe_load((data / "camera.yaml").read_text()), boxes, np.eye(3))
    draws = {"as it is": scan}
    turned = scan
    for degrees in (90, 180, 270):
        turned = turned.turned()
        draws[f"turned by {degrees} degrees"] = turned
    for seed in (1, 2, 3, 4):
        draws[f"{NOISE_M * 1000:g} mm of noise, seed {seed}"] = scan.noisy(seed)
    for name, by_m in FLOORS.items():
        draws[name] = scan.deeper(by_m)
    return draws


def cloud_draws(data):
    """Variants of the loose cloud by name; the first is as it is."""
    scan = CloudScan(read_cloud(data / "one_bin.pcd") * CLOUD_UNIT_M, np.eye(3))
    draws = {"as it is": scan, "in another order": scan.shuffled(1)}
    for degrees in (15, 30, 45, 60, 90, 180):
        draws[f"turned by {degrees} degrees"] = scan.turned(degrees)
    for seed in range(1, 8):
        draws[f"{LEFT_OUT * 100:g} % left out, seed {seed}"] = scan.thinned(seed)
    for name, by_m in FLOORS.items():
        draws[name] = replace(scan, deeper_m=by_m)
    return draws
