"""The report as Markdown."""

import statistics

from benchmark_lib.report import number, table

from .copies import NOISE_M

# Columns of the evaluation scenes by part: heading, key of evaluate_poses, digits.
COLUMNS = (
    ("AP", "AP", 3),
    ("precision", "precision", 3),
    ("recall", "recall", 3),
    ("first pick", "first", 2),
    ("right lost", "lost", 3),
    ("mm", "t_mm", 3),
    ("degrees", "r_deg", 3),
)
KEYS = ("AP", "precision", "recall")


def mean(values):
    """None if one of them does not exist."""
    values = list(values)
    return None if None in values else statistics.mean(values)


def over_seeds(bins, part, key):
    """Mean of a figure of the evaluation scenes."""
    return mean(seed[part][key] for seed in bins)


def step_table(rows, figures):
    """One line a row."""
    heading = ["setting or step", "AP", "P", "R", "own AP", "own P", "own R", "pins", "mean pins"]
    heading += ["not right", "other bins", "time"]
    lines = []
    for row in rows:
        figure = figures[row.name]
        lines.append(
            [f"`{row.name}`"]
            + [number(over_seeds(figure["bins"], "ALL", key), 3) for key in KEYS]
            + [number(figure["own"]["ALL"][key], 3) for key in KEYS]
            + [figure["pins"][0], number(statistics.mean(figure["pins"]), 1)]
            + [number(statistics.mean(figure["not_right"]), 1), figure["others"]]
            + [number(figure["time"], 2)]
        )
    return table(heading, lines)


def seed_table(bins):
    """The first row's figures seed by seed, and their mean."""
    lines = [
        [f"seed {i + 1}"] + [number(seed["ALL"][key], digits) for _, key, digits in COLUMNS]
        for i, seed in enumerate(bins)
    ]
    means = [number(over_seeds(bins, "ALL", key), digits) for _, key, digits in COLUMNS]
    return table(["noise", *[heading for heading, _, _ in COLUMNS]], [*lines, ["mean", *means]])


def part_table(bins):
    """The first row's means by part."""
    lines = [
        [part] + [number(over_seeds(bins, part, key), digits) for _, key, digits in COLUMNS]
        for part in bins[0]
    ]
    return table(["part", *[heading for heading, _, _ in COLUMNS]], lines)


def settings_text(row):
    settings = ", ".join(f"{key}: {value}" for key, value in row.settings.items())
    return row.what or settings or "the defaults"


def decisions(rows):
    """A line for each row; what was decided, where it was."""
    return "".join(
        f"- `{row.name}` ({settings_text(row)}){': ' if row.decision else ''}{row.decision}\n"
        for row in rows
    )


def left_out(names):
    """Which rows the page does not have."""
    if not names:
        return ""
    listed = ", ".join(f"`{name}`" for name in names)
    return f"\nNot measured this time, see `scripts/ablation_lib` and older versions of this page: {listed}.\n"


def introduction(facts):
    """What was done, and how to do it again."""
    return f"""# What each step brings

One setting is changed at a time; everything else stays as config/detector.yaml has it. Steps that no setting turns off are left out of the core's
sources (`scripts/ablation_lib/steps.py`), which are built anew; the reliability stays as it was fitted with them. This page is written by

    {facts['command']}

which keeps what is done in `{facts['folder']}`. Commit {facts['commit']}; {facts['machine']}.

- AP, P, R (precision and recall of the reliable poses): the scenes of `data/bins`, mean over {facts['seeds']} copies with Gaussian noise of
  {NOISE_M * 1000:g} mm added to their depth; the detector itself draws no random numbers. Judged by `evaluate_poses`.
- own: simulated scenes of each of the package's parts, {facts['fill']} in the bin, three sensors, seed {facts['own_seed']}: not those of scripts/benchmark.
- pins: reliable poses on the real scan's bin of pins (about 36 lie there); the mean over it and the turned and noisier variants of scripts/real_scan,
  and how many of these are not right by the colour picture beside the scan, in the mean; the reliable poses in the three bins beside it, where no pin lies and every pose is wrong.
- time: of a whole detection, over that of the first row; median over a scene of each part of the first two sets, which all rows see one after the other.
"""


def write_page(facts, rows, figures):
    """The whole page. figures: of each row, as Ablation.measure gives them."""
    bins = figures[rows[0].name]["bins"]
    return "\n".join(
        [
            introduction(facts) + left_out(facts["left_out"]),
            step_table(rows, figures),
            "## Settings, steps and decisions\n\n" + decisions(rows),
            "## The evaluation scenes, seed by seed\n\n" + seed_table(bins),
            "## ... and by part\n\nMeans over the seeds.\n\n" + part_table(bins),
        ]
    )
