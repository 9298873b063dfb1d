"""What the fits learn from: scenes, changed copies of them, and the poses found in them, right or wrong."""

import inspect
import json
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Callable

import numpy as np

from benchmark_lib.cases import PRESETS, Scene
from benchmark_lib.clouds import write_cloud
from benchmark_lib.detection import Bench
from benchmark_lib.meshes import bounds_m
from benchmark_lib.programs import Progress, digest, once

from . import coarse, shiny
from .terms import terms_of
from .usual import passes_gates

SEEDS = (101, 102)  # not the benchmark's
FILLS = (8, 24, 36)
FOREIGN_FILL = 24
SHINY_PRESETS = ("clean", "industrial")  # of low_cost hardly anything would be left
OPEN_PRESETS = ("industrial", "low_cost")
COARSE_FILLS = (24, 36)
COARSE_PRESETS = ("clean", "industrial")  # the noise of low_cost is that of finer pixels
# Places in the list of parts between the part looked for and the one that is there.
FOREIGN_SHIFTS = (1, 3, 5, 8)
FOREIGN_WEIGHT = 0.2  # a bin rarely holds other parts
BORROWED_WEIGHT = 0.2  # of poses found within a region, in the fit for searches of the whole cloud
VARIANT = "default"
FOREIGN = {"foreign": FOREIGN_WEIGHT, "foreign, shiny": FOREIGN_WEIGHT}
# Sets of poses of each fit and their weights.
FITS = {
    "region": {"own": 1.0, "shiny": 1.0, "coarse": 1.0, **FOREIGN},
    "whole_cloud": {"open": 1.0, "open, coarse": 1.0, "shiny": BORROWED_WEIGHT, **FOREIGN},
}


@dataclass(frozen=True)
class ChangedScene:
    """A changed copy of a scene. kind: one of KINDS."""

    source: Scene
    kind: str

    @property
    def part(self):
        return self.source.part

    @property
    def name(self):
        return f"{self.kind.replace(', ', '-')}-{self.source.name}"


@dataclass(frozen=True)
class Kind:
    """Of copies."""

    write: Callable  # a copy, from the folder of the scene and its own
    presets: tuple  # of the scenes that are copied
    fills: tuple = ()  # the same; empty: all
    loose: bool = False  # looked for in a cloud without order, not in the depth image
    whole_cloud: bool = False  # looked for without the region of interest

    @property
    def sources(self):
        """The files that decide what a copy holds."""
        return [Path(inspect.getfile(function)) for function in (self.write, write_cloud, bounds_m)]

    def is_of(self, scene):
        """Whether a scene is copied."""
        return scene.preset in self.presets and (not self.fills or scene.count in self.fills)


KINDS = {
    "shiny": Kind(shiny.write_shiny_scene, SHINY_PRESETS),
    "coarse": Kind(coarse.write_coarse_scene, COARSE_PRESETS, COARSE_FILLS, loose=True),
    "open": Kind(coarse.write_same_scene, OPEN_PRESETS, whole_cloud=True),
    "open, coarse": Kind(
        coarse.write_coarse_scene, COARSE_PRESETS, COARSE_FILLS, loose=True, whole_cloud=True
    ),
}


@dataclass
class Poses:
    """Of all sets, a row each."""

    terms: np.ndarray
    labels: np.ndarray  # 1 right, 0 wrong
    parts: np.ndarray  # what was looked for
    sets: np.ndarray  # names
    gates: np.ndarray  # whether it passes them while nothing is usual
    scenes: np.ndarray  # a number for each result

    def of_fit(self, name):
        """The poses of one of FITS, and their weights."""
        weights = np.array([FITS[name].get(pose_set, 0.0) for pose_set in self.sets])
        used = weights > 0
        columns = [getattr(self, field.name)[used] for field in fields(Poses)]
        return Poses(*columns), weights[used]


class Training(Bench):
    """A bench with changed scenes beside the simulated ones."""

    def scene_key(self, scene):
        if isinstance(scene, ChangedScene):
            return digest(super().scene_key(scene.source), scene, *KINDS[scene.kind].sources)
        return super().scene_key(scene)

    def scene_arguments(self, scene):
        if not isinstance(scene, ChangedScene):
            return super().scene_arguments(scene)
        kind, folder = KINDS[scene.kind], self.scene_path(scene)
        image = ("--depth", folder / "depth.png", "--camera", folder / "camera.yaml")
        region = () if kind.whole_cloud else ("--roi", folder / "roi.yaml")
        return (*(("--cloud", folder / coarse.CLOUD) if kind.loose else image), *region)

    def change_all(self, scenes):
        """The copies, from scenes that exist."""
        progress = Progress("changed scenes", len(scenes))
        for scene in scenes:
            source, path = self.scene_path(scene.source), self.scene_path(scene)
            write = KINDS[scene.kind].write
            made = once(path, self.scene_key(scene), lambda: write(source, path))
            progress.step(f"{scene.part} {scene.name}", made)

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

    def used(self, presets):
        """Those of them that the plan has."""
        return [preset for preset in presets if preset in self.presets]

    def changed(self):
        """Lists of copies by kind."""
        return {
            name: [ChangedScene(scene, name) for scene in self.plain() if kind.is_of(scene)]
            for name, kind in KINDS.items()
        }

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
                copies.append((part, ChangedScene(scene, "shiny")))
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
    own, foreign = {"own": plan.plain(), **plan.changed()}, plan.foreign()
    bench.simulate_all(own["own"])
    bench.change_all([scene for kind in KINDS for scene in own[kind]])
    bench.detect_side_by_side(VARIANT, [scene for scenes in own.values() for scene in scenes])
    pairs = [pair for pairs in foreign.values() for pair in pairs]
    bench.detect_side_by_side(VARIANT, [scene for _, scene in pairs], [part for part, _ in pairs])
    found = {
        **{name: list(own_poses(bench, name, scenes)) for name, scenes in own.items()},
        **{name: list(foreign_poses(bench, pairs)) for name, pairs in foreign.items()},
    }
    return joined(found)
