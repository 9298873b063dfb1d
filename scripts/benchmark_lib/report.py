"""The report: what was measured as Markdown."""

import math
import statistics

from .cases import LOOP_PRESET, SEED, VARIANT_TEXTS

# Columns of the main tables: heading, key of evaluate_poses, digits.
COLUMNS = (
    ("targets", "targets", 0),
    ("AP", "AP", 3),
    ("precision", "precision", 3),
    ("recall", "recall", 3),
    ("first pick", "first", 2),
    ("flag precision", "flag_precision", 2),
    ("flag recall", "flag_recall", 2),
    ("right lost", "lost", 3),
    ("mm", "t_mm", 2),
    ("degrees", "r_deg", 2),
    ("NEES", "nees", 1),
    ("VSD", "AR_vsd", 3),
    ("MSPD", "AR_mspd", 3),
)

# Of the detector, in their order.
STAGES = (
    "preparation",
    "sampling",
    "voting",
    "clustering",
    "grouping",
    "boundary voting",
    "pruning",
    "refinement",
    "verification",
    "selection",
)


def table(heading, rows):
    """Markdown; the first column is text, the others are numbers."""
    lines = [heading, ["---"] + ["---:"] * (len(heading) - 1), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def number(value, digits):
    """Text; a dash for what does not exist."""
    return "-" if value is None else f"{value:.{digits}f}"


def summary_table(first, summaries):
    """One line for each summary of evaluate_poses, by name."""
    rows = [
        [name] + [number(summary[key], digits) for _, key, digits in COLUMNS]
        for name, summary in summaries.items()
    ]
    return table([first] + [heading for heading, _, _ in COLUMNS], rows)


def variant_table(figures):
    """AP, precision and recall of each part by each variant."""
    variants = list(figures["variants"])
    heading = ["part"] + [f"{v} {key}" for v in variants for key in ("AP", "P", "R")]
    rows = [
        [part]
        + [
            number(figures["variants"][v]["summary"][part][key], 3)
            for v in variants
            for key in ("AP", "precision", "recall")
        ]
        for part in figures["variants"][variants[0]]["summary"]
    ]
    return table(heading, rows)


LOOP_KEYS = ("picked", "wrong", "blocked", "left", "cycles")


def loop_sums(loops):
    """Sums over some closed loops."""
    return {key: sum(loop[key] for loop in loops) for key in LOOP_KEYS}


def loop_table(loops):
    """One line for each part's closed loops, and the sum."""
    everything = [loop for some in loops.values() for loop in some]
    rows = []
    for part, some in {**loops, "ALL": everything}.items():
        whys = dict.fromkeys(loop["why"] for loop in some)
        cycle_s = statistics.fmean(loop["cycle_s"] for loop in some)
        ended = ["", ""] if part == "ALL" else [f"{cycle_s:.2f}", "; ".join(whys)]
        rows.append([part, *loop_sums(some).values(), *ended])
    return table(["part", *LOOP_KEYS, "s a cycle", "why it ended"], rows)


def p95(values):
    """The 95th percentile of at least one value."""
    return sorted(values)[math.ceil(0.95 * len(values)) - 1]


def time_table(times):
    """Median milliseconds by stage; the whole with its 95th percentile and maximum."""
    found = {stage for scenes in times.values() for t in scenes for stage in t} - {"all"}
    stages = [stage for stage in STAGES if stage in found] + sorted(found - set(STAGES))
    rows = []
    everything = [t for scenes in times.values() for t in scenes]
    for part, scenes in {**times, "ALL": everything}.items():
        medians = [statistics.median(t.get(stage, 0) for t in scenes) for stage in stages]
        whole = [t["all"] for t in scenes]
        cells = [*medians, statistics.median(whole), p95(whole), max(whole)]
        rows.append([part] + [f"{cell:.0f}" for cell in cells])
    return table(["part", *stages, "all", "p95", "max"], rows)


def picture_table(pictures):
    """Three pictures a line. pictures: their paths by part."""
    cells = [f"{part}<br>![{part}]({path})" for part, path in pictures.items()]
    cells += [""] * (-len(cells) % 3)
    rows = [cells[i : i + 3] for i in range(0, len(cells), 3)]
    return table(rows[0], rows[1:]).replace("---:", "---")


def introduction(run_facts, figures):
    """What was done, and how to do it again."""
    variants = "".join(
        f"- `{name}`: {VARIANT_TEXTS.get(name, 'settings of a file')}{settings(figures, name)}\n"
        for name in figures["variants"]
    )
    return f"""# Benchmark

Simulated bins, the poses that `detect_poses` finds in them, and their judgement by `evaluate_poses`. This page is written by

    {run_facts['command']}

which makes the scenes, runs the detector and keeps what is done in `{run_facts['folder']}`; `{run_facts['command']} --check` makes all
of it a second time and compares. Scenes: {', '.join(figures['parts'])}; {run_facts['fills']} parts in the bin; sensors
{run_facts['presets']}; seed {SEED}; {figures['scenes']} scenes in all. `simulate_scene` chooses bin and camera as
`include/ppf_bin_picking/sim/cell_layout.hpp` says. Commit {run_facts['commit']}; {run_facts['machine']}.

docs/interface.md explains the figures (`evaluate_poses`). In short: targets are the parts at least half visible; AP counts all poses,
precision and recall the reliable ones; first pick is the share of scenes whose best pose is right; flag precision says how many of
the unreliable poses are wrong, flag recall how many of the wrong poses are unreliable, right lost how many of the right ones are;
mm and degrees are medians of the right reliable poses; VSD and MSPD are recalls as in the BOP challenge.

Variants of the detector:

{variants}"""


def settings(figures, name):
    """The settings of a variant in brackets."""
    changed = figures["variants"][name]["settings"].strip()
    return "" if changed == "{}" else f" (`{', '.join(changed.splitlines())}`)"


def write_report(figures, run_facts, pictures, curves):
    """The whole page. figures: see __main__; pictures, curves: paths relative to the page."""
    main = next(iter(figures["variants"]))
    sections = [
        introduction(run_facts, figures),
        "## By part\n\n" + summary_table("part", figures["variants"][main]["summary"]),
        "## By sensor and fill\n\n" + summary_table("scenes", figures["views"]),
        f"## Variants\n\n{variants_section(figures)}![Precision and recall]({curves})\n",
    ]
    if figures["loops"]:
        sections.append(
            f"## Closed loop\n\nThe demo's robot picks the best pose, {run_facts['loop_count']} parts in the bin, "
            f"sensor {LOOP_PRESET}, seed {SEED}: `roslaunch ppf_bin_picking demo.launch part:=PART "
            f"count:={run_facts['loop_count']} seed:={SEED} preset:={LOOP_PRESET}`.\n\n"
            + loop_table(figures["loops"])
        )
    sections += [
        f"## Time\n\nMedian milliseconds of each stage, {run_facts['machine']}; p95 and max of the whole.\n\n"
        + time_table(figures["times"]),
        f"## Scenes\n\nOne scene a part ({run_facts['picture']}). Green: reliable, red: not.\n\n"
        + picture_table(pictures),
    ]
    return "\n".join(sections)


def variants_section(figures):
    """Totals, then part by part."""
    totals = {name: v["summary"]["ALL"] for name, v in figures["variants"].items()}
    if len(totals) == 1:
        return ""
    return (
        summary_table("variant", totals)
        + "\nPart by part (P, R: precision and recall):\n\n"
        + variant_table(figures)
        + "\n"
    )
