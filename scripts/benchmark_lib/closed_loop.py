"""The simulated cell's closed loop: a robot picks what the detector returns, until nothing is left or reliable."""

import json
import re
import subprocess

from .cases import LOOP_COUNT, LOOP_PRESET, PACKAGE, SEED
from .programs import BenchmarkError, Progress, digest, once, program_digest

TIMEOUT_S = 900
SUMMARY = re.compile(
    r"Summary: (?P<picked>\d+) picked, (?P<wrong>\d+) wrong picks, (?P<blocked>\d+) blocked picks, "
    r"(?P<left>\d+) parts left \((?P<why>.*)\)"
)
CYCLES = re.compile(r"Cycles: (?P<cycles>\d+) of (?P<cycle_s>[\d.]+|nan) s")


def files_digest():
    """Of what the loop runs beside its programs."""
    files = [*PACKAGE.glob("launch/*.launch"), *PACKAGE.glob("config/*.yaml")]
    return digest(*sorted([*files, *PACKAGE.glob("src/sim_node/*.py")]))


def run_loop(part, count, seed, path):
    """Launches the loop once and writes what its summary says."""
    command = ["roslaunch", "ppf_bin_picking", "demo.launch", f"part:={part}", f"count:={count}"]
    command += [f"seed:={seed}", f"preset:={LOOP_PRESET}"]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise BenchmarkError(f"The loop with {part} did not end in {TIMEOUT_S} s.") from error
    path.with_suffix(".log").write_text(done.stdout + done.stderr)
    summary, cycles = SUMMARY.search(done.stdout), CYCLES.search(done.stdout)
    if not summary or not cycles:
        raise BenchmarkError(f"The loop with {part} failed: see {path.with_suffix('.log')}.")
    numbers = {name: int(value) for name, value in summary.groupdict().items() if name != "why"}
    numbers.update(
        why=summary["why"], cycles=int(cycles["cycles"]), cycle_s=float(cycles["cycle_s"])
    )
    path.write_text(json.dumps(numbers))


def loop_once(bench, part, count, seed):
    """What became of the parts of one loop, and whether it was run now."""
    path = bench.folder / "loops" / f"{part}-{count}-{seed}.json"
    key = digest(
        *(bench.part_digest(part), count, seed, LOOP_PRESET, files_digest()),
        *map(program_digest, ("simulated_cell", "pose_detector_node")),
    )
    made = once(path, key, lambda: run_loop(part, count, seed, path))
    return json.loads(path.read_text()), made


def run_loops(bench, parts, count=LOOP_COUNT, seeds=(SEED,)):
    """What became of the parts of each loop, by part one a seed."""
    loops = {}
    progress = Progress("closed loops", len(parts) * len(seeds))
    for part in parts:
        for seed in seeds:
            loop, made = loop_once(bench, part, count, seed)
            loops.setdefault(part, []).append(loop)
            progress.step(f"{part}, seed {seed}: {loop['picked']} of {count} picked", made)
    return loops
