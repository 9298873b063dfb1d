"""The report of the comparison as Markdown."""

import statistics

from benchmark_lib.report import STAGES, number, p95, table

from .comparison import OWN

# The stage of each other detector that the ratios take alone.
ALONE = {"PCL": "align", "OpenCV": "match"}


def done(figures, peer):
    """Results of a peer that did not fail, by scene."""
    return {s: r for s, r in figures[peer]["scenes"].items() if not r["failure"]}


def median(values, digits=0):
    """Text; a dash without values."""
    values = list(values)
    return number(statistics.median(values) if values else None, digits)


def percentile(values):
    values = list(values)
    return number(p95(values) if values else None, 0)


def largest(values):
    return number(max(values, default=None), 0)


def whole_table(figures):
    """One line a peer: times and what its poses are worth."""
    heading = ["detector", "scenes", "failed", "median ms", "p95 ms", "largest ms", "first ms"]
    heading += ["training ms", "cores busy", "peak MB", "scene points", "AP", "precision", "recall"]
    rows = []
    for peer, figure in figures.items():
        results = done(figures, peer).values()
        whole = [result["time_ms"] for result in results]
        first = [result["runs_ms"][0] for result in results if result["runs_ms"]]
        summary = figure["summary"]
        rows.append(
            [peer, len(figure["scenes"]), len(figure["scenes"]) - len(results)]
            + [median(whole), percentile(whole), largest(whole), median(first)]
            + [median(result["train_ms"] for result in results)]
            + [median((result["cores"] for result in results), 2)]
            + [largest(result["peak_mb"] for result in results)]
            + [median(result["points"] for result in results)]
            + [number(summary[key], 3) for key in ("AP", "precision", "recall")]
        )
    return table(heading, rows)


def stage_table(figures):
    """Median and 95th percentile of each stage of each peer."""
    rows = []
    for peer in figures:
        stages = [result["stages_ms"] for result in done(figures, peer).values()]
        found = {name for times in stages for name in times}
        for name in [*filter(found.__contains__, STAGES), *sorted(found - set(STAGES))]:
            times = [of_scene.get(name, 0) for of_scene in stages]
            rows.append([f"{peer}: {name}", median(times, 1), number(p95(times), 1)])
    return table(["stage", "median ms", "p95 ms"], rows)


def ratios(figures, own, other):
    """Of each scene that both did: the other's stage over this detector's whole."""
    ours, theirs = done(figures, own), done(figures, other)
    return [
        theirs[scene]["stages_ms"][ALONE[other]] / ours[scene]["time_ms"]
        for scene in ours
        if scene in theirs
    ]


def ratio_table(figures):
    """How many times slower the others are."""
    rows = []
    for own in filter(figures.__contains__, OWN):
        for other in filter(figures.__contains__, ALONE):
            found = ratios(figures, own, other)
            least = number(min(found, default=None), 1)
            rows.append(
                [f"{other}'s {ALONE[other]} over {own}", len(found), median(found, 1), least]
            )
    return table(["ratio", "scenes", "median", "least"], rows)


def scene_table(figures):
    """Milliseconds of each peer in each scene; why there are none."""
    scenes = next(iter(figures.values()))["scenes"]
    rows = []
    for scene in scenes:
        results = [figure["scenes"][scene] for figure in figures.values()]
        cells = [result["failure"] or f"{result['time_ms']:.0f}" for result in results]
        rows.append([f"{scene.part} {scene.name}", *cells])
    return table(["scene", *figures], rows)


def introduction(facts, figures):
    """What was done, and how to do it again."""
    scenes = next(iter(figures.values()))["scenes"]
    parts = list(dict.fromkeys(scene.part for scene in scenes))
    return f"""# Performance

This detector and the point pair features of PCL and OpenCV on the same scenes, written by

    {facts['command']}

which installs and builds what it needs, runs `compare_detectors` (test/bench/compare) part by part and judges the poses with
`evaluate_poses`. {len(scenes)} scenes of {', '.join(parts)}. Commit {facts['commit']}; {facts['machine']}. One process runs all detectors of
a part; each training and each detection has a child of its own, in which the time is taken, and which is given up
after {facts['limit_s']} s. A detection that failed counts as one without poses, and in no time and no ratio.

How the times grow with the cloud, the parts, the noise and the models tells [growth.md](growth.md):

![Time against points, parts, noise and models](images/growth.png)
"""


def settings(facts):
    """What each detector was given, and how it was built."""
    build = facts["build"]
    return f"""- `fast`, `accurate`: this detector from the raw cloud to the final poses, settings `config/fast.yaml` and the defaults. The
  run with the median time of {facts['repeat']} counts; `first ms` is the first one after training. Threads: one per core, {build['cores']}. Build type
  {build['build_type']}, {build['compiler']}, `{build['flags'].strip()}`.
- `PCL` {build['pcl']}: `PPFRegistration`, model and scene in PCL's own voxel grid of 0.05 diameters, angle step 12 degrees less one
  step of float, every 5th scene point a reference. One thread. It is a template, compiled here, with the same flags; the libraries
  that it calls are the system's. It gives one pose a scene, with the score 1.
- `OpenCV` {build['opencv']}: `surface_matching`, `PPF3DDetector(0.05, 0.05, 30)`, `match` with every 5th scene point a reference and the scene
  sampled at {facts['opencv_scene_step']} of its own extent (0.03 is the default; the code does not relate it to the part, as the documentation
  says); then its `ICP(100, 0.005, 2.5, 8)` for the 30 poses with the
  most votes, whose votes are their score. One thread. The system's library, build type {build['opencv_build_type']}, flags `{words(build['opencv_flags'])}`.

PCL and OpenCV are given the region of interest with normals in a voxel grid of 0.02 diameters; the time that this takes is not
counted. They group poses within 0.1 diameters and 20 degrees, as this detector does, since their own thresholds are lengths without
regard to the part. Neither tells reliable poses from others: all are counted as reliable. `cores busy` is the processor's time over
the clock's while a detection ran, on all threads. `peak MB` is the most memory that the process of any detection held, with program, cloud and model.
"""


def words(flags):
    """Those of a compiler's flags that bear on speed."""
    chosen = [flag for flag in flags.split() if flag.startswith(("-O", "-m", "-ffast", "-DN"))]
    return " ".join(dict.fromkeys(chosen))


def write_page(facts, figures):
    """The whole page. figures: by peer, results by scene and the summary of evaluate_poses."""
    sections = [
        introduction(facts, figures),
        "## Whole detections\n\n" + whole_table(figures),
        settings(facts),
        "## Ratios\n\nOf each scene, then the median over scenes; this detector whole, the others' "
        "search alone.\n\n" + ratio_table(figures),
        "## Stages\n\n" + stage_table(figures),
        "## Scenes\n\nMilliseconds of the whole detection.\n\n" + scene_table(figures),
    ]
    return "\n".join(sections)
