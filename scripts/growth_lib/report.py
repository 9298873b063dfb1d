"""The report as Markdown, and its plots."""

import statistics

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # after the choice of a backend that needs no display

from benchmark_lib.report import table

from .measure import RUNS, slope
from .scenes import COUNT, PART, PRESET, SEED

READING = "preparation"  # the stage that alone looks at every point of the cloud


def rest(figure):
    """Milliseconds of all stages but the one that reads the cloud."""
    return sum(ms for stage, ms in figure["stages"].items() if stage != READING)


def draw(figures, path):
    """Four plots in a row."""
    models = models_of(figures)
    plots = (
        ("million points", figures["points"]),
        ("parts in the bin", figures["counts"]),
        ("noise added [mm]", figures["noise"]),
    )
    drawn, axes = pyplot.subplots(1, 4, figsize=(13, 3))
    for plot, (label, series) in zip(axes, plots):
        xs = list(series)
        plot.plot(xs, [series[x]["ms"] for x in xs], "o-", label="all")
        plot.plot(xs, [series[x]["stages"][READING] for x in xs], "s--", label=READING)
        plot.plot(xs, [rest(series[x]) for x in xs], "^:", label="the rest")
        plot.set_xlabel(label)
    axes[3].plot(list(models), list(models.values()), "o-", label="all, one thread")
    axes[3].set_xlabel("models loaded")
    axes[0].set_ylabel("ms")
    for plot in axes:
        plot.set_ylim(bottom=0)
        plot.legend(fontsize=7)
        plot.grid(alpha=0.3)
    drawn.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    drawn.savefig(path, dpi=80)
    pyplot.close(drawn)


def models_of(figures):
    """Milliseconds by the number of models."""
    found = {
        int(name.split("/")[1]): one["real_time"]
        for name, one in figures["rates"].items()
        if name.startswith("models/")
    }
    return dict(sorted(found.items()))


def series_table(heading, series):
    rows = [
        [value, f"{f['ms']:.0f}", f"{f['stages'][READING]:.0f}", f"{rest(f):.0f}", f["reliable"]]
        + [f"{f['mb']:.0f}"]
        for value, f in series.items()
    ]
    return table([heading, "ms", f"{READING} ms", "other stages ms", "reliable", "MB"], rows)


def triangle_table(series):
    heading = ["triangles", "kept", "training s", "ms", "reliable"]
    rows = [
        [f["triangles"], f["kept"], f"{f['train_s']:.1f}", f"{f['detection']['ms']:.0f}"]
        + [f["detection"]["reliable"]]
        for f in series.values()
    ]
    return table(heading, rows)


def part_table(parts):
    heading = ["part", "training s", "model MB", "at a step of 0.03 D: MB", "s", "ms", "first ms"]
    heading += ["first over median", "one thread ms", "speed-up of the second", "peak MB"]
    rows = []
    for part, f in parts.items():
        one = f["detection"]
        rows.append(
            [part, f"{f['train_s']:.1f}", f"{f['model_mb']:.1f}", f"{f['fine_mb']:.1f}"]
            + [f"{f['fine_s']:.1f}", f"{one['ms']:.0f}", f"{one['first']:.0f}"]
            + [f"{one['first'] / one['ms']:.2f}", f"{f['one_thread_ms']:.0f}"]
            + [f"{f['one_thread_ms'] / one['ms']:.2f}", f"{one['mb']:.0f}"]
        )
    return table(heading, rows)


def rate_table(rates):
    rows = []
    for name, one in rates.items():
        stage = name.split("/")[0]
        if stage == "voting":
            rate = (
                f"{one['votes/s'] / 1e9:.2f} G votes/s, {one['pairs/s'] / 1e6:.0f} M pairs/s of "
                f"{one['votes/s'] / one['pairs/s']:.0f} votes"
            )
            rows.append([name, f"{one['real_time']:.1f}", rate])
        elif stage == "verification":
            rows.append(
                [name, f"{one['real_time']:.1f}", f"{one['pixels/s'] / 1e6:.1f} M pixels/s"]
            )
        elif stage == "loading":
            rows.append([name, f"{one['real_time']:.1f}", "of the model file"])
    return table(["stage", "ms", "rate"], rows)


VOTING = """
A vote reads four bytes in sequence and changes one count in the cache: 1.5 to 2 G votes a second and core are the limit. The rates count the whole
stage, with the search for neighbours, the features of all pairs and the peaks. Between them and the limit stand

- where a pair meets few entries, the pair itself, about 20 ns: of a revolution the table holds one reference point a circle, so that the
  cylinder votes slowly, but for a small part of the votes that a table of all its points would take;
- on curved parts something that was not found. Counts of half the size, fetching more of the table ahead, and counting in four places in turn bring nothing: they take
  0.97 to 1.06 of the time (medians of 3 or 4 runs of tee, cylinder and box).
"""


def introduction(facts):
    return f"""# How time and memory grow

Written by

    {facts['command']}

on simulated scenes: {COUNT} parts (`{PART}` where one part stands for all), sensor {PRESET}, seed {SEED}, one thing changed at a time. Times are
medians of {RUNS} detections of one process, two threads, unless said. Commit {facts['commit']}; {facts['machine']}.
"""


def points_text(points):
    """What one more million points costs."""
    large = [value for value in points if value >= 0.7]
    ms = slope(large, [points[value]["stages"][READING] for value in large])
    others = statistics.mean(rest(points[value]) for value in large)
    spread = [rest(points[value]) for value in large]
    return (
        f"From 0.7 million points on {READING} takes {ms:.0f} ms more for each million; the other stages, which look at an image of the "
        f"part's resolution, {others:.0f} ms in the mean ({min(spread):.0f} to {max(spread):.0f}).\n"
    )


def write_page(facts, figures, picture):
    """The whole page."""
    models = models_of(figures)
    each = slope(list(models), list(models.values()))
    return "\n".join(
        [
            introduction(facts),
            f"![Time against points, parts, noise and models]({picture})\n",
            "## Points of the cloud\n\nThe same scene with more or fewer pixels.\n\n"
            + series_table("million points", figures["points"]),
            points_text(figures["points"]),
            "## Parts in the bin\n\nA bin of fitting size; the camera stands back to see it all.\n\n"
            + series_table("parts", figures["counts"]),
            "## Noise\n\nGaussian, added to the sensor's own.\n\n"
            + series_table("mm", figures["noise"]),
            f"## Models\n\nThat many parts looked for in one pile, one thread, step 0.05 D: {each:.0f} ms more for each.\n\n"
            + table(["models", "ms"], [[count, f"{ms:.0f}"] for count, ms in models.items()]),
            "## Triangles of the mesh\n\nThe same part, its triangles cut into smaller ones; training keeps what its shape needs.\n\n"
            + triangle_table(figures["triangles"]),
            "## Parts\n\nTraining and memory; the first detection of a process; what the second thread brings.\n\n"
            + part_table(figures["parts"]),
            "## Rates\n\nBy `measure_stages`, one thread, step 0.05 D; CONTRIBUTING.md says what is counted.\n\n"
            + rate_table(figures["rates"])
            + VOTING,
        ]
    )
