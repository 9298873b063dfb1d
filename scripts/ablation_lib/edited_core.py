"""The core library without one of its steps: built from edited copies of its sources."""

import filecmp
import os
import shutil
import subprocess
from dataclasses import dataclass

from benchmark_lib.cases import PACKAGE
from benchmark_lib.programs import BenchmarkError, digest, once

SOURCES = ("src/core", "include")
COMPILER = "src/compiler.cmake"
TESTS = "test/core"  # not built, but CMake asks for them
LIBRARY = "libppf_bin_picking_core.so"


@dataclass(frozen=True)
class Edit:
    """What is changed in a file of src/core."""

    file: str
    old: str  # the file holds it once
    new: str


def edited(edit, text):
    """The file's text with the edit."""
    if text.count(edit.old) != 1:
        raise BenchmarkError(
            f"src/core/{edit.file} does not hold the text '{edit.old.strip()}' once: "
            "adapt the edit in scripts/ablation_lib/steps.py."
        )
    return text.replace(edit.old, edit.new)


def copy_if_other(source, target):
    """Leaves the times of files that did not change, so that they are not compiled again."""
    if not (os.path.exists(target) and filecmp.cmp(source, target, shallow=False)):
        shutil.copyfile(source, target)


class EditedCore:
    """A folder with the copied sources, their build and the libraries of the rows."""

    def __init__(self, folder):
        self.folder = folder

    def library(self, row):
        """Path of the row's library, built unless that is done."""
        path = self.folder / "libraries" / row.name / LIBRARY
        files = [file for name in SOURCES for file in sorted((PACKAGE / name).rglob("*.*"))]
        key = digest(PACKAGE / COMPILER, *files, *row.edits)
        once(path, key, lambda: self.build(row, path))
        return path

    def build(self, row, path):
        """Compiles what the edits, and taking back those of the last row, touch."""
        copy = self.folder / "sources"
        for name in (*SOURCES, TESTS):
            shutil.copytree(
                PACKAGE / name, copy / name, copy_function=copy_if_other, dirs_exist_ok=True
            )
        copy_if_other(PACKAGE / COMPILER, copy / COMPILER)
        for edit in row.edits:
            file = copy / "src/core" / edit.file
            file.write_text(edited(edit, file.read_text()))
        print(f"core, {row.name}", flush=True)
        build = self.folder / "build"
        self.run_cmake(row, "-S", copy / "src/core", "-B", build, "-DBUILD_SHARED_LIBS=ON")
        self.run_cmake(
            row,
            *("--build", build, "--target", "ppf_bin_picking_core"),
            *("--parallel", os.cpu_count()),
        )
        shutil.copyfile(build / LIBRARY, path)

    @staticmethod
    def run_cmake(row, *arguments):
        command = ["cmake", *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            printed = done.stderr + done.stdout
            errors = [line for line in printed.splitlines() if "error" in line.lower()]
            raise BenchmarkError(
                f"The core of {row.name} cannot be built: {(errors or ['no message'])[0]}"
            )
