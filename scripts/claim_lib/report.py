"""The report as Markdown."""

import math

from benchmark_lib.cases import VARIANT_TEXTS
from benchmark_lib.report import number, table

from .precision import REPEATS, bootstrap

RECALLS = (0.3, 0.5, 0.7)


def precision_table(figures):
    """Precision at each recall by variant."""
    rows = [
        [f"`{variant}`"]
        + [number(None if math.isnan(p) else p, 4) for p in ranked.precision_at(RECALLS)]
        + [number(summary["ALL"][key], 3) for key in ("AP", "precision", "recall")]
        for variant, (ranked, summary) in figures.items()
    ]
    heading = ["variant", *[f"at recall {recall}" for recall in RECALLS]]
    return table([*heading, "AP", "reliable: precision", "recall"], rows)


def interval(low, high):
    return "-" if math.isnan(low) else f"{low:+.4f} to {high:+.4f}"


def difference_table(figures):
    """What the whole detector gains over the others, with intervals."""
    whole, _ = figures["default"]
    rows = []
    for variant, (ranked, _) in figures.items():
        if variant == "default":
            continue
        gains = whole.precision_at(RECALLS) - ranked.precision_at(RECALLS)
        ends = bootstrap(ranked, whole, RECALLS)
        cells = [f"{gain:+.4f} ({interval(low, high)})" for gain, low, high in zip(gains, *ends)]
        rows.append([f"`default` less `{variant}`", *cells])
    return table(["difference", *[f"at recall {recall}" for recall in RECALLS]], rows)


def part_table(figures):
    """Precision at the middle recall and AP by part and variant."""
    parts = [part for part in figures["default"][1] if part != "ALL"]
    heading = ["part"] + [f"{variant} {key}" for variant in figures for key in ("AP", "P", "R")]
    rows = [
        [part]
        + [
            number(summary[part][key], 3)
            for _, summary in figures.values()
            for key in ("AP", "precision", "recall")
        ]
        for part in parts
    ]
    return table(heading, rows)


def introduction(facts):
    """What was done, and how to do it again."""
    groups = "".join(f"- {name}: {text}\n" for name, text in facts["groups"].items())
    variants = "".join(f"- `{name}`: {text}\n" for name, text in VARIANT_TEXTS.items())
    return f"""# Does the mismatch test make poses more trustworthy?

The paper's claim, on simulated scenes that no setting was chosen on: where surfaces can slide over one another, poses are wrong although they score
well, and looking at how the hypotheses spread tells which. This page is written by

    {facts['command']}

which keeps what is done in `{facts['folder']}`. {facts['fill']} parts in each bin, sensor {facts['preset']}. Commit {facts['commit']}; {facts['machine']}.

{groups}
Variants, of one pipeline; all refine, verify and compete alike:

{variants}
Each variant ranks all its poses, those that it calls reliable first, by the number that it trusts: the reliability for `default`, the score for the
others. Precision at a recall is that of the shortest beginning of this list that holds so many of the targets (parts at least half
visible). Intervals hold 95 % of {REPEATS} bootstrap draws of scenes, the same for both variants.

Two things are mixed in `default` less the others: which poses are turned down, and the number that ranks them. The reliability was fitted on other
scenes, but of these same parts. docs/decisions.md has the comparison with every variant ranked by the same number.
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
        ]
    return "\n".join(sections)
