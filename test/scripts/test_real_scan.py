"""Variants of the real scans: turned and noisy images, turned and thinned clouds."""

import itertools
import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import yaml

PACKAGE = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PACKAGE / "scripts"), str(PACKAGE / "test/scripts")]

from ablation_lib.copies import NOISE_M  # after the path that it is found on
from benchmark_lib.clouds import read_cloud, write_cloud
from benchmark_lib.programs import BenchmarkError
from real_scan_lib import measurement, report, scans
from real_scan_lib.seen import cloud_view
from support import write_part


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
        self.scan = scans.ImageScan(levels, camera, {"bin": box}, np.eye(3))

    def test_a_turned_image_sees_the_turned_points(self):
        points = points_of(self.scan)
        turned = points @ self.scan.turned().turn.T
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
        self.assertAlmostEqual(change.std(), np.hypot(NOISE_M, 0.0001 / 12**0.5), delta=1e-6)
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

    def test_the_region_is_written_in_the_frame_of_the_turned_cloud(self):
        turned = self.scan.turned(40)
        with tempfile.TemporaryDirectory() as folder:
            turned.write(Path(folder))
            region = yaml.safe_load((Path(folder) / "roi.yaml").read_text())
        pose = np.reshape(region["pose"], (4, 4))  # T_cloud_box
        in_box = (turned.points - pose[:3, 3]) @ pose[:3, :3]
        found = ((in_box >= region["min"]) & (in_box <= region["max"])).all(axis=1)
        low, high = scans.INSIDE
        expected = ((self.scan.points >= low) & (self.scan.points <= high)).all(axis=1)
        self.assertGreater(expected.sum(), 30)
        np.testing.assert_array_equal(found, expected)

    def test_another_order_has_the_same_points(self):
        other = self.scan.shuffled(3).points
        self.assertFalse(np.array_equal(other, self.scan.points))
        np.testing.assert_array_equal(np.sort(other, axis=0), np.sort(self.scan.points, axis=0))

    def test_a_few_points_are_left_out(self):
        kept = {tuple(point) for point in self.scan.thinned(1).points}
        self.assertTrue(kept < {tuple(point) for point in self.scan.points})
        self.assertAlmostEqual(len(kept) / 2000, 1 - scans.LEFT_OUT, delta=0.015)


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
        head = "VERSION .7\nFIELDS x y z normal_x rgb\nSIZE 4 4 4 4 4\nTYPE F F F F F\n"
        head += "POINTS 2\nDATA binary\n"
        self.path.write_bytes(head.encode() + rows.tobytes())
        np.testing.assert_array_equal(read_cloud(self.path), rows[:, :3])

    def test_another_file_is_refused_by_name(self):
        for content in (b"", b"VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nDATA binary\n"):
            self.path.write_bytes(content)
            self.refuses()

    def test_a_file_that_is_cut_off_or_not_binary_is_refused(self):
        write_cloud(np.ones((5, 3)), self.path)
        whole = self.path.read_bytes()
        for content in (
            whole[:-4],
            whole + b"1234",
            whole.replace(b"DATA binary", b"DATA ascii"),
            whole.replace(b"DATA binary", b"DATA binary_compressed"),
        ):
            self.path.write_bytes(content)
            self.refuses()

    def refuses(self):
        with self.assertRaisesRegex(BenchmarkError, "cloud.pcd"):
            read_cloud(self.path)


