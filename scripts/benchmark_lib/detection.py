"""Scenes, models, poses and their judgement, each made once."""

import concurrent.futures
import json
import os
import shutil

from . import cases
from .cases import PACKAGE
from .programs import Progress, digest, is_done, once, program_digest, run, stamp_of


class Bench:
    """A folder with everything that was simulated and measured.

    scenes/<part>/<scene>/       as simulate_scene writes them
    models/<variant>/<part>.ppf
    results/<variant>/<part>/<scene>.json
    views/<name>/<part>/<scene>  links to some of the scenes, for evaluate_poses
    """

    def __init__(self, folder, configs):
        self.folder = folder
        self.configs = configs  # path of the settings of each variant
        self.cores = {}  # path of the core library of a variant that has one of its own
        self.trained_as = {}  # the variant that trains a variant's models, where it is another

    def part_folder(self, part):
        return self.folder / "scenes" / part

    def scene_path(self, scene):
        return self.part_folder(scene.part) / scene.name

    def part_digest(self, part):
        file = PACKAGE / "config/parts" / f"{part}.yaml"
        mesh = next((PACKAGE / "meshes").glob(f"{part}.stl"))
        return digest(file, mesh)

    def scene_key(self, scene):
        return digest(scene, self.part_digest(scene.part), program_digest("simulate_scene"))

    def simulate(self, pile):
        """Makes the scenes of one pile, seen by several sensors. Returns whether one was made now."""
        missing = [
            scene for scene in pile if not is_done(self.scene_path(scene), self.scene_key(scene))
        ]
        if not missing:
            return False
        for scene in missing:
            stamp_of(self.scene_path(scene)).unlink(missing_ok=True)
        first = missing[0]
        for stale in ("part.yaml", "model.stl"):  # of another state of the part
            (self.part_folder(first.part) / stale).unlink(missing_ok=True)
        run(
            "simulate_scene",
            *("--part", PACKAGE / "config/parts" / f"{first.part}.yaml"),
            *("--count", first.count, "--seed", first.seed),
            *("--preset", *[scene.preset for scene in missing]),
            *("--output", self.folder / "scenes", "--hulls", self.folder / "hulls"),
        )
        for scene in missing:
            stamp_of(self.scene_path(scene)).write_text(self.scene_key(scene))
        return True

    def simulate_all(self, scenes):
        """One part a core at once, as its hulls are computed once, for all its piles. Nothing is timed here."""
        parts = {}
        for scene in scenes:
            piles = parts.setdefault(scene.part, {})
            piles.setdefault((scene.count, scene.seed), []).append(scene)
        progress = Progress("piles", sum(map(len, parts.values())))

        def simulate_part(part):
            for (count, _), pile in parts[part].items():
                progress.step(f"{part}, {count} parts", self.simulate(pile))

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(simulate_part, parts))

    def model(self, variant, part):
        """The part's trained model."""
        variant = self.trained_as.get(variant, variant)
        path = self.folder / "models" / variant / f"{part}.ppf"
        key = digest(
            *self.variant_files(variant), self.part_digest(part), program_digest("train_model")
        )
        part_file = self.part_folder(part) / "part.yaml"
        once(
            path,
            key,
            lambda: self.run(variant, "train_model", "--part", part_file, "--output", path),
        )
        return path

    def variant_files(self, variant):
        """What makes a variant."""
        core = self.cores.get(variant)
        return [self.configs[variant], *([core] if core else [])]

    def run(self, variant, program, *arguments):
        """A program with a variant's settings and core."""
        config = ("--config", self.configs[variant])
        return run(program, *arguments, *config, core=self.cores.get(variant))

    def result_path(self, variant, scene, part=None):
        """part: what is looked for, if not the scene's own."""
        folder = self.folder / "results" / variant
        if part in (None, scene.part):
            return folder / scene.part / f"{scene.name}.json"
        return folder / part / f"{scene.part}-{scene.name}.json"

    def detect(self, variant, scene, part=None, options=()):
        """Poses of one scene's part, or of another in its place. Returns whether they were found now.

        options: further ones of detect_poses, which change nothing but the time.
        """
        part = part or scene.part
        path = self.result_path(variant, scene, part)
        key = digest(
            *self.variant_files(variant),
            self.scene_key(scene),
            self.part_digest(part),
            *[getattr(word, "name", word) for word in self.scene_arguments(scene)],
            program_digest("detect_poses"),
        )
        return once(path, key, lambda: self.detect_now(variant, scene, part, path, options))

    def detect_now(self, variant, scene, part, path, options=()):
        """Writes what detect_poses finds."""
        self.run(
            variant,
            "detect_poses",
            *("--part", self.part_folder(part) / "part.yaml"),
            *("--model", self.model(variant, part)),
            *self.scene_arguments(scene),
            *("--output", path),
            *options,
        )

    def time_ms(self, variant, scene):
        """Duration of a detection that runs now."""
        path = self.folder / "timed.json"
        self.detect_now(variant, scene, scene.part, path)
        return json.loads(path.read_text())["time_ms"]

    def scene_arguments(self, scene):
        """How detect_poses and check_poses are told the scene."""
        folder = self.scene_path(scene)
        return (
            *("--depth", folder / "depth.png", "--camera", folder / "camera.yaml"),
            *("--roi", folder / "roi.yaml"),
        )

    def detect_all(self, variant, scenes):
        """One after the other, for the times."""
        progress = Progress(f"poses, {variant}", len(scenes))
        for scene in scenes:
            progress.step(f"{scene.part} {scene.name}", self.detect(variant, scene))

    def detect_side_by_side(self, variant, scenes, parts=None):
        """As many at once as there are cores, each on one: the same poses sooner, but no times.

        parts: what is looked for in each scene; its own if not given.
        """
        parts = parts or [scene.part for scene in scenes]
        progress = Progress(f"poses, {variant}", len(scenes))

        def detect(scene, part):
            made = self.detect(variant, scene, part, ("--threads", 1))
            progress.step(f"{part} in {scene.part} {scene.name}", made)

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            # Each trained once, before several scenes need it.
            list(pool.map(lambda part: self.model(variant, part), dict.fromkeys(parts)))
            list(pool.map(detect, scenes, parts))

    def make_view(self, name, scenes):
        """A data set of some of the scenes, by links. Returns its folder."""
        view = self.folder / "views" / name
        shutil.rmtree(view, ignore_errors=True)
        for scene in scenes:
            folder = view / scene.part
            if not folder.exists():
                folder.mkdir(parents=True)
                for file in self.part_folder(scene.part).glob("*.*"):
                    if file.name == "part.yaml" or file.stem == "model":
                        (folder / file.name).symlink_to(file)
            (folder / scene.name).symlink_to(self.scene_path(scene))
        return view

    def evaluate(self, view, variant, scenes):
        """What evaluate_poses says about some of the scenes."""
        dataset = self.make_view(view, scenes)
        results = self.folder / "results" / variant
        output = self.folder / "evaluations" / f"{variant}-{view}.json"
        found = [self.result_path(variant, scene) for scene in scenes]
        key = digest(*found, *map(self.scene_key, scenes), program_digest("evaluate_poses"))
        once(output, key, lambda: run("evaluate_poses", dataset, results, "--json", output))
        judged = json.loads(output.read_text())
        judged["summary"]["ALL"] = judged["summary"].pop("ALL")  # last, as in tables
        return judged

    def stage_times(self, variant, scenes):
        """Of each scene, milliseconds of each stage, and of the whole as `all`."""
        times = []
        for scene in scenes:
            result = json.loads(self.result_path(variant, scene).read_text())
            times.append({**result["stages_ms"], "all": result["time_ms"]})
        return times


def write_configs(folder, variants, extra_files):
    """Settings files of the variants. Returns their paths by the variants' names."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {}
    for name in variants:
        paths[name] = folder / f"{name}.yaml"
        lines = [f"{key}: {json.dumps(value)}\n" for key, value in cases.VARIANTS[name].items()]
        paths[name].write_text("".join(lines) or "{}\n")
    for file in extra_files:
        paths[file.stem] = file
    return paths
