"""Variants of the real scans: turned and noisy images, turned and thinned clouds."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import yaml

PACKAGE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PACKAGE / "scripts"))

from benchmark_lib.clouds import read_cloud, write_cloud  # after the path that it is found on
from benchmark_lib.programs import BenchmarkError
from real_scan_lib import report, scans


def points_of(scan):
    """Of the measured pixels, sorted; metres."""
    camera = scan.camera
    rows, columns = np.nonzero(scan.levels)
    z = scan.levels[rows, columns] * camera["depth_unit_m"]
    x = (columns - camera["cx"]) / camera["fx"] * z
    y = (rows - camera["cy"]) / camera["fy"] * z
    points = np.column_stack([x, y, z])
    return points[np.lexsort(points.round(9).T)]


class ImageScanTest(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(4)
        levels = rng.integers(4000, 5000, (30, 50)).astype(np.uint16)
        levels[rng.random((30, 50)) < 0.3] = 0
        camera = {"width": 50, "height": 30, "fx": 100.0, "fy": 120.0, "cx": 22.0, "cy": 16.5}
        camera.update(depth_unit_m=0.0001, frame_id="camera")
        box = (np.array([-0.03, 0.01, 0.4]), np.array([0.02, 0.06, 0.47]))
        self.scan = scans.ImageScan(levels, camera, {"bin": box})

    def test_a_turned_image_sees_the_turned_points(self):
        points = points_of(self.scan)
        turned = np.column_stack([points[:, 1], -points[:, 0], points[:, 2]])
        turned = turned[np.lexsort(turned.round(9).T)]
        np.testing.assert_allclose(points_of(self.scan.turned()), turned, atol=1e-12)

    def test_a_turned_region_holds_the_same_points(self):
        def count(scan):
            low, high = scan.regions["bin"]
            points = points_of(scan)
            return ((points >= low) & (points <= high)).all(axis=1).sum()

        self.assertGreater(count(self.scan), 50)
        self.assertEqual(count(self.scan.turned()), count(self.scan))

    def test_four_quarter_turns_change_nothing(self):
        turned = self.scan.turned().turned().turned().turned()
        np.testing.assert_array_equal(turned.levels, self.scan.levels)
        self.assertEqual(turned.camera, self.scan.camera)
        np.testing.assert_allclose(turned.regions["bin"], self.scan.regions["bin"])

    def test_noise_is_as_wide_as_stated_and_measures_nothing_new(self):
        self.scan = scans.replace(self.scan, levels=np.tile(self.scan.levels, (20, 20)))
        noisy = self.scan.noisy(1)
        np.testing.assert_array_equal(noisy.levels == 0, self.scan.levels == 0)
        change = (noisy.levels.astype(float) - self.scan.levels)[self.scan.levels > 0] * 0.0001
        # rounding to levels adds its own
        self.assertAlmostEqual(
            change.std(), np.hypot(scans.NOISE_M, 0.0001 / 12**0.5), delta=1e-6
        )
        self.assertTrue((self.scan.noisy(2).levels != noisy.levels).any())

    def test_is_written_as_it_is(self):
        with tempfile.TemporaryDirectory() as folder:
            self.scan.turned().write("bin", Path(folder))
            with scans.Image.open(Path(folder) / "depth.png") as image:
                np.testing.assert_array_equal(np.array(image), np.rot90(self.scan.levels))
            camera = yaml.safe_load((Path(folder) / "camera.yaml").read_text())
            region = yaml.safe_load((Path(folder) / "roi.yaml").read_text())
        self.assertEqual((camera["width"], camera["height"], camera["fx"]), (30, 50, 120))
        np.testing.assert_allclose(region["min"], [0.01, -0.02, 0.4])


class CloudScanTest(unittest.TestCase):
    def setUp(self):
        low, high = scans.INSIDE
        size = high - low
        points = np.random.default_rng(2).uniform(low - size, high + size, (2000, 3))
        self.scan = scans.CloudScan(points, np.eye(3))

    def test_what_lies_in_the_bin_turns_with_it(self):
        inside = self.scan.inside(self.scan.points)
        self.assertGreater(inside.sum(), 30)
        turned = self.scan.turned(30).turned(70)
        np.testing.assert_array_equal(turned.inside(turned.points), inside)

    def test_the_region_is_written_in_the_frame_of_the_turned_cloud(self):
        turned = self.scan.turned(40)
        with tempfile.TemporaryDirectory() as folder:
            turned.write(Path(folder))
            region = yaml.safe_load((Path(folder) / "roi.yaml").read_text())
        pose = np.reshape(region["pose"], (4, 4))  # T_cloud_box
        in_box = (turned.points - pose[:3, 3]) @ pose[:3, :3]
        found = ((in_box >= region["min"]) & (in_box <= region["max"])).all(axis=1)
        np.testing.assert_array_equal(found, self.scan.inside(self.scan.points))

    def test_another_order_has_the_same_points(self):
        other = self.scan.shuffled(3).points
        self.assertFalse(np.array_equal(other, self.scan.points))
        np.testing.assert_array_equal(np.sort(other, axis=0), np.sort(self.scan.points, axis=0))

    def test_a_few_points_are_left_out(self):
        kept = {tuple(point) for point in self.scan.thinned(1).points}
        self.assertTrue(kept < {tuple(point) for point in self.scan.points})
        self.assertAlmostEqual(len(kept) / 2000, 1 - scans.LEFT_OUT, delta=0.015)

    def test_no_pose_is_none_outside(self):
        self.assertEqual((~self.scan.inside(np.zeros((0, 3)))).sum(), 0)


class CloudFileTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "cloud.pcd"

    def test_is_read_as_it_was_written(self):
        points = np.random.default_rng(1).normal(size=(70, 3)).astype("<f4")
        write_cloud(points, self.path)
        np.testing.assert_array_equal(read_cloud(self.path), points)

    def test_further_fields_are_left_out(self):
        rows = np.arange(10, dtype="<f4").reshape(2, 5)
        head = (
            "VERSION .7\nFIELDS x y z normal_x rgb\nSIZE 4 4 4 4 4\nTYPE F F F F F\nDATA binary\n"
        )
        self.path.write_bytes(head.encode() + rows.tobytes())
        np.testing.assert_array_equal(read_cloud(self.path), rows[:, :3])

    def test_another_file_is_refused_by_name(self):
        for content in (b"", b"VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nDATA binary\n"):
            self.path.write_bytes(content)
            with self.assertRaisesRegex(BenchmarkError, "cloud.pcd"):
                read_cloud(self.path)


class ReportTest(unittest.TestCase):
    def test_the_mean_is_that_of_each_column(self):
        rows = report.with_mean([["a", 1, 10], ["b", 2, 20]])
        self.assertEqual(rows[-1], ["**mean**", "1.5", "15.0"])


if __name__ == "__main__":
    unittest.main()
