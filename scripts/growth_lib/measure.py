"""Times and memory of programs."""

import json
import re
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from benchmark_lib.programs import PROGRAMS, BenchmarkError

LOOK_S = 0.005  # between two looks at a program's memory
RUNS = 7  # of each detection; the first one counts as the first after start
DISTRIBUTION = re.compile(r"detections: first ([\d.]+) ms, least [\d.]+, median ([\d.]+)")


def resident_mb(pid):
    """The largest resident size until now of a program that runs [MB]; 0 of one that has ended.

    What the system tells of one that has ended counts the memory of the program that started it, too.
    """
    status = Path(f"/proc/{pid}/status").read_text()
    found = re.search(r"VmHWM:\s+(\d+) kB", status)
    return int(found[1]) / 1024 if found else 0


def run_measured(name, *arguments):
    """Runs a program. Returns what it printed to stderr, seconds, and its largest resident size [MB]."""
    command = [str(PROGRAMS / name), *map(str, arguments)]
    start = time.monotonic()
    largest_mb = 0
    with tempfile.TemporaryFile() as printed:
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=printed) as process:
            while process.poll() is None:
                largest_mb = max(largest_mb, resident_mb(process.pid))
                time.sleep(LOOK_S)
        seconds = time.monotonic() - start
        printed.seek(0)
        text = printed.read().decode()
    if process.returncode != 0:
        last = (text.strip().splitlines() or [f"it ended with {process.returncode}"])[-1]
        raise BenchmarkError(f"{' '.join(command)} failed: {last}")
    return text, seconds, largest_mb


def detect(part_file, model, scene, output, threads=2):
    """Several detections of a scene.

    Returns milliseconds of the first one and of the median, those of each stage of the last one, its reliable poses, and
    the largest resident size [MB].
    """
    printed, _, resident_mb = run_measured(
        "detect_poses",
        *("--part", part_file, "--model", model, *scene),
        *("--threads", threads, "--repeat", RUNS, "--output", output),
    )
    first, median = map(float, DISTRIBUTION.search(printed).groups())
    result = json.loads(output.read_text())
    return {
        "first": first,
        "ms": median,
        "stages": result["stages_ms"],
        "reliable": sum(pose["reliable"] for pose in result["poses"]),
        "mb": resident_mb,
    }


def train(part_file, model, config=None):
    """Trains a model file. Returns what was printed, and seconds."""
    settings = ("--config", config) if config else ()
    printed, seconds, _ = run_measured(
        "train_model", "--part", part_file, *settings, "--output", model
    )
    return printed, seconds


def stage_rates(part_filter, output):
    """What measure_stages says. Returns its benchmarks by name."""
    run_measured(
        "measure_stages",
        f"--benchmark_filter={part_filter}",
        f"--benchmark_out={output}",
        "--benchmark_out_format=json",
        "--benchmark_repetitions=3",
        "--benchmark_report_aggregates_only=true",
    )
    found = json.loads(output.read_text())["benchmarks"]
    return {one["run_name"]: one for one in found if one["aggregate_name"] == "median"}


def slope(xs, ys):
    """Of the least-squares line."""
    mean_x, mean_y = statistics.mean(xs), statistics.mean(ys)
    across = sum((x - mean_x) ** 2 for x in xs)
    return sum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys)) / across