class MeasurementTest(unittest.TestCase):
    """A bench whose detector finds as many reliable poses as the scene's name has letters o, and as many unreliable ones."""

    SHIFT = np.array([0.01, 0.02, 0.5])

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        data = Path(folder.name) / "data"
        data.mkdir()
        write_part(data, [[0, 0, 0], [20, 0, 0], [0, -10, 4]])
        symmetries = "symmetries_continuous: [{axis: [1, 0, 0], point: [0, 0, 0]}]"
        (data / "part.yaml").write_text(f"unit: mm\nmesh: model.stl\n{symmetries}\n")
        (data / "camera.yaml").write_text("{fx: 1.0, fy: 1.0, cx: 0.0, cy: 0.0}\n")
        (data / "bins.yaml").write_text("regions: {}\n")
        self.data = data
        self.bench = measurement.RealScan(Path(folder.name) / "bench", data, {})
        self.bench.detect = self.detect
        suspicious = mock.patch.object(measurement, "suspicious_poses", lambda *_: 7)
        suspicious.start()
        self.addCleanup(suspicious.stop)

    def detect(self, variant, scene):
        pose = np.eye(4)
        pose[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        pose[:3, 3] = self.SHIFT
        poses = [
            {"pose": pose.ravel().tolist(), "reliable": reliable}
            for reliable in scene.name.count("o") * [True, False]
        ]
        path = self.bench.result_path(variant, scene)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps({"poses": poses}))
        return True

    def scene(self, name, loose=True, whole_cloud=True):
        return measurement.RealScene(name, loose, whole_cloud)

    def test_the_arguments_name_cloud_or_image_and_the_region_unless_all_is_searched(self):
        for loose, whole_cloud in itertools.product((False, True), repeat=2):
            scene = self.scene("a", loose, whole_cloud)
            words = [str(word) for word in self.bench.scene_arguments(scene)]
            self.assertEqual(words[0], "--cloud" if loose else "--depth")
            self.assertEqual("--roi" in words, not whole_cloud)

    def test_a_folder_without_the_scan_is_refused_by_name(self):
        for name in ("part.yaml", "camera.yaml", "bins.yaml"):
            content = (self.data / name).read_text()
            (self.data / name).unlink()
            with self.assertRaisesRegex(BenchmarkError, f"{name} is missing: .* --data"):
                measurement.RealScan(self.data / "bench", self.data, {})
            (self.data / name).write_text(content)

    def test_verdicts_are_those_of_the_camera_that_is_not_turned(self):
        asked = []

        def verdict(pose, ends, view):
            asked.append((pose[:3, 3], ends, view.pins))
            return "end for end"

        for loose, pins in ((False, measurement.picture_view({}).pins), (True, cloud_view().pins)):
            scene = self.scene("soon", loose)
            self.bench.detect("default", scene)
            with mock.patch.object(measurement, "verdict", verdict):
                self.assertEqual(self.bench.verdicts(scene, scans.QUARTER_TURN), [0, 2, 0])
            np.testing.assert_allclose(asked[-1][0], [-0.02, 0.01, 0.5])
            np.testing.assert_allclose(asked[-1][1], self.bench.ends_m)
            self.assertEqual(asked[-1][2], pins)

    def test_images_count_the_parts_bin_and_the_others(self):
        levels = np.full((4, 5), 5000, np.uint16)
        box = (np.zeros(3), np.ones(3))
        regions = {name: box for name in ("pins", "motors", "shoos")}
        draws = {
            name: scans.ImageScan(levels, {"depth_unit_m": 0.0001}, regions, turn)
            for name, turn in (("one", np.eye(3)), ("two", scans.QUARTER_TURN))
        }

        def verdicts(scene, turn):
            self.assertIn("pins", scene.name)
            return [3, 1, 2] if turn[0, 0] == 1 else [5, 0, 4]

        with mock.patch.object(self.bench, "verdicts", verdicts):
            rows, first = measurement.in_images(self.bench, draws)
        self.assertEqual(rows, [["one", 6, 3, 1, 2, 7, 4], ["two", 9, 5, 0, 4, 7, 4]])
        self.assertEqual(first.name, "image-0-pins")

    def test_clouds_are_searched_in_the_bin_and_everywhere(self):
        scan = scans.CloudScan(np.ones((3, 3)), np.eye(3))
        rows, (in_bin, everywhere) = measurement.in_clouds(self.bench, {"one": scan})
        # "cloud" has one o; its pose is on no pin
        self.assertEqual(rows, [["one", 1, 0, 0, 1, 7, 1, 0, 0, 1, 7]])
        self.assertFalse(in_bin.whole_cloud)
        self.assertTrue(everywhere.whole_cloud)


class DrawsTest(unittest.TestCase):
    def test_the_first_is_the_scan_as_it_is_and_no_two_are_alike(self):
        with tempfile.TemporaryDirectory() as folder:
            data = Path(folder)
            levels = np.random.default_rng(3).integers(1, 9000, (8, 9)).astype(np.uint16)
            scans.Image.fromarray(levels).save(data / "depth.png")
            (data / "bins.yaml").write_text("regions: {pins: {min: [0, 0, 0], max: [1, 1, 1]}}\n")
            (data / "camera.yaml").write_text(
                "{width: 9, height: 8, fx: 9.0, fy: 9.0, cx: 4.0, cy: 3.0, depth_unit_m: 0.0001}\n"
            )
            points = np.random.default_rng(4).uniform(1, 500, (3000, 3))
            write_cloud(points, data / "one_bin.pcd")
            images, clouds = scans.image_draws(data), scans.cloud_draws(data)
            first = next(iter(clouds.values()))
            first.write(data / "copy")
            self.assertEqual(
                (data / "copy/cloud.pcd").read_bytes(), (data / "one_bin.pcd").read_bytes()
            )
        first = next(iter(images.values()))
        np.testing.assert_array_equal(first.levels, levels)
        kinds = {(scan.levels.tobytes(), str(scan.regions)) for scan in images.values()}
        self.assertEqual(len(kinds), len(images))
        np.testing.assert_allclose(clouds["as it is"].points, points / 1000, rtol=1e-6)
        kinds = {(scan.points.tobytes(), scan.deeper_m) for scan in clouds.values()}
        self.assertEqual(len(kinds), len(clouds))


class ReportTest(unittest.TestCase):
    def test_the_mean_is_that_of_each_column(self):
        rows = report.with_mean([["a", 1, 10], ["b", 2, 20]])
        self.assertEqual(rows[-1], ["**mean**", "1.5", "15.0"])


if __name__ == "__main__":
    unittest.main()
