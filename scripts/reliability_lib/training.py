"""What the fit learns from: scenes, shiny copies of them, and the poses found in them, right or wrong."""

import json
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from benchmark_lib.cases import PRESETS, Scene
from benchmark_lib.detection import Bench
from benchmark_lib.programs import Progress, digest, once

from . import shiny
from .terms import terms_of
from .usual import passes_gates

SEEDS = (101, 102)  # not the benchmark's
FILLS = (8, 24, 36)
FOREIGN_FILL = 24
SHINY_PRESETS = ("clean", "industrial")  # of low_cost hardly anything would be left
# Places in the list of parts between the part looked for and the one that is there.
FOREIGN_SHIFTS = (1, 3, 5, 8)
FOREIGN_WEIGHT = 0.2  # a bin rarely holds other parts
VARIANT = "default"
# Name of each set of poses with its weight in the fit.
SETS = {"own": 1.0, "shiny": 1.0, "foreign": FOREIGN_WEIGHT, "foreign, shiny": FOREIGN_WEIGHT}


@dataclass(frozen=True)
class ShinyScene:
    """A shiny copy of a scene."""

    source: Scene

    @property
    def part(self):
        return self.source.part

    @property
    def name(self):
        return f"shiny-{self.source.name}"


@dataclass
class Poses:
    """Of all sets, a row each."""

    terms: np.ndarray
    labels: np.ndarray  # 1 right, 0 wrong
    parts: np.ndarray  # what was looked for
    sets: np.ndarray  # names
    gates: np.ndarray  # whether it passes them while nothing is usual
    scenes: np.ndarray  # a number for each result

    def weights(self):
        """In the fit."""
        return np.array([SETS[name] for name in self.sets])


class Training(Bench):
    """A bench with shiny scenes beside the simulated ones."""

    def scene_key(self, scene):
        if isinstance(scene, ShinyScene):
            return digest(super().scene_key(scene.source), scene, Path(shiny.__file__))
        return super().scene_key(scene)

    def make_shiny_all(self, scenes):
        """The copies, from scenes that exist."""
        progress = Progress("shiny scenes", len(scenes))
        for scene in scenes:
            source, path = self.scene_path(scene.source), self.scene_path(scene)
            made = once(path, self.scene_key(scene), lambda: shiny.write_shiny_scene(source, path))
            progress.step(f"{scene.part} {scene.name}", made)

    def find_foreign(self, pairs):
        """Looks for parts in scenes of other parts. pairs: part, scene."""
        progress = Progress("foreign objects", len(pairs))
        for part, scene in pairs:
            made = self.detect(VARIANT, scene, part)
            progress.step(f"{part} among {scene.part} {scene.name}", made)

    def found(self, scene, part=None):
        """Poses of a result as they were written, and their terms."""
        path = self.result_path(VARIANT, scene, part)
        poses = json.loads(path.read_text())["poses"]
        return poses, terms_of(poses, path)


@dataclass(frozen=True)
class Plan:
    """What is simulated and looked for."""

    parts: tuple
    seeds: tuple = SEEDS
    fills: tuple = FILLS
    presets: tuple = PRESETS

    def plain(self):
        return [
            Scene(part, fill, preset, seed)
            for part in self.parts
            for seed in self.seeds
            for fill in self.fills
            for preset in self.presets
        ]

    def shiny(self):
        return [ShinyScene(scene) for scene in self.plain() if scene.preset in SHINY_PRESETS]

    def foreign_fill(self):
        """Of the scenes of other parts."""
        return FOREIGN_FILL if FOREIGN_FILL in self.fills else self.fills[0]

    def foreign(self):
        """Pairs of part and scene by the name of their set."""
        first, last = self.seeds[0], self.seeds[-1]
        plain, copies = [], []
        for part in self.parts:
            for other in neighbours(self.parts, part):
                for preset, seed in (("industrial", first), ("low_cost", last)):
                    if preset in self.presets:
                        plain.append((part, Scene(other, self.foreign_fill(), preset, seed)))
                scene = Scene(other, self.foreign_fill(), "industrial", last)
                copies.append((part, ShinyScene(scene)))
        return {"foreign": plain, "foreign, shiny": copies}


def neighbours(parts, part):
    """The other parts among which a part is looked for; each at most once."""
    place = parts.index(part)
    others = {parts[(place + shift) % len(parts)]: None for shift in FOREIGN_SHIFTS}
    return [other for other in others if other != part]


def labels_of(judged_poses, count, threshold):
    """1 for each pose whose MSSD is below the threshold, also where a better pose has the same object.

    judged_poses: as evaluate_poses writes them; no MSSD where a pose is no rigid transformation.
    """
    labels = np.full(count, np.nan)
    for pose in judged_poses:
        error = pose["mssd_rel"]
        labels[pose["index"]] = error is not None and error < threshold
    if np.isnan(labels).any():
        raise ValueError("evaluate_poses left out a pose")
    return labels


def judged_poses(terms, labels, part, poses):
    """Of the poses of one result; the scene's number comes later."""
    count = len(labels)
    gates = np.array([passes_gates(pose) for pose in poses], bool)
    return Poses(terms, labels, np.full(count, part), np.full(count, ""), gates, np.zeros(count))


def own_poses(bench, name, scenes):
    """The poses of each scene's own part, judged by evaluate_poses."""
    judged = bench.evaluate(name, VARIANT, scenes)
    verdicts = {
        (part, scene["scene"]): scene["poses"]
        for part, judged_scenes in judged["scenes"].items()
        for scene in judged_scenes
    }
    for scene in scenes:
        poses, terms = bench.found(scene)
        labels = labels_of(verdicts[scene.part, scene.name], len(poses), judged["threshold"])
        yield judged_poses(terms, labels, scene.part, poses)


def foreign_poses(bench, pairs):
    """The same of parts that are not there: all wrong."""
    for part, scene in pairs:
        poses, terms = bench.found(scene, part)
        yield judged_poses(terms, np.zeros(len(poses)), part, poses)


def joined(found):
    """One set of all. found: a list of results' poses by the name of their set."""
    results = [(name, poses) for name, listed in found.items() for poses in listed]
    for scene, (name, poses) in enumerate(results):
        poses.sets = np.full(len(poses.labels), name)
        poses.scenes = np.full(len(poses.labels), scene)
    columns = [[getattr(poses, field.name) for _, poses in results] for field in fields(Poses)]
    return Poses(*map(np.concatenate, columns))


def collect(plan, bench):
    """Makes, finds and judges everything. Returns the poses."""
    plain, copies, foreign = plan.plain(), plan.shiny(), plan.foreign()
    bench.simulate_all(plain)
    bench.make_shiny_all(copies)
    bench.detect_all(VARIANT, plain + copies)
    bench.find_foreign([pair for pairs in foreign.values() for pair in pairs])
    found = {
        "own": list(own_poses(bench, "own", plain)),
        "shiny": list(own_poses(bench, "shiny", copies)),
        **{name: list(foreign_poses(bench, pairs)) for name, pairs in foreign.items()},
    }
    return joined(found)
