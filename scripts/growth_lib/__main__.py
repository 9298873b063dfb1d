"""Command line of scripts/growth."""

import argparse
import re
import sys
from pathlib import Path

from benchmark_lib.cases import Scene, all_parts
from benchmark_lib.programs import provenance, run_script

from .measure import detect, stage_rates, train
from .report import draw, write_page
from .scenes import COUNT, PART, PRESET, SEED, Scenes

MILLIONS = (0.1, 0.2, 0.4, 0.7, 1.0, 2.0, 4.0)  # of points
COUNTS = (5, 10, 20, 40, 70, 100)
NOISE_MM = (0, 0.05, 0.1, 0.2, 0.4, 0.8)
SUBDIVISIONS = (0, 1, 2, 3)
FINE_STEP = 0.03
KEPT = re.compile(r"mesh simplified from \d+ to (\d+) triangles")


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/growth",
        description="Measures how time and memory grow with the cloud, the parts, the models, the noise and the mesh; writes a report.",
    )
    parser.add_argument("--folder", type=Path, default=Path("build/growth"))
    parser.add_argument("--report", type=Path, default=Path("docs/growth.md"))
    return parser.parse_args()


def measure_parts(scenes, output):
    """Of each part: training, model, detection."""
    fine = scenes.folder / "fine.yaml"
    fine.write_text(f"step_rel: {FINE_STEP}\n")
    figures = {}
    for part in all_parts():
        print(f"memory and threads: {part}", flush=True)
        part_file = scenes.part_file(part)
        model, fine_model = scenes.folder / f"{part}.ppf", scenes.folder / f"{part}-fine.ppf"
        _, seconds = train(part_file, model)
        scene = scenes.bench.scene_arguments(scenes.standard(part))
        two = detect(part_file, model, scene, output)
        one = detect(part_file, model, scene, output, threads=1)
        _, fine_seconds = train(part_file, fine_model, fine)
        figures[part] = {
            "train_s": seconds,
            "model_mb": model.stat().st_size / 2**20,
            "fine_mb": fine_model.stat().st_size / 2**20,
            "fine_s": fine_seconds,
            "detection": two,
            "one_thread_ms": one["ms"],
        }
    return figures


def measure_triangles(scenes, times, output):
    """Training from a mesh whose triangles are cut into four some times, and a detection."""
    part_file, triangles = scenes.of_triangles(times)
    model = part_file.with_suffix(".ppf")
    printed, seconds = train(part_file, model)
    kept = KEPT.search(printed)
    return {
        "triangles": triangles,
        "kept": int(kept[1]) if kept else triangles,
        "train_s": seconds,
        "detection": detect(part_file, model, scenes.of_count(COUNT), output),
    }


def series(name, values, measure):
    """A detection of each value."""
    figures = {}
    for value in values:
        print(f"{name}: {value}", flush=True)
        figures[value] = measure(value)
    return figures


def work(options):
    """Returns the exit status."""
    folder = options.folder.resolve()
    scenes = Scenes(folder)
    scenes.simulate(
        [scenes.standard(part) for part in all_parts()]
        + [Scene(PART, count, PRESET, SEED) for count in COUNTS]
    )
    output = folder / "result.json"
    model = folder / f"{PART}.ppf"
    train(scenes.part_file(), model)

    def found(scene):
        return detect(scenes.part_file(), model, scene, output)

    figures = {
        "points": series("points", MILLIONS, lambda value: found(scenes.of_points(value))),
        "counts": series("parts", COUNTS, lambda value: found(scenes.of_count(value))),
        "noise": series("noise", NOISE_MM, lambda value: found(scenes.of_noise(value))),
        "triangles": series(
            "triangles", SUBDIVISIONS, lambda value: measure_triangles(scenes, value, output)
        ),
        "parts": measure_parts(scenes, output),
        "rates": stage_rates("voting/|verification|models|loading", folder / "stages.json"),
    }
    facts = provenance("scripts/growth")
    picture = options.report.parent / "images/growth.png"
    draw(figures, picture)
    options.report.write_text(write_page(facts, figures, "images/growth.png"))
    print(f"Wrote {options.report}")
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/growth", arguments, work))
