"""What scripts/fit_reliability learns from: the plan's scenes, their coarse copies, labels and weights."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

PACKAGE = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PACKAGE / "scripts"), str(PACKAGE / "test/scripts")]

from benchmark_lib.cases import Scene  # after the path that it is found on
from benchmark_lib.clouds import read_cloud
from reliability_lib import coarse, report, training
from reliability_lib.__main__ import QUICK_PARTS, QUICK_PLAN
from support import write_part


class PlanTest(unittest.TestCase):
    PLAN = training.Plan(("a",))

    def test_each_part_is_looked_for_among_four_others(self):
        parts = tuple("abcdefghijkl")
        self.assertEqual(training.neighbours(parts, "k"), ["l", "b", "d", "g"])
        for count in range(2, 12):
            others = training.neighbours(parts[:count], "b")
            self.assertTrue(others)
            self.assertNotIn("b", others)
            self.assertEqual(len(set(others)), len(others))

    def test_makes_the_scenes_that_foreign_parts_are_looked_for_in(self):
        quick = training.Plan(QUICK_PARTS, **QUICK_PLAN)
        other = training.Plan(("a", "b"), seeds=(1,), fills=(2,), presets=("industrial",))
        for plan in (training.Plan(tuple("abcdefghijkl")), quick, other):
            made = set(plan.plain()) | set(plan.changed()["shiny"])
            foreign = [pair for pairs in plan.foreign().values() for pair in pairs]
            self.assertTrue(foreign)
            for part, scene in foreign:
                self.assertNotEqual(part, scene.part)
                self.assertIn(scene, made)

    def test_copies_are_made_of_some_sensors_and_fills(self):
        self.assertEqual(len(self.PLAN.plain()), 18)
        counts = {kind: len(scenes) for kind, scenes in self.PLAN.changed().items()}
        self.assertEqual(counts, {"shiny": 12, "coarse": 8, "open": 12, "open, coarse": 8})

    def test_copies_have_names_of_their_own(self):
        scene = training.ChangedScene(Scene("a", 24, "clean", 101), "open, coarse")
        self.assertEqual(scene.name, "open-coarse-clean-24-101")
        names = [scene.name for scenes in self.PLAN.changed().values() for scene in scenes]
        self.assertEqual(len(set(names)), len(names))

    def test_every_set_is_in_a_fit_and_every_fit_has_sets_that_it_is_for(self):
        sets = {"own", *self.PLAN.changed(), *self.PLAN.foreign()}
        self.assertEqual(sets, {name for weights in training.FITS.values() for name in weights})
        for weights in training.FITS.values():
            self.assertIn(1.0, weights.values())

    def test_only_the_fit_for_the_whole_cloud_has_poses_found_there_and_it_has_them_with_full_weight(
        self,
    ):
        for name, weights in training.FITS.items():
            for pose_set, weight in weights.items():
                kind = training.KINDS.get(pose_set)
                found_there = kind is not None and kind.whole_cloud
                expected = name == "whole_cloud" and weight == 1
                self.assertEqual(found_there, expected, (name, pose_set))


class SceneArgumentsTest(unittest.TestCase):
    def arguments(self, kind):
        bench = training.Training(Path("/bench"), {})
        return [str(word) for word in bench.scene_arguments(self.scene(kind))]

    def scene(self, kind):
        return training.ChangedScene(Scene("a", 24, "clean", 101), kind)

    def test_tell_cloud_or_image_and_the_region_unless_the_scene_is_open(self):
        folder = "/bench/scenes/a/coarse-clean-24-101"
        self.assertEqual(
            self.arguments("coarse"),
            ["--cloud", f"{folder}/cloud.pcd", "--roi", f"{folder}/roi.yaml"],
        )
        for kind, first, region in (
            ("shiny", "--depth", True),
            ("open", "--depth", False),
            ("open, coarse", "--cloud", False),
        ):
            found = self.arguments(kind)
            self.assertEqual((found[0], "--roi" in found), (first, region), kind)


class LabelsTest(unittest.TestCase):
    def test_a_pose_is_right_below_the_threshold_even_on_an_object_already_found(self):
        judged = [
            {"index": 2, "mssd_rel": 0.05, "verdict": "right"},
            {"index": 0, "mssd_rel": 0.0999, "verdict": "duplicate"},
            {"index": 1, "mssd_rel": 0.1, "verdict": "wrong"},
            {"index": 3, "mssd_rel": None, "verdict": "wrong"},
        ]
        np.testing.assert_array_equal(training.labels_of(judged, 4, 0.1), [1, 0, 1, 0])
        with self.assertRaises(ValueError):
            training.labels_of(judged, 5, 0.1)

    def test_a_fit_has_its_sets_with_their_weights_and_no_others(self):
        sets = np.array(["own", "open", "shiny", "foreign", "own"])
        terms = np.arange(10.0).reshape(5, 2)
        poses = training.Poses(terms, np.array([1, 0, 1, 0, 0]), sets, sets, sets, sets)
        chosen, weights = poses.of_fit("region")
        self.assertEqual(list(chosen.sets), ["own", "shiny", "foreign", "own"])
        np.testing.assert_array_equal(weights, [1, 1, 0.2, 1])
        np.testing.assert_array_equal(chosen.terms, terms[[0, 2, 3, 4]])
        np.testing.assert_array_equal(chosen.labels, [1, 1, 0, 0])
        chosen, weights = poses.of_fit("whole_cloud")
        self.assertEqual(list(chosen.sets), ["open", "shiny", "foreign"])
        np.testing.assert_array_equal(weights, [1, 0.2, 0.2])


class SummaryTest(unittest.TestCase):
    def summary(self, predicted, labels):
        count = len(labels)
        sets = np.array((count - 1) * ["own"] + ["foreign"])
        parts = np.array(["a", "b"] * count)[:count]
        poses = training.Poses(np.zeros((count, 1)), np.array(labels), parts, sets, sets, sets)
        fitted = report.Fitted("region", poses, np.ones(count), None, None, np.array(predicted))
        return report.summary(fitted)

    def test_tells_what_was_promised_and_what_is_right_of_the_sets_that_the_fit_is_for(self):
        text = self.summary([0.98, 0.99, 0.9, 0.96, 0.3, 1.0], [1, 0, 1, 1, 0, 0])
        self.assertIn("From 0.98 on: 0.985 promised, 0.500 right.", text)
        self.assertIn("From 0.9 to 0.98: 0.930 promised, 1.000 right.", text)
        self.assertIn("the fewest are right of b 0.500, a 1.000.", text)

    def test_of_no_pose_is_none(self):
        self.assertIn(
            "From 0.98 on: none. From 0.9 to 0.98: none.", self.summary([0.1, 0.2], [0, 0])
        )


class CoarseTest(unittest.TestCase):
    """A slanted plane half a metre away."""

    CAMERA = {"fx": 600.0, "fy": 500.0, "cx": 79.5, "cy": 61.0, "depth_unit_m": 0.0001}

    def setUp(self):
        columns = np.arange(160)
        self.depth = np.tile(0.5 + 0.0002 * columns, (120, 1)).round(4)
        self.depth[:10] = 0

    def points(self, seed, part_m=0.1):
        rng = np.random.default_rng(seed)
        return coarse.coarse_points(self.depth, self.CAMERA, part_m, rng)

    def test_points_are_those_of_measured_pixels_on_a_coarser_grid(self):
        for seed in range(10):
            points = self.points(seed)
            columns = points[:, 0] / points[:, 2] * 600 + 79.5
            rows = points[:, 1] / points[:, 2] * 500 + 61
            np.testing.assert_allclose(columns, columns.round(), atol=1e-9)
            u, v = columns.round().astype(int), rows.round().astype(int)
            np.testing.assert_array_equal(self.depth[v, u], points[:, 2])
            (step,) = set(np.diff(np.unique(u)))
            self.assertEqual({step}, set(np.diff(np.unique(v))))
            part_px = 0.1 * 600 / np.median(self.depth[self.depth > 0])
            self.assertGreaterEqual(part_px / step, coarse.PIXELS[0])
            self.assertLessEqual(part_px / step, coarse.PIXELS[1])

    def test_the_step_leaves_the_wanted_pixels_wherever_a_whole_number_does(self):
        rng = np.random.default_rng(8)
        for part_px in np.exp(rng.uniform(np.log(5), np.log(900), 500)):
            left = part_px / coarse.step_of(part_px, rng)
            possible = part_px / np.arange(1, 100)
            inside = (possible >= coarse.PIXELS[0]) & (possible <= coarse.PIXELS[1])
            if inside.any():
                self.assertTrue(coarse.PIXELS[0] <= left <= coarse.PIXELS[1], part_px)
            elif part_px < coarse.PIXELS[0]:
                self.assertEqual(left, part_px)
        steps = {coarse.step_of(300, rng) for _ in range(200)}
        self.assertEqual(steps, set(range(5, 12)))

    def test_a_part_of_few_pixels_keeps_them_all(self):
        self.assertEqual(len(self.points(1, part_m=0.01)), (self.depth > 0).sum())

    def test_their_order_says_nothing(self):
        points = self.points(3)
        self.assertLess(abs(np.corrcoef(points[:, 0], np.arange(len(points)))[0, 1]), 0.1)

    def test_a_scene_is_copied_with_its_cloud(self):
        with tempfile.TemporaryDirectory() as folder:
            source, copy = Path(folder) / "part/plain", Path(folder) / "part/coarse"
            source.mkdir(parents=True)
            levels = (self.depth / 0.0001).round().astype(np.uint16)
            coarse.Image.fromarray(levels).save(source / "depth.png")
            lines = [f"{key}: {value}\n" for key, value in self.CAMERA.items()]
            (source / "camera.yaml").write_text("".join(lines))
            (source / "gt.json").write_text("{}")
            (source / "roi.yaml").write_text("x: 1\n")
            write_part(source.parent, [[0, 0, 0], [100, 0, 0], [0, 50, 0]])
            coarse.write_coarse_scene(source, copy)
            coarse.write_coarse_scene(source, copy)  # over what is there
            self.assertEqual((copy / "roi.yaml").read_text(), "x: 1\n")
            points = read_cloud(copy / coarse.CLOUD)
            other = Path(folder) / "part/open-coarse"
            coarse.write_coarse_scene(source, other)
            np.testing.assert_array_equal(read_cloud(other / coarse.CLOUD), points)
        self.assertGreater(len(points), 50)
        seen = {tuple(point) for point in self.points_of_all_pixels()}
        self.assertTrue({tuple(point) for point in points.astype("<f4")} <= seen)

    def points_of_all_pixels(self):
        return self.points(0, part_m=0.001).astype("<f4")


if __name__ == "__main__":
    unittest.main()
