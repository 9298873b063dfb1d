"""Command line of scripts/benchmark."""

import argparse
import json
import shutil
import sys
from pathlib import Path

from . import cases
from .closed_loop import run_loops
from .detection import Bench, write_configs
from .pictures import draw_curves, draw_scene
from .programs import BenchmarkError, provenance, run_script
from .report import write_report


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/benchmark",
        description="Measures the detector on simulated scenes and writes a report. What was done before is not done again.",
    )
    parser.add_argument("--parts", nargs="+", choices=cases.all_parts(), metavar="PART")
    parser.add_argument("--fills", nargs="+", type=int, metavar="COUNT", help="parts in the bin")
    parser.add_argument("--presets", nargs="+", choices=cases.PRESETS, metavar="PRESET")
    parser.add_argument("--variants", nargs="+", choices=cases.VARIANTS, metavar="VARIANT")
    parser.add_argument(
        "--config",
        nargs="+",
        type=Path,
        default=[],
        metavar="FILE",
        help="settings of the detector to compare with the variants, named by their files",
    )
    parser.add_argument("--no-loops", action="store_true", help="without the closed loops")
    parser.add_argument("--quick", action="store_true", help="three parts, few scenes")
    parser.add_argument("--folder", type=Path, default=Path("build/benchmark"))
    parser.add_argument(
        "--report",
        type=Path,
        help="default: docs/benchmark.md if everything is measured, else benchmark.md in the folder",
    )
    parser.add_argument(
        "--check",
        action="store_true",
        help="do all of it again in another folder, compare the figures, times aside, write nothing",
    )
    return parser.parse_args()


def choose(options):
    """Fills in what is measured."""
    chosen = (options.parts, options.fills, options.presets, options.variants, options.config)
    complete = not any(chosen) and not options.quick and not options.no_loops
    default_report = Path("docs") if complete else options.folder
    options.report = options.report or default_report / "benchmark.md"
    quick = options.quick
    options.parts = options.parts or list(cases.QUICK_PARTS if quick else cases.all_parts())
    options.fills = options.fills or list(cases.QUICK_FILLS if quick else cases.FILLS)
    options.presets = options.presets or list(cases.QUICK_PRESETS if quick else cases.PRESETS)
    options.variants = options.variants or list(cases.VARIANTS)
    options.loop_count = cases.QUICK_LOOP_COUNT if quick else cases.LOOP_COUNT
    missing = [str(file) for file in options.config if not file.is_file()]
    if missing:
        raise BenchmarkError(f"{missing[0]} does not exist: give settings files to --config.")


def views_of(scenes):
    """Groups of scenes by sensor, then by fill."""
    groups = {}
    for name_of in (lambda scene: scene.preset, lambda scene: f"{scene.count} parts"):
        for scene in scenes:
            groups.setdefault(name_of(scene), []).append(scene)
    return groups


def measure(options, folder):
    """Simulates, detects, judges. Returns the bench and the figures of the report."""
    scenes = cases.scene_set(options.parts, options.fills, options.presets)
    configs = write_configs(folder / "configs", options.variants, options.config)
    bench = Bench(folder, configs)
    bench.simulate_all(scenes)
    variants = {}
    for variant in configs:
        bench.detect_all(variant, scenes)
        judged = bench.evaluate("all", variant, scenes)
        judged["settings"] = configs[variant].read_text()
        variants[variant] = judged
    main = next(iter(configs))
    views = {
        name: bench.evaluate(name.replace(" ", "-"), main, group)["summary"]["ALL"]
        for name, group in views_of(scenes).items()
    }
    loops = {} if options.no_loops else run_loops(bench, options.parts, options.loop_count)
    times = {
        part: bench.stage_times(main, [scene for scene in scenes if scene.part == part])
        for part in options.parts
    }
    return bench, {
        "parts": options.parts,
        "scenes": len(scenes),
        "variants": variants,
        "views": views,
        "loops": loops,
        "times": times,
    }


def without_times(figures):
    """What must be equal when everything is done again."""
    times = ("ms", "max_ms", "time_ms", "cycle_s", "times")

    def stripped(node):
        if isinstance(node, dict):
            return {key: stripped(value) for key, value in node.items() if key not in times}
        return [stripped(value) for value in node] if isinstance(node, list) else node

    return stripped(figures)


def difference(first, second, place="figures"):
    """Where two trees of figures first differ; None if nowhere."""
    if type(first) is type(second) and isinstance(first, (dict, list)):
        keys = first if isinstance(first, dict) else range(len(first))
        if len(first) == len(second) and (isinstance(first, list) or set(first) == set(second)):
            found = (difference(first[key], second[key], f"{place}/{key}") for key in keys)
            return next((text for text in found if text), None)
    return None if first == second else f"{place}: {first} and {second}"


def run_facts(options, bench):
    """What the report says about how it was made."""
    return {
        **provenance("scripts/benchmark"),
        "folder": options.folder,
        "fills": ", ".join(map(str, options.fills)),
        "presets": ", ".join(options.presets),
        "loop_count": options.loop_count,
        "picture": picture_scene(options, options.parts[0]).name,
    }


def picture_scene(options, part):
    """The scene that shows a part: the middle fill."""
    preset = "industrial" if "industrial" in options.presets else options.presets[0]
    count = options.fills[len(options.fills) // 2]
    return cases.Scene(part, count, preset, cases.SEED)


def report(options, bench, figures):
    """Writes the page and its pictures."""
    facts = run_facts(options, bench)  # before a file differs from the commit
    images = options.report.parent / "images/benchmark"
    main = next(iter(bench.configs))
    pictures = {}
    for part in options.parts:
        draw_scene(bench, main, picture_scene(options, part), images / f"{part}.jpg")
        pictures[part] = f"images/benchmark/{part}.jpg"
    draw_curves(figures["variants"], options.parts, images / "curves.png")
    text = write_report(figures, facts, pictures, "images/benchmark/curves.png")
    options.report.write_text(text)
    print(f"Wrote {options.report}")


def check(options):
    """Does everything twice. Returns the exit status."""
    again = options.folder / "check"
    shutil.rmtree(again, ignore_errors=True)
    _, figures = measure(options, options.folder.resolve())
    _, repeated = measure(options, again.resolve())
    found = difference(without_times(figures), without_times(repeated))
    print(f"Not the same again, {found}" if found else "The same figures again, times aside.")
    return 1 if found else 0


def work(options):
    """Returns the exit status."""
    choose(options)
    if options.check:
        return check(options)
    bench, figures = measure(options, options.folder.resolve())
    (options.folder / "figures.json").write_text(json.dumps(figures, indent=1))
    report(options, bench, figures)
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/benchmark", arguments, work))
