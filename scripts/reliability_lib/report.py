"""The report of the fit: figures as Markdown, and the reliability diagram as a picture."""

import math
from dataclasses import dataclass

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # after the choice of a backend that needs no display

from benchmark_lib.report import number, table

from .coarse import PIXELS
from .regression import PENALTY, Model, kept_and_precision, reliability_bins
from .terms import TERMS
from .training import (
    COARSE_PRESETS,
    FITS,
    FOREIGN,
    FOREIGN_SHIFTS,
    FOREIGN_WEIGHT,
    OPEN_PRESETS,
    Poses,
    SHINY_PRESETS,
)
from .usual import MAX_ROUNDS, MOST_USUAL, SETTINGS, SHOWS_USUAL, ZEROS

DEFAULT_THRESHOLD = SETTINGS["min_reliability"]
TITLES = {
    "region": "Searches within a region of interest",
    "whole_cloud": "Searches of the whole cloud",
}
THRESHOLDS = sorted({0.5, 0.8, DEFAULT_THRESHOLD, 0.95, 0.98})


@dataclass(frozen=True)
class Fitted:
    """One of FITS, and what the models without each part predict."""

    name: str
    poses: Poses
    weights: np.ndarray
    model: Model
    means: np.ndarray  # of the terms over right poses
    predicted: np.ndarray  # of each pose, by the model of all parts but its own

    @property
    def judged(self):
        """Names of its sets with full weight: what it is for."""
        return [name for name, weight in FITS[self.name].items() if weight == 1]

    @property
    def picture(self):
        """Path relative to the page."""
        return f"images/reliability_{self.name}.png"

    @property
    def title(self):
        return TITLES[self.name]

    def rows(self, name):
        """Which poses are of this set."""
        return self.poses.sets == name

    def diagrams(self):
        """The reliability diagrams of each judged set, and of all as the fit weights them."""
        chosen = {name: self.rows(name) for name in self.judged}
        chosen["all, weighted"] = self.weights > 0
        return {
            name: reliability_bins(
                self.predicted[rows], self.poses.labels[rows], self.weights[rows]
            )
            for name, rows in chosen.items()
        }


def share(value, digits=3):
    """Text; a dash for NaN."""
    return number(None if math.isnan(value) else value, digits)


def count_table(fitted):
    """How many poses each set has."""
    rows = []
    for name, weight in FITS[fitted.name].items():
        labels = fitted.poses.labels[fitted.rows(name)]
        rows.append([name, len(labels), int(labels.sum()), weight])
    return table(["set", "poses", "right", "weight"], rows)


def threshold_table(fitted):
    """Kept share and precision of the judged sets, and how many of the foreign poses pass."""
    rows = []
    for threshold in THRESHOLDS:
        row = [threshold]
        for name in fitted.judged:
            chosen = fitted.rows(name)
            labels = fitted.poses.labels[chosen]
            figures = kept_and_precision(fitted.predicted[chosen], labels, threshold)
            row += [share(figure) for figure in figures]
        for name in FOREIGN:
            passed = fitted.predicted[fitted.rows(name)] >= threshold
            row.append(f"{passed.sum()} of {len(passed)}")
        rows.append(row)
    heading = [f"{name} {key}" for name in fitted.judged for key in ("kept", "precision")]
    return table(["at least", *heading, *[f"{name} passing" for name in FOREIGN]], rows)


def passing_table(fitted):
    """What the reliability and the other gates let through together, of all sets."""
    passing = fitted.poses.gates & (fitted.predicted >= DEFAULT_THRESHOLD)
    rows = []
    for name in FITS[fitted.name]:
        labels = fitted.poses.labels[fitted.rows(name)]
        passed = passing[fitted.rows(name)]
        rows.append([name, int(labels.sum()), int(labels[passed].sum())])
        rows[-1] += [int(passed.sum() - labels[passed].sum())]
    return table(["set", "right", "right ones passing", "wrong ones passing"], rows)


