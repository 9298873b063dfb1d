"""The rows of the ablation, and the edits of the core's sources that leave steps out."""

import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

PACKAGE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PACKAGE / "scripts"))

from ablation_lib import __main__ as ablation_main
from ablation_lib.__main__ import Ablation
from ablation_lib.edited_core import Edit, edited
from ablation_lib.rows import ROWS
from ablation_lib.steps import STEPS
from benchmark_lib import programs
from benchmark_lib.programs import BenchmarkError


class Edits(unittest.TestCase):
    def test_replace_the_one_place(self):
        self.assertEqual(edited(Edit("a.cpp", "x = 1;", "x = 2;"), "int x = 1;"), "int x = 2;")

    def test_name_the_file_that_no_longer_fits(self):
        for text in ("int y;", "x = 1; x = 1;"):
            with self.assertRaisesRegex(BenchmarkError, "a.cpp .*steps.py"):
                edited(Edit("a.cpp", "x = 1;", "x = 2;"), text)

    def test_of_every_step_fit_the_sources(self):
        for row in STEPS:
            for edit in row.edits:
                with self.subTest(step=row.name):
                    text = (PACKAGE / "src/core" / edit.file).read_text(encoding="utf-8")
                    self.assertNotEqual(edited(edit, text), text)


class Programs(unittest.TestCase):
    def test_are_not_run_without_the_core_that_was_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program"
            program.write_text("#!/bin/sh\nexit 0\n")
            program.chmod(0o755)
            with mock.patch.object(programs, "PROGRAMS", Path(folder)):
                self.assertEqual(programs.run("program"), "")
                with self.assertRaisesRegex(BenchmarkError, "missing.so"):
                    programs.run("program", core=Path(folder) / "missing.so")


class Rows(unittest.TestCase):
    def test_have_names_of_their_own(self):
        names = [row.name for row in ROWS + STEPS]
        self.assertEqual(len(names), len(set(names)))

    def test_change_something_but_the_first(self):
        self.assertFalse(ROWS[0].settings or ROWS[0].edits)
        for row in ROWS[1:] + STEPS:
            with self.subTest(row=row.name):
                self.assertTrue(row.settings or (row.edits and row.what))


class RealFigures(unittest.TestCase):
    def test_tell_what_passes_and_what_of_it_is_not_right(self):
        ablation = Ablation.__new__(Ablation)
        ablation.real = mock.Mock()
        ablation.real.verdicts = lambda scene, *_: {"a": [3, 1, 2], "b": [4, 0, 0]}[scene]
        ablation.images = {"as it is": {"pins": "a", "motors": "c"}, "turned": {"pins": "b"}}
        ablation.draws = {"as it is": mock.Mock(), "turned": mock.Mock()}
        with mock.patch.object(ablation_main, "reliable_poses", lambda *_: 9):
            figures = ablation.real_figures("row")
        self.assertEqual(figures, {"pins": [6, 4], "not_right": [3, 0], "others": 9})


if __name__ == "__main__":
    unittest.main()
