"""The report of the fit: figures as Markdown, and the reliability diagram as a picture."""

import math

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # after the choice of a backend that needs no display

from benchmark_lib.report import number, table

from .regression import PENALTY, kept_and_precision, reliability_bins
from .terms import TERMS, code_of
from .training import FOREIGN_SHIFTS, FOREIGN_WEIGHT, SETS
from .usual import MAX_ROUNDS, MOST_USUAL, SETTINGS, SHOWS_USUAL, ZEROS

DEFAULT_THRESHOLD = SETTINGS["min_reliability"]
THRESHOLDS = sorted({0.5, 0.8, DEFAULT_THRESHOLD, 0.9, 0.95})
WITH_RIGHT_ONES = ("own", "shiny")


def share(value, digits=3):
    """Text; a dash for NaN."""
    return number(None if math.isnan(value) else value, digits)


def count_table(poses):
    """How many poses each set has."""
    rows = []
    for name in SETS:
        labels = poses.labels[poses.sets == name]
        rows.append([name, len(labels), int(labels.sum()), SETS[name]])
    return table(["set", "poses", "right", "weight"], rows)


def threshold_table(poses, predicted):
    """Kept share and precision of own and shiny poses, and how many of the foreign ones pass."""
    heading = ["at least", "own kept", "own precision", "shiny kept", "shiny precision"]
    foreign = [name for name in SETS if name not in WITH_RIGHT_ONES]
    rows = []
    for threshold in THRESHOLDS:
        row = [threshold]
        for name in WITH_RIGHT_ONES:
            chosen = poses.sets == name
            figures = kept_and_precision(predicted[chosen], poses.labels[chosen], threshold)
            row += [share(figure) for figure in figures]
        for name in foreign:
            passed = predicted[poses.sets == name] >= threshold
            row.append(f"{passed.sum()} of {len(passed)}")
        rows.append(row)
    return table(heading + [f"{name} passing" for name in foreign], rows)


def part_table(poses, predicted, threshold):
    """Kept share and precision of each part's own and shiny poses by the model of the other parts."""
    rows = []
    for part in sorted(set(poses.parts)):
        row = [part]
        for name in WITH_RIGHT_ONES:
            chosen = (poses.sets == name) & (poses.parts == part)
            figures = kept_and_precision(predicted[chosen], poses.labels[chosen], threshold)
            row += [int(chosen.sum()), *[share(figure) for figure in figures]]
        rows.append(row)
    heading = [
        f"{name} {key}" for name in WITH_RIGHT_ONES for key in ("poses", "kept", "precision")
    ]
    return table(["part", *heading], rows)


def diagrams(poses, predicted):
    """The reliability diagrams of own poses, of shiny ones, and of all as the fit weights them."""
    weights = poses.weights()
    chosen = {name: poses.sets == name for name in WITH_RIGHT_ONES}
    chosen["all, weighted"] = weights > 0
    return {
        name: reliability_bins(predicted[rows], poses.labels[rows], weights[rows])
        for name, rows in chosen.items()
    }


def diagram_table(drawn):
    """Ten bins a line each."""
    heading = ["probability"]
    for name in drawn:
        heading += [f"{name}: count", "predicted", "right"]
    rows = []
    for bins in zip(*drawn.values()):
        row = [f"{bins[0].low:.1f} to {bins[0].high:.1f}"]
        for entry in bins:
            row += [entry.count, share(entry.predicted), share(entry.observed)]
        rows.append(row)
    return table(heading, rows)


def draw_diagram(drawn, path):
    """Observed over predicted shares, and below them the counts."""
    figure, (shares, counts) = pyplot.subplots(
        2, 1, sharex=True, figsize=(5, 6), gridspec_kw={"height_ratios": (3, 1)}
    )
    shares.plot((0, 1), (0, 1), color="grey", linewidth=0.8)
    for k, (name, bins) in enumerate(drawn.items()):
        filled = [entry for entry in bins if entry.count]
        shares.plot(
            [entry.predicted for entry in filled],
            [entry.observed for entry in filled],
            "o-",
            label=name,
            linewidth=1.3,
            markersize=4,
        )
        width = (bins[0].high - bins[0].low) / (len(drawn) + 1)
        left = [entry.low + (k + 1) * width for entry in bins]
        counts.bar(left, [entry.count for entry in bins], width)
    shares.set(ylabel="share of right poses", xlim=(0, 1), ylim=(0, 1.01))
    shares.legend(frameon=False)
    shares.grid(linewidth=0.3)
    counts.set(xlabel="predicted probability, by the model of the other parts", ylabel="poses")
    counts.set_yscale("symlog")
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    pyplot.close(figure)