SURE = 0.98


def summary(fitted):
    """How far the probability holds where poses are picked, and of which parts the least of them are right."""
    chosen = np.isin(fitted.poses.sets, fitted.judged) & (fitted.predicted >= DEFAULT_THRESHOLD)
    sure = chosen & (fitted.predicted >= SURE)
    promises = [
        f"{share(np.mean(fitted.predicted[rows]))} promised, {share(np.mean(fitted.poses.labels[rows]))} right"
        if rows.any()
        else "none"
        for rows in (sure, chosen & ~sure)
    ]
    right = {
        part: fitted.poses.labels[chosen & (fitted.poses.parts == part)].mean()
        for part in sorted(set(fitted.poses.parts[chosen]))
    }
    worst = ", ".join(f"{part} {share(right[part])}" for part in sorted(right, key=right.get)[:3])
    return f"""From {SURE} on: {promises[0]}. From {DEFAULT_THRESHOLD} to {SURE}: {promises[1]}. Of the poses from {DEFAULT_THRESHOLD} on the fewest are right of {worst}.
"""


def part_table(fitted, threshold):
    """Kept share and precision of each part's poses by the model of the other parts."""
    rows = []
    for part in sorted(set(fitted.poses.parts)):
        row = [part]
        for name in fitted.judged:
            chosen = fitted.rows(name) & (fitted.poses.parts == part)
            labels = fitted.poses.labels[chosen]
            figures = kept_and_precision(fitted.predicted[chosen], labels, threshold)
            row += [int(chosen.sum()), *[share(figure) for figure in figures]]
        rows.append(row)
    keys = ("poses", "kept", "precision")
    heading = [f"{name} {key}" for name in fitted.judged for key in keys]
    return table(["part", *heading], rows)


def diagram_table(fitted):
    """A line a bin."""
    drawn = fitted.diagrams()
    heading = ["probability"]
    for name in drawn:
        heading += [f"{name}: count", "predicted", "right"]
    rows = []
    for bins in zip(*drawn.values()):
        row = [f"{bins[0].low:g} to {bins[0].high:g}"]
        for entry in bins:
            row += [entry.count, share(entry.predicted), share(entry.observed)]
        rows.append(row)
    return table(heading, rows)


def draw_diagram(fitted, path):
    """Observed over predicted shares, and below them the counts."""
    drawn = fitted.diagrams()
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
        widths = [(entry.high - entry.low) / (len(drawn) + 1) for entry in bins]
        left = [entry.low + (k + 1) * width for entry, width in zip(bins, widths)]
        counts.bar(left, [entry.count for entry in bins], widths)
    shares.set(ylabel="share of right poses", xlim=(0, 1), ylim=(0, 1.01))
    shares.set_title(fitted.title, fontsize="medium")
    shares.legend(frameon=False)
    shares.grid(linewidth=0.3)
    counts.set(xlabel="predicted probability, by the model of the other parts", ylabel="poses")
    counts.set_yscale("symlog")
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    pyplot.close(figure)


def term_table(fitted):
    """The fitted terms in words."""
    rows = [
        [f"`{term.name}`: {term.text}", f"{weight:.3f}", f"{mean:.3f}"]
        for term, weight, mean in zip(TERMS, fitted.model.weights, fitted.means)
    ]
    return table(["term", "weight per unit", "mean of right poses"], rows)


