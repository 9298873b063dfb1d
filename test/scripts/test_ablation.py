"""The rows of the ablation, and the edits of the core's sources that leave steps out."""

import re
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
from ablation_lib.report import write_page
from ablation_lib.rows import MODEL_SETTINGS, ROWS
from ablation_lib.steps import STEPS
from benchmark_lib import detection, programs
from benchmark_lib.detection import Bench
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

    def test_train_models_where_what_decides_their_content_is_changed(self):
        header = PACKAGE / "include/ppf_bin_picking/core/detector_config.hpp"
        settings = re.findall(r"config\.model\.(\w+)", header.read_text(encoding="utf-8"))
        self.assertEqual(MODEL_SETTINGS, set(settings))
        self.assertEqual([row.name for row in ROWS if row.trains], ["step-0.05"])
        self.assertTrue(all(row.trains for row in STEPS))

    def test_take_the_models_of_another_row_where_they_are_the_same(self):
        bench = Bench(Path("folder"), {"default": Path("default.yaml"), "row": Path("row.yaml")})
        bench.trained_as = {"row": "default"}
        bench.part_digest = lambda part: ""
        replaced = {"program_digest": str, "digest": lambda *things: str(things)}
        with mock.patch.multiple(detection, once=mock.DEFAULT, **replaced) as mocked:
            path = bench.model("row", "bolt")
        self.assertEqual(path, Path("folder/models/default/bolt.ppf"))
        self.assertIn("default.yaml", mocked["once"].call_args.args[1])


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


class Page(unittest.TestCase):
    FACTS = {"command": "c", "folder": "f", "commit": "0", "machine": "m", "seeds": 1, "fill": 16}

    def page(self, left_out):
        summary = {"AP": 0.5, "precision": 1.0, "recall": 0.5, "first": 1.0, "lost": 0.0}
        summary = {"ALL": {**summary, "t_mm": 0.1, "r_deg": 0.1}}
        figure = {"bins": [summary], "own": summary, "pins": [3, 5], "not_right": [0, 1]}
        figures = {ROWS[0].name: {**figure, "others": 7, "time": 1.0}}
        return write_page({**self.FACTS, "own_seed": 2, "left_out": left_out}, ROWS[:1], figures)

    def test_has_a_line_for_each_row(self):
        line = "| `default` | 0.500 | 1.000 | 0.500 | 0.500 | 1.000 | 0.500 | 3 | 4.0 | 0.5 | 7 | 1.00 |"
        self.assertIn(line, self.page([]))

    def test_names_the_rows_that_were_not_measured(self):
        self.assertNotIn("Not measured", self.page([]))
        self.assertRegex(self.page(["greedy", "no-icp"]), "Not measured.*: `greedy`, `no-icp`.")


if __name__ == "__main__":
    unittest.main()
