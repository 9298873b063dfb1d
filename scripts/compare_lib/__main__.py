"""Command line of scripts/compare."""

import argparse
import json
import os
import sys
from pathlib import Path

from benchmark_lib.programs import provenance, run, run_script

from .comparison import PEERS, Comparison, find_scenes
from .report import write_page


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/compare",
        description="Measures this detector, PCL's and OpenCV's on the same scenes and writes a report. What was done before is not done again.",
    )
    data = Path(os.environ.get("PPF_BIN_PICKING_DATA", "../shared/data"))
    parser.add_argument("--data", type=Path, default=data / "bins", help="<part>/<scene>/gt.json")
    parser.add_argument("--parts", nargs="+", metavar="PART")
    parser.add_argument("--scenes", nargs="+", metavar="SCENE")
    parser.add_argument("--peers", nargs="+", choices=PEERS, default=list(PEERS))
    parser.add_argument("--time-limit", type=int, default=600, metavar="S", help="of one detection")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="runs of this detector")
    parser.add_argument(
        "--opencv-scene-step",
        type=float,
        default=0.03,
        metavar="SHARE",
        help="OpenCV's sampling of the scene, relative to its extent (default: OpenCV's own)",
    )
    parser.add_argument("--folder", type=Path, default=Path("build/compare"))
    parser.add_argument(
        "--report",
        type=Path,
        help="default: docs/performance.md if all is compared, else performance.md in the folder",
    )
    return parser.parse_args()


def report_path(options):
    """Where the page goes."""
    complete = not options.parts and not options.scenes and options.peers == list(PEERS)
    return options.report or (Path("docs") if complete else options.folder) / "performance.md"


def run_facts(options):
    """What the page says about how it was made."""
    return {
        **provenance("scripts/compare"),
        "limit_s": options.time_limit,
        "repeat": options.repeat,
        "opencv_scene_step": options.opencv_scene_step,
        "build": json.loads(run("compare_detectors", "--facts")),
    }


def work(options):
    """Returns the exit status."""
    data = options.data.resolve()
    scenes = find_scenes(data, options.parts, options.scenes)
    comparison = Comparison(options.folder.resolve(), data, scenes, options)
    comparison.measure()
    figures = {peer: comparison.figures(peer) for peer in options.peers}
    page = report_path(options)
    page.write_text(write_page(run_facts(options), figures))
    print(f"Wrote {page}")
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/compare", arguments, work))