def introduction(facts):
    """What is fitted, and on what."""
    plan = facts["plan"]
    return f"""# How reliable a pose is

`reliability` of a pose is the probability that it is right, `include/ppf_bin_picking/core/reliability.hpp`: a logistic regression over
what verification and the ambiguity tests found. A pose is right if its MSSD over the part's symmetries is below 0.1 diameters, as
`evaluate_poses` judges it. Searches within a region of interest and of the whole cloud have weights of their own. This page is written by

    {facts["command"]}

which makes the scenes, runs the detector, fits, prints the lines for `src/core/reliability.cpp`, and keeps what is done in
`{facts["folder"]}`. Repeat it where a change moves one of the terms. Commit {facts["commit"]}.

## Scenes

Parts {", ".join(plan.parts)}; seeds {", ".join(map(str, plan.seeds))}, {", ".join(map(str, plan.fills))} parts in the bin, sensors
{", ".join(plan.presets)}, all by `simulate_scene`.

- **own**: the part's poses in its own scenes.
- **shiny**: the same in copies of the scenes of the sensors {" and ".join(plan.used(SHINY_PRESETS))} in which slanted surfaces and outlines are lost, as they are
  where shiny parts mirror the light away. In some regions the surface behind shows through, as in depth images
  aligned to another camera (`scripts/reliability_lib/shiny.py`).
- **coarse**: the same in clouds of points without order, as coarse as that of a simple sensor: every so many-th pixel of the scenes of the sensors
  {" and ".join(plan.used(COARSE_PRESETS))}, {PIXELS[0]} to {PIXELS[1]} along the part's longest side (`scripts/reliability_lib/coarse.py`).
- **open**: the same in the scenes of the sensors {" and ".join(plan.used(OPEN_PRESETS))} without their region of interest: the bin's walls and rim and the table
  are in sight. **open, coarse**: the clouds of `coarse` without it.
- **foreign**: poses of each part in scenes of {plan.foreign_fill()} other parts, those {", ".join(map(str, FOREIGN_SHIFTS))} places further in the list; all of
  them are wrong. They weigh {FOREIGN_WEIGHT}, as a bin rarely holds other parts.

In the fit for searches of the whole cloud `shiny`, `foreign` and `foreign, shiny` are the poses found within a region, with less weight: poses of shiny parts and on other
parts look the same there, and the open scenes hold none.

How well the probabilities hold is told for poses of a part left out of the fit: one fit a part, judged on the part that it does not know. *Kept* is
the share of the right poses that have at least this probability, *precision* the share of right ones among the poses that have; the other gates are not asked.
"""


def fit_section(fitted):
    """One fit's tables."""
    return f"""## {fitted.title}

{count_table(fitted)}
{threshold_table(fitted)}
{summary(fitted)}
With a probability of {DEFAULT_THRESHOLD}, the default of `min_reliability`, and through all other gates while nothing is usual:

{passing_table(fitted)}
Part by part at {DEFAULT_THRESHOLD}:

{part_table(fitted, DEFAULT_THRESHOLD)}
Whether the probability is one: of the poses with a probability in each range, the mean of it and the share of right ones. The last columns
are all sets as the fit weights them.

{diagram_table(fitted)}
![Reliability diagram: {fitted.title.lower()}]({fitted.picture})

The fit to all parts; intercept {fitted.model.intercept:.3f}.

{term_table(fitted)}"""


def method_section(code):
    """How both fits are made, and what they give."""
    return f"""## The fits

The negative log-likelihood plus {PENALTY / 2:g} times the squared weights of the standardised terms is least (L-BFGS-B), under the
condition that no weight has the wrong sign: what speaks for a pose is not turned against it by chance.

What is looked through counts beyond what is usual: sensors lose flanks and rims and show what lies behind them, at all parts of a scene alike. Of a pose
it is the median over the scene's other poses that pass all gates with a probability of at least {SHOWS_USUAL} while nothing is usual, and over {ZEROS} zeros; {MOST_USUAL} at most.
The fit and what is usual by it are found in turn, until the weights stay or {MAX_ROUNDS} times.

As lines of `src/core/reliability.cpp`:

```cpp
{code}```
"""


def write_page(facts, fits, code):
    """The whole page."""
    sections = [introduction(facts), *map(fit_section, fits), method_section(code)]
    return "\n".join(sections)
