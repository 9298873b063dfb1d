"""Command line of scripts/growth."""

import argparse
import sys
from pathlib import Path

from benchmark_lib.cases import Scene, all_parts
from benchmark_lib.programs import provenance, run_script

from .measure import detect, run_measured, stage_rates
from .report import draw, write_page
from .scenes import PART, PRESET, SEED, Scenes

MILLIONS = (0.1, 0.2, 0.4, 0.7, 1.0, 2.0, 4.0)  # of points
COUNTS = (5, 10, 20, 40, 70, 100)
NOISE_MM = (0, 0.05, 0.1, 0.2, 0.4, 0.8)
FINE_STEP = 0.03


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/growth",
        description="Measures how time and memory grow with the cloud, the parts, the models and the noise; writes a report.",
    )
    parser.add_argument("--folder", type=Path, default=Path("build/growth"))
    parser.add_argument("--report", type=Path, default=Path("docs/growth.md"))
    return parser.parse_args()


def train(scenes, part, config=None):
    """Returns the model file, seconds, and the largest resident size [MB]."""
    model = scenes.folder / f"{part}{'-fine' if config else ''}.ppf"
    settings = ("--config", config) if config else ()
    _, seconds, resident_mb = run_measured(
        "train_model", "--part", scenes.part_file(part), *settings, "--output", model
    )
    return model, seconds, resident_mb


def measure_parts(scenes, output):
    """Of each part: training, model, detection."""
    fine = scenes.folder / "fine.yaml"
    fine.write_text(f"step_rel: {FINE_STEP}\n")
    figures = {}
    for part in all_parts():
        print(f"memory and threads: {part}", flush=True)
        model, seconds, training_mb = train(scenes, part)
        scene = scenes.bench.scene_arguments(scenes.standard(part))
        two = detect(scenes, model, scene, output, part=part)
        one = detect(scenes, model, scene, output, threads=1, part=part)
        fine_model, fine_seconds, _ = train(scenes, part, fine)
        figures[part] = {
            "train_s": seconds,
            "train_mb": training_mb,
            "model_mb": model.stat().st_size / 2**20,
            "fine_mb": fine_model.stat().st_size / 2**20,
            "fine_s": fine_seconds,
            "detection": two,
            "one_thread_ms": one["ms"],
        }
    return figures


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
    model, _, _ = train(scenes, PART)

    def found(scene):
        return detect(scenes, model, scene, output)

    figures = {
        "points": series("points", MILLIONS, lambda value: found(scenes.of_points(value))),
        "counts": series("parts", COUNTS, lambda value: found(scenes.of_count(value))),
        "noise": series("noise", NOISE_MM, lambda value: found(scenes.of_noise(value))),
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
