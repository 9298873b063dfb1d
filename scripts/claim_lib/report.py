"""The report as Markdown."""

import json
import math
from collections import Counter
from typing import NamedTuple

import numpy as np
import yaml

from benchmark_lib.cases import PACKAGE, VARIANT_TEXTS, VARIANTS
from benchmark_lib.report import number, table

from .precision import REPEATS, bootstrap

RECALLS = (0.3, 0.5, 0.7, 0.9)
MAX_SPREAD = yaml.safe_load((PACKAGE / "config/detector.yaml").read_text())["max_spread_rel"]
NUMBERS = ("score", "reliability")  # that rank the poses of a variant
PAIRS = (
    ("spread", "original"),
    ("spread", "coverage"),
    ("default", "original"),
    ("default", "coverage"),
    ("default", "spread"),
)


class Measured(NamedTuple):
    """A variant's figures on a group's scenes."""

    ranked: dict  # a Ranking by each of NUMBERS
    summary: dict  # as evaluate_poses writes it
    poses: list  # of all scenes: a pose as detect_poses wrote it, and its verdict


def precision_table(figures):
    """Precision at each recall by variant and the number that ranks its poses."""
    rows = [
        [f"`{variant}` by {key}"]
        + [number(None if math.isnan(p) else p, 4) for p in ranked[key].precision_at(RECALLS)]
        + [number(summary["ALL"][name], 3) for name in ("AP", "precision", "recall")]
        for variant, (ranked, summary, _) in figures.items()
        for key in NUMBERS
    ]
    heading = ["variant", *[f"at recall {recall}" for recall in RECALLS]]
    return table([*heading, "AP", "reliable: precision", "recall"], rows)


def interval(low, high):
    return "-" if math.isnan(low) else f"{low:+.4f} to {high:+.4f}"


def difference_table(figures):
    """What one variant gains over another, both ranked by the same number, with intervals."""
    rows = []
    for better, worse in PAIRS:
        for key in NUMBERS:
            first, second = figures[worse].ranked[key], figures[better].ranked[key]
            gains = second.precision_at(RECALLS) - first.precision_at(RECALLS)
            ends = bootstrap(first, second, RECALLS)
            cells = [f"{g:+.4f} ({interval(low, high)})" for g, low, high in zip(gains, *ends)]
            rows.append([f"`{better}` less `{worse}`, by {key}", *cells])
    return table(["difference", *[f"at recall {recall}" for recall in RECALLS]], rows)


def part_table(figures):
    """AP, precision and recall by part and variant."""
    parts = [part for part in figures["default"].summary if part != "ALL"]
    heading = ["part"] + [f"{variant} {key}" for variant in figures for key in ("AP", "P", "R")]
    rows = [
        [part]
        + [
            number(summary[part][key], 3)
            for _, summary, _ in figures.values()
            for key in ("AP", "precision", "recall")
        ]
        for part in parts
    ]
    return table(heading, rows)


def reason_table(poses):
    """What the detector makes of right and of wrong poses."""
    counts = Counter(
        (pose["reason"] or "none: reliable", verdict)
        for pose, verdict in poses
        if verdict in ("wrong", "right")
    )
    reasons = sorted({reason for reason, _ in counts})
    rows = [[reason, counts[reason, "wrong"], counts[reason, "right"]] for reason in reasons]
    return table(["turned down for", "wrong", "right"], rows)


def spread_table(poses):
    """How the hypotheses of right and of wrong poses spread, all of which the score alone calls reliable."""
    rows = []
    for verdict in ("wrong", "right"):
        spreads = [p["spread"] for p, found in poses if p["reliable"] and found == verdict]
        ends = np.quantile(spreads, (0.5, 0.9)) if spreads else (None, None)
        above = sum(spread > MAX_SPREAD for spread in spreads)
        rows.append([verdict, len(spreads), *[number(end, 2) for end in ends], above])
    heading = ["poses", "count", "median spread", "90 % are below", "above max_spread_rel"]
    return table(heading, rows)


def settings(changed):
    """What a variant changes of the defaults, in brackets."""
    words = [f"{key}: {json.dumps(value)}" for key, value in changed.items()]
    return f" (`{', '.join(words)}`)" if words else ""


def introduction(facts):
    """What was done, and how to do it again."""
    groups = "".join(f"- {name}: {text}\n" for name, text in facts["groups"].items())
    variants = "".join(
        f"- `{name}`: {text}{settings(VARIANTS[name])}\n" for name, text in VARIANT_TEXTS.items()
    )
    return f"""# Does the mismatch test make poses more trustworthy?

The paper's claim, on simulated scenes that no setting was chosen on: where surfaces can slide over one another, poses are wrong although they score
well, and looking at how the hypotheses spread tells which. This page is written by

    {facts['command']}

which keeps what is done in `{facts['folder']}`. {facts['fill']} parts in each bin, sensor {facts['preset']}. Commit {facts['commit']}; {facts['machine']}.

{groups}
Variants, of one pipeline; all refine, verify and compete alike:

{variants}
The poses of each variant are ranked, those that it calls reliable first, by the score and by the reliability. Precision at a recall is that of the shortest
beginning of this list that holds so many of the targets (parts at least half visible). Intervals hold 95 % of {REPEATS} bootstrap draws
of scenes, the same for both variants. The reliability was fitted on other scenes, but of these same parts; docs/reliability.md judges it on parts left out.
docs/decisions.md says what follows.
"""


def write_page(facts, figures):
    """The whole page. figures: by group and variant, a ranking and the summary of evaluate_poses."""
    sections = [introduction(facts)]
    for group, variants in figures.items():
        sections += [
            f"## {group.capitalize()} parts\n\n" + precision_table(variants),
            difference_table(variants),
            "Part by part (P, R: precision and recall of the poses called reliable):\n\n"
            + part_table(variants),
            *[
                f"What `{name}` makes of its poses:\n\n" + reason_table(variants[name].poses)
                for name in ("default", "spread")
            ],
            f"How far the hypotheses of the poses that `coverage` calls reliable spread, in diameters (max_spread_rel: {MAX_SPREAD}):\n\n"
            + spread_table(variants["coverage"].poses),
        ]
    return "\n".join(sections)
