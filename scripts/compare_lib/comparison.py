"""Scenes, what each detector finds in them, and its judgement, each made once."""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

from benchmark_lib.cases import PACKAGE
from benchmark_lib.programs import BenchmarkError, Progress, digest, once, program_digest, run
from benchmark_lib.scene_files import region_text

# This detector's two rows, with their settings.
OWN = {
    "fast": PACKAGE / "config/fast.yaml",
    "accurate": PACKAGE / "config/detector.yaml",
}
PEERS = (*OWN, "PCL", "OpenCV")
FLOOR_GAP_M = 0.003  # the region of interest begins this far above the floor ...
WALL_GAP_M = 0.002  # ... and this far from the walls


@dataclass(frozen=True)
class Scene:
    """A shot of the data folder."""

    part: str
    name: str


def find_scenes(data, parts, names):
    """The scenes of a data folder, all or those named."""
    scenes = [Scene(path.parts[-3], path.parts[-2]) for path in sorted(data.glob("*/*/gt.json"))]
    if not scenes:
        raise BenchmarkError(f"{data} has no scenes: name their folder with --data.")
    for wanted, known in ((parts, {s.part for s in scenes}), (names, {s.name for s in scenes})):
        missing = sorted(set(wanted or ()) - known)
        if missing:
            raise BenchmarkError(f"{data} has no {missing[0]}: it has {', '.join(sorted(known))}.")
    chosen = [s for s in scenes if s.part in (parts or [s.part]) and s.name in (names or [s.name])]
    if not chosen:
        raise BenchmarkError("No part has such a scene: choose others.")
    return chosen


def bin_region_text(truth):
    """The inside of a scene's bin as a region of interest. truth: what gt.json says."""
    side_x, side_y, height = truth["bin"]["size"]
    region = {
        "pose": truth["bin"]["pose"],
        "min": [WALL_GAP_M - side_x / 2, WALL_GAP_M - side_y / 2, FLOOR_GAP_M],
        "max": [side_x / 2 - WALL_GAP_M, side_y / 2 - WALL_GAP_M, height],
    }
    return region_text(region)


class Comparison:
    """A folder with everything that was measured.

    dataset/<part>/<scene>/      links to the scenes, with roi.yaml
    results/<peer>/<part>/<scene>.json
    """

    def __init__(self, folder, data, scenes, options):
        self.folder, self.data, self.scenes = folder, data, scenes
        self.peers = options.peers
        self.settings = (
            *("--time-limit", options.time_limit, "--repeat", options.repeat),
            *("--opencv-scene-step", options.opencv_scene_step),
        )
        self.dataset = folder / "dataset"
        self.results = folder / "results"

    def link_scenes(self):
        """Makes the data set anew."""
        shutil.rmtree(self.dataset, ignore_errors=True)
        for scene in self.scenes:
            source, target = self.data / scene.part, self.dataset / scene.part / scene.name
            target.mkdir(parents=True)
            link_files(source, target.parent)
            link_files(source / scene.name, target)
            region = target / "roi.yaml"
            if not region.exists():
                region.write_text(bin_region_text(json.loads((target / "gt.json").read_text())))

    def part_key(self, part, scenes):
        """Of all that the results of a part depend on."""
        folders = [self.dataset / part, *(self.dataset / part / scene.name for scene in scenes)]
        files = [path for folder in folders for path in folder.iterdir() if path.is_file()]
        names = [scene.name for scene in scenes]
        settings = (self.peers, self.settings, names)
        program = program_digest("compare_detectors")
        return digest(program, settings, *sorted(files), *OWN.values())

    def measure_part(self, part, scenes):
        """All peers, one after the other, in one process. Returns whether this was done now."""
        stamp = self.folder / "runs" / f"{part}.txt"

        def make():
            printed = run(
                "compare_detectors",
                *("--part", self.dataset / part),
                *("--scenes", *[self.dataset / part / scene.name for scene in scenes]),
                *("--fast", OWN["fast"], "--accurate", OWN["accurate"]),
                *("--peers", *self.peers, "--results", self.results),
                *self.settings,
            )
            stamp.write_text(printed)

        return once(stamp, self.part_key(part, scenes), make)

    def measure(self):
        """Part by part."""
        self.link_scenes()
        parts = {}
        for scene in self.scenes:
            parts.setdefault(scene.part, []).append(scene)
        progress = Progress("parts", len(parts))
        for part, scenes in parts.items():
            progress.step(part, self.measure_part(part, scenes))

    def result(self, peer, scene):
        """What a peer's result file of a scene says."""
        return json.loads((self.results / peer / scene.part / f"{scene.name}.json").read_text())

    def figures(self, peer):
        """Results of a peer by scene, and what evaluate_poses says about all of them."""
        judged = self.folder / f"{peer}.json"
        run("evaluate_poses", self.dataset, self.results / peer, "--json", judged)
        return {
            "scenes": {scene: self.result(peer, scene) for scene in self.scenes},
            "summary": json.loads(judged.read_text())["summary"]["ALL"],
        }


def link_files(source, target):
    """Links the files of a folder, not its folders."""
    for file in source.iterdir():
        link = target / file.name
        if file.is_file() and not link.exists():
            link.symlink_to(Path(file).resolve())