def term_table(model, means):
    """The fitted terms in words."""
    rows = [
        [f"`{term.name}`: {term.text}", f"{weight:.3f}", f"{mean:.3f}"]
        for term, weight, mean in zip(TERMS, model.weights, means)
    ]
    return table(["term", "weight per unit", "mean of right poses"], rows)


def introduction(facts):
    """What is fitted, and on what."""
    plan = facts["plan"]
    return f"""# How reliable a pose is

`reliability` of a pose is the probability that it is right, `include/ppf_bin_picking/core/reliability.hpp`: a logistic regression over
what verification and the ambiguity tests found. A pose is right if its MSSD over the part's symmetries is below 0.1 diameters, as
`evaluate_poses` judges it. This page is written by

    {facts["command"]}

which makes the scenes, runs the detector, fits, prints the lines for `src/core/reliability.cpp`, and keeps what is done in
`{facts["folder"]}`. Repeat it where a change moves one of the terms. Commit {facts["commit"]}.

## Scenes

Parts {", ".join(plan.parts)}; seeds {", ".join(map(str, plan.seeds))}, {", ".join(map(str, plan.fills))} parts in the bin, sensors
{", ".join(plan.presets)}, all by `simulate_scene`.

- **own**: the part's poses in its own scenes.
- **shiny**: the same in copies of the scenes of the cleaner sensors in which slanted surfaces and outlines are lost, as they are
  where shiny parts mirror the light away. In some regions the surface behind shows through, as in depth images
  aligned to another camera (`scripts/reliability_lib/shiny.py`).
- **foreign**: poses of each part in scenes of {plan.foreign_fill()} other parts, those {", ".join(map(str, FOREIGN_SHIFTS))} places further in the list; all of
  them are wrong. They weigh {FOREIGN_WEIGHT}, as a bin rarely holds other parts.
"""


def figures_text(poses, predicted, drawn):
    """The tables of how well a part's poses are judged by a model that never saw the part."""
    return f"""## How good it is

Every figure is for poses of a part left out of the fit: one fit a part, judged on the part that it does not
know. *Kept* is the share of the right poses that have at least this probability, *precision* the share of right ones among the poses that have.

{threshold_table(poses, predicted)}
Part by part at {DEFAULT_THRESHOLD}, the default of `min_reliability`:

{part_table(poses, predicted, DEFAULT_THRESHOLD)}
Whether the probability is one: of the poses with a probability in each range, the mean of it and the share of right ones. The last columns
are all sets as the fit weights them.

{diagram_table(drawn)}"""


def write_page(facts, poses, fitted, predicted, drawn, picture):
    """The whole page. fitted: model and means of right poses; picture: path relative to the page."""
    model, means = fitted
    return "\n".join(
        [
            introduction(facts) + "\n" + count_table(poses),
            f"""## The fit

The negative log-likelihood plus {PENALTY / 2:g} times the squared weights of the standardised terms is least (L-BFGS-B), under the
condition that no weight has the wrong sign: what speaks for a pose is not turned against it by chance. Intercept {model.intercept:.3f}.

What is looked through counts beyond what is usual: sensors lose flanks and rims and show what lies behind them, at all parts of a scene alike. Of a pose
it is the median over the scene's other poses that pass all gates with a probability of at least {SHOWS_USUAL} while nothing is usual, and over {ZEROS} zeros; {MOST_USUAL} at most.
The fit and what is usual by it are found in turn, until the weights stay or {MAX_ROUNDS} times.

{term_table(model, means)}
As lines of `src/core/reliability.cpp`:

```cpp
{code_of(model, means)}```
""",
            figures_text(poses, predicted, drawn) + f"\n![Reliability diagram]({picture})\n",
        ]
    )
