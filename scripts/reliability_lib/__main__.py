"""Command line of scripts/fit_reliability."""

import argparse
import sys
from pathlib import Path

import numpy as np

from benchmark_lib.cases import all_parts
from benchmark_lib.detection import write_configs
from benchmark_lib.programs import BenchmarkError, provenance, run_script

from .report import Fitted, diagram_table, draw_diagram, threshold_table, write_page
from .terms import SIGNS, code_of
from .training import FITS, VARIANT, Plan, Training, collect
from .usual import fit, predict_left_out, without_usual

QUICK_PARTS = ("bolt", "box")
QUICK_PLAN = {"seeds": (101,), "fills": (24,), "presets": ("industrial",)}


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/fit_reliability",
        description="Fits the weights of src/core/reliability.cpp on simulated scenes and writes a report. What was done before is not done again.",
    )
    parser.add_argument("--parts", nargs="+", choices=all_parts(), metavar="PART")
    parser.add_argument("--quick", action="store_true", help="two parts, one scene each")
    parser.add_argument("--folder", type=Path, default=Path("build/reliability"))
    parser.add_argument(
        "--report",
        type=Path,
        help="default: docs/reliability.md if everything is used, else reliability.md in the folder",
    )
    return parser.parse_args()


def choose(options):
    """What is simulated; fills in where the report goes."""
    complete = not options.parts and not options.quick
    default_report = Path("docs") if complete else options.folder
    options.report = options.report or default_report / "reliability.md"
    parts = options.parts or (QUICK_PARTS if options.quick else all_parts())
    parts = tuple(dict.fromkeys(parts))
    if len(parts) < 2:
        raise BenchmarkError("One part cannot be judged by the others: name two or more.")
    return Plan(parts, **(QUICK_PLAN if options.quick else {}))


def fit_all(poses, weights):
    """The model of all parts with the means of its terms over right poses, and what models without each part predict."""
    for part in sorted(set(poses.parts)):
        if len(set(poses.labels[poses.parts != part])) < 2:
            raise BenchmarkError(
                f"Without {part} all poses are right, or all wrong: take more parts."
            )
    model = fit(poses.terms, poses.labels, weights, poses.gates, poses.scenes, SIGNS)
    right = poses.labels == 1
    beyond = without_usual(model, poses.terms, poses.gates, poses.scenes)
    means = np.average(beyond[right], axis=0, weights=weights[right])
    predicted = predict_left_out(
        poses.terms, poses.labels, weights, poses.parts, poses.gates, poses.scenes, SIGNS
    )
    return (model, means), predicted


def fit_of(name, poses):
    """One of FITS with its figures."""
    chosen, weights = poses.of_fit(name)
    (model, means), predicted = fit_all(chosen, weights)
    return Fitted(name, chosen, weights, model, means, predicted)


def run_facts(options, plan):
    """What the report says about how it was made."""
    return {
        **provenance("scripts/fit_reliability"),
        "folder": options.folder,
        "plan": plan,
    }


def report(options, plan, poses):
    """Fits, prints the figures, writes the page and its pictures."""
    facts = run_facts(options, plan)  # before a file differs from the commit
    fits = [fit_of(name, poses) for name in FITS]
    code = code_of([(fitted.model, fitted.means) for fitted in fits])
    print(code)
    for fitted in fits:
        print(f"{fitted.name}\n\n{threshold_table(fitted)}\n{diagram_table(fitted)}")
        draw_diagram(fitted, options.report.parent / fitted.picture)
    options.report.write_text(write_page(facts, fits, code))
    print(f"Wrote {options.report}")


def work(options):
    """Returns the exit status."""
    plan = choose(options)
    folder = options.folder.resolve()
    bench = Training(folder, write_configs(folder / "configs", [VARIANT], []))
    report(options, plan, collect(plan, bench))
    return 0


if __name__ == "__main__":
    sys.exit(run_script("scripts/fit_reliability", arguments, work))
