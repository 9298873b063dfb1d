"""Running the package's programs, and not running them again for what is done."""

import functools
import hashlib
import os
import platform
import re
import subprocess
import sys
import threading
import time

from .cases import PACKAGE

PROGRAMS = PACKAGE / "build/devel/lib/ppf_bin_picking"


class BenchmarkError(Exception):
    """One sentence for the person who started the benchmark."""


def run_to_end(command, body):
    """Runs body and prints how long it took. Returns the exit status: body's, or 2 after the sentence of its error."""
    start = time.monotonic()
    try:
        status = body()
    except BenchmarkError as error:
        print(f"{command}: {error}", file=sys.stderr)
        return 2
    print(f"Duration: {time.monotonic() - start:.0f} s")
    return status


def run_script(script, arguments, work):
    """A script from its command line to its exit status."""
    options = arguments()
    return run_to_end(script, lambda: work(options))


def provenance(script):
    """What a report says about how it was made. To be called before the report makes a file differ from the commit."""
    words = [word for word in sys.argv[1:] if word != "--check"]
    return {"command": " ".join([script, *words]), "commit": commit(), "machine": machine()}


def commit():
    """Of the working copy, with a mark if files differ from it."""
    described = subprocess.run(
        ["git", "describe", "--always", "--dirty"], capture_output=True, text=True, check=False
    )
    return described.stdout.strip() or "unknown"


def machine():
    """Cores and their name."""
    with open("/proc/cpuinfo", encoding="ascii") as stream:
        models = [line.split(":")[1].strip() for line in stream if line.startswith("model name")]
    return f"{os.cpu_count()} cores, {models[0] if models else platform.machine()}"


def digest(*things):
    """A name for texts, bytes and the contents of files (paths)."""
    total = hashlib.sha256()
    for thing in things:
        content = thing.read_bytes() if hasattr(thing, "read_bytes") else str(thing).encode()
        total.update(hashlib.sha256(content).digest())
    return total.hexdigest()


@functools.lru_cache(maxsize=None)
def program_digest(name):
    """Of a program and of the libraries of this package that it loads."""
    program = PROGRAMS / name
    if not program.is_file():
        raise BenchmarkError(f"{program} is missing: build the package.")
    loaded = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    libraries = re.findall(r"=> (\S*libppf_bin_picking\S*)", loaded)
    return digest(program, *[PACKAGE / library for library in sorted(libraries)])


def run(name, *arguments, core=None):
    """Runs a program of the package. Returns what it printed. core: library in place of the package's core."""
    command = [str(PROGRAMS / name), *map(str, arguments)]
    environment = {**os.environ, "LD_PRELOAD": str(core)} if core else None
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise BenchmarkError(f"{' '.join(command)} failed: {last}")
    # The loader only warns, and the package's own would be used.
    if core and "cannot be preloaded" in done.stderr:
        raise BenchmarkError(
            f"The loader does not take {core}: use a folder without spaces and colons."
        )
    return done.stdout


def stamp_of(path):
    """The file that holds the key with which a file or folder was made."""
    return path.with_name(path.name + ".key")


def is_done(path, key):
    """Whether a file or folder was made with this key."""
    return path.exists() and stamp_of(path).is_file() and stamp_of(path).read_text() == key


def once(path, key, make):
    """Makes a file or folder unless that is done. Returns whether it was made now."""
    if is_done(path, key):
        return False
    stamp_of(path).unlink(missing_ok=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    make()
    stamp_of(path).write_text(key)
    return True


class Progress:
    """Lines that say how far a stage is and how long the rest takes."""

    def __init__(self, stage, total):
        self.stage, self.total, self.done, self.made = stage, total, 0, 0
        self.start, self.lock = time.monotonic(), threading.Lock()
        print(f"{stage}: {total}", flush=True)

    def step(self, name, made):
        """To be called after each item, from any thread. made: whether it took work."""
        with self.lock:
            self.done += 1
            self.made += made
            if not made and self.done < self.total:
                return
            seconds = time.monotonic() - self.start
            left = seconds / max(1, self.made) * (self.total - self.done)
            print(
                f"{self.stage} {self.done}/{self.total}: {name}, {seconds:.0f} s, "
                f"at most {left:.0f} s left",
                flush=True,
            )
