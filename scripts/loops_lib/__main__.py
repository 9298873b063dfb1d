"""Command line of scripts/loops."""

import argparse
import sys
from pathlib import Path

from benchmark_lib.cases import all_parts
from benchmark_lib.closed_loop import run_loops
from benchmark_lib.detection import Bench
from benchmark_lib.programs import provenance, run_script

from .report import write_page

COUNT = 20  # parts in the bin
SEEDS = (11, 12, 13)  # not the benchmark's


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/loops",
        description="Empties simulated bins and counts wrong picks; writes a report. What was done before is not done again.",
    )
    parser.add_argument("--parts", nargs="+", choices=all_parts(), metavar="PART")
    parser.add_argument("--seeds", nargs="+", type=int, default=list(SEEDS), metavar="SEED")
    parser.add_argument("--count", type=int, default=COUNT, help="parts in the bin")
    parser.add_argument("--folder", type=Path, default=Path("build/loops"))
    parser.add_argument(
        "--report",
        type=Path,
        help="default: docs/loops.md if everything is run, else loops.md in the folder",
    )
    return parser.parse_args()


def work(options):
    """Returns the exit status."""
    complete = not options.parts and options.seeds == list(SEEDS) and options.count == COUNT
    bench = Bench(options.folder.resolve(), {})
    bench.folder.joinpath("loops").mkdir(parents=True, exist_ok=True)
    loops = run_loops(bench, options.parts or all_parts(), options.count, options.seeds)
    facts = {
        **provenance("scripts/loops"),
        "folder": options.folder,
        "count": options.count,
        "seeds": options.seeds,
    }
    page = options.report or (Path("docs") if complete else options.folder) / "loops.md"
    page.write_text(write_page(facts, loops))
    print(f"Wrote {page}")
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/loops", arguments, work))
