"""Command line of scripts/ablation."""

import argparse
import concurrent.futures
import json
import os
import statistics
import sys
from pathlib import Path

from benchmark_lib import cases
from benchmark_lib.detection import Bench
from benchmark_lib.programs import Progress, provenance, run_script
from real_scan_lib.measurement import RealScan, write_images
from real_scan_lib.scans import image_draws

from .copies import REAL_PART, CopiedBench, copy_bins, reliable_poses
from .edited_core import EditedCore
from .report import write_page
from .rows import ROWS
from .steps import STEPS

SEEDS = (1, 2, 3, 4)  # of the noise
ALL_ROWS = ROWS + STEPS
FILL = 16  # of the package's own scenes
OWN_SEED = 201  # of these scenes; not the benchmark's, as decisions are taken here


def arguments():
    names = [row.name for row in ALL_ROWS]
    parser = argparse.ArgumentParser(
        prog="scripts/ablation",
        description="Changes one setting at a time, or leaves a step out, and measures what it does; writes a report. What was done before is not done again.",
    )
    data = Path(os.environ.get("PPF_BIN_PICKING_DATA", "../shared/data"))
    parser.add_argument("--data", type=Path, default=data, help="holds bins and real/pins")
    parser.add_argument("--rows", nargs="+", choices=names, metavar="NAME", help=", ".join(names))
    parser.add_argument("--seeds", nargs="+", type=int, default=list(SEEDS), help="of the noise")
    parser.add_argument("--folder", type=Path, default=Path("build/ablation"))
    parser.add_argument(
        "--report",
        type=Path,
        help="default: docs/ablation.md if all is measured, else ablation.md in the folder",
    )
    return parser.parse_args()


def one_a_part(scenes):
    """The last scene of each part: the fullest bins, and the coarsest sensor."""
    return list({scene.part: scene for scene in scenes}.values())


def write_configs(folder, rows):
    """Settings files of the rows. Returns their paths by the rows' names."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {}
    for row in rows:
        paths[row.name] = folder / f"{row.name}.yaml"
        lines = [f"{key}: {json.dumps(value)}\n" for key, value in row.settings.items()]
        paths[row.name].write_text("".join(lines) or "{}\n")
    return paths


class Ablation:
    """The three sets of scenes, and what a row's settings do to them."""

    def __init__(self, options, rows):
        folder = options.folder.resolve()
        configs = write_configs(folder / "configs", rows)
        self.bins = CopiedBench(folder / "bins", configs)
        self.real = RealScan(folder / "real", options.data / "real/pins", configs)
        self.own = Bench(folder / "own", configs)
        core = EditedCore(folder / "core")
        cores = {row.name: core.library(row) for row in rows if row.edits}
        for bench in (self.bins, self.real, self.own):
            bench.cores = cores
            bench.trained_as = {row.name: ROWS[0].name for row in rows if not row.trains}
        self.bin_scenes = copy_bins(options.data / "bins", self.bins, options.seeds)
        self.draws = image_draws(options.data / "real/pins")
        self.images = write_images(self.real, self.draws)
        self.own_scenes = [
            cases.Scene(part, FILL, preset, OWN_SEED)
            for part in cases.all_parts()
            for preset in cases.PRESETS
        ]
        self.own.simulate_all(self.own_scenes)

    def measure(self, row):
        """Figures of a row."""
        every_bin = [scene for scenes in self.bin_scenes.values() for scene in scenes]
        self.own.detect_side_by_side(row.name, self.own_scenes)
        self.bins.detect_side_by_side(row.name, every_bin)
        judged = [(self.own, "ablation", self.own_scenes)]
        judged += [(self.bins, f"seed-{k}", scenes) for k, scenes in self.bin_scenes.items()]

        def judge(bench, name, scenes):
            return bench.evaluate(name, row.name, scenes)["summary"]

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            own, *bins = pool.map(judge, *zip(*judged))
        return {"bins": bins, "own": own, **self.real_figures(row.name)}

    def real_figures(self, variant):
        """Of the real scan: reliable poses in the part's bin, as it is and of each of its variants, how many of each are not right,
        and reliable poses in the other bins, as they are."""
        pins = [scenes[REAL_PART] for scenes in self.images.values()]
        as_it_is = next(iter(self.images.values()))
        others = [scene for region, scene in as_it_is.items() if region != REAL_PART]
        self.real.detect_side_by_side(variant, pins + others)
        verdicts = [
            self.real.verdicts(scene, scan.turn, variant)
            for scene, scan in zip(pins, self.draws.values())
        ]
        return {
            "pins": [sum(counts) for counts in verdicts],
            "not_right": [sum(counts[1:]) for counts in verdicts],
            "others": sum(reliable_poses(self.real, variant, scene) for scene in others),
        }

    def relative_times(self, rows):
        """Of each row, over the first one: median over a scene of each part. All rows meet a scene one after the other,
        so that a machine that gets slower does so for all of them."""
        ratios = {row.name: [] for row in rows}
        first_bins = next(iter(self.bin_scenes.values()))
        scenes = [(self.bins, scene) for scene in one_a_part(first_bins)]
        scenes += [(self.own, scene) for scene in one_a_part(self.own_scenes)]
        progress = Progress("times", len(scenes))
        for bench, scene in scenes:
            times_ms = [bench.time_ms(row.name, scene) for row in rows]
            for row, time_ms in zip(rows, times_ms):
                ratios[row.name].append(time_ms / times_ms[0])
            progress.step(f"{scene.part} {scene.name}", True)
        return {name: statistics.median(values) for name, values in ratios.items()}


def work(options):
    """Returns the exit status."""
    rows = [row for row in ALL_ROWS if row.name in (options.rows or [row.name])]
    if rows[0].name != ROWS[0].name:
        rows.insert(0, ROWS[0])  # what the others are compared with
    ablation = Ablation(options, rows)
    figures = {row.name: ablation.measure(row) for row in rows}
    for name, ratio in ablation.relative_times(rows).items():
        figures[name]["time"] = ratio
    (options.folder / "figures.json").write_text(json.dumps(figures, indent=1))
    complete = not options.rows and tuple(options.seeds) == SEEDS
    page = options.report or (Path("docs") if complete else options.folder) / "ablation.md"
    facts = {
        **provenance("scripts/ablation"),
        "folder": options.folder,
        "seeds": len(options.seeds),
        "fill": FILL,
        "own_seed": OWN_SEED,
        "left_out": [row.name for row in ALL_ROWS if row not in rows],
    }
    page.write_text(write_page(facts, rows, figures))
    print(f"Wrote {page}")
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/ablation", arguments, work))
