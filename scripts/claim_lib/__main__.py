"""Command line of scripts/claim."""

import argparse
import json
import sys
from pathlib import Path

from benchmark_lib.cases import VARIANTS, Scene
from benchmark_lib.detection import Bench, write_configs
from benchmark_lib.programs import provenance, run_script

from .precision import Ranking
from .report import NUMBERS, Measured, write_page

# Parts on which surfaces slide over one another or hide what tells poses apart, and parts on which they do not.
GROUPS = {
    "prone": ("bolt", "box", "cylinder", "elbow", "plate", "profile", "shaft", "tee"),
    "control": ("bracket", "clip"),
}
SEEDS = {"prone": range(301, 314), "control": range(301, 351)}
FILL = 16
PRESET = "industrial"


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/claim",
        description="Tests on simulated scenes what the mismatch test claims; writes a report. What was done before is not done again.",
    )
    parser.add_argument(
        "--seeds",
        type=int,
        choices=range(1, 51),
        metavar="N",
        help="no more than N seeds a part (1 to 50): a trial",
    )
    parser.add_argument("--folder", type=Path, default=Path("build/claim"))
    parser.add_argument(
        "--report",
        type=Path,
        help="default: docs/claim.md if everything is used, else claim.md in the folder",
    )
    return parser.parse_args()


def scenes_of(group, most):
    """Scenes of a group of parts."""
    seeds = list(SEEDS[group])[:most]
    return [Scene(part, FILL, PRESET, seed) for part in GROUPS[group] for seed in seeds]


def judged_poses(bench, variant, judged, scenes):
    """Of each scene its targets and its poses, each as it was written and what evaluate_poses calls it. Those on parts too
    hidden to be targets are left out."""
    by_name = {
        (part, scene["scene"]): scene
        for part, judged_scenes in judged["scenes"].items()
        for scene in judged_scenes
    }
    result = []
    for scene in scenes:
        one = by_name[scene.part, scene.name]
        written = json.loads(bench.result_path(variant, scene).read_text())["poses"]
        poses = [(written[pose["index"]], pose["verdict"]) for pose in one["poses"]]
        poses = [(pose, verdict) for pose, verdict in poses if verdict != "ignored"]
        result.append((one["targets"], poses))
    return result


def ranking(found, number):
    """All poses of a variant: reliable ones first; then by a number of each."""
    return Ranking.of(
        [
            (
                targets,
                [((p["reliable"], p[number]), verdict == "right") for p, verdict in poses],
            )
            for targets, poses in found
        ]
    )


def measure(bench, groups):
    """Of each group and variant a Measured."""
    figures = {}
    for group, scenes in groups.items():
        bench.simulate_all(scenes)
        for variant in VARIANTS:
            bench.detect_side_by_side(variant, scenes)
            judged = bench.evaluate(group, variant, scenes)
            found = judged_poses(bench, variant, judged, scenes)
            ranked = {number: ranking(found, number) for number in NUMBERS}
            poses = [pose for _, listed in found for pose in listed]
            figures.setdefault(group, {})[variant] = Measured(ranked, judged["summary"], poses)
    return figures


def work(options):
    """Returns the exit status."""
    folder = options.folder.resolve()
    bench = Bench(folder, write_configs(folder / "configs", VARIANTS, []))
    groups = {group: scenes_of(group, options.seeds) for group in GROUPS}
    figures = measure(bench, groups)
    page = options.report or (folder if options.seeds else Path("docs")) / "claim.md"
    facts = {
        **provenance("scripts/claim"),
        "folder": options.folder,
        "groups": {
            group: f"{', '.join(GROUPS[group])}: {len(scenes)} scenes"
            for group, scenes in groups.items()
        },
        "fill": FILL,
        "preset": PRESET,
    }
    page.write_text(write_page(facts, figures))
    print(f"Wrote {page}")
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/claim", arguments, work))
