"""Variants of the real scans whose regions end elsewhere."""

import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np
import yaml

PACKAGE = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PACKAGE / "scripts")]

from real_scan_lib import scans  # after the path that it is found on

CAMERA = {
    **{"width": 4, "height": 3, "fx": 100.0, "fy": 100.0, "cx": 1.5, "cy": 1.0},
    **{"depth_unit_m": 0.0001, "frame_id": "camera"},
}


def written_region(write):
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder))
        return yaml.safe_load((Path(folder) / "roi.yaml").read_text())


class Regions(unittest.TestCase):
    def test_those_of_an_image_end_farther_away_and_stay_as_they_are_otherwise(self):
        box = (np.array([-0.1, -0.2, 0.4]), np.array([0.1, 0.2, 0.5]))
        levels = np.full((3, 4), 4500, np.uint16)
        scan = scans.ImageScan(levels, CAMERA, {"pins": box, "motors": box}, np.eye(3))
        for by_m in scans.FLOORS.values():
            region = written_region(lambda f, d=by_m: scan.deeper(d).write("motors", f))
            np.testing.assert_allclose(region["min"], [-0.1, -0.2, 0.4])
            np.testing.assert_allclose(region["max"], [0.1, 0.2, 0.5 + by_m])

    def test_that_of_a_turned_cloud_ends_farther_away(self):
        scan = scans.CloudScan(np.array([[0.0, 0.0, 0.48], [0.01, 0.0, 0.48]]), np.eye(3))
        deeper = replace(scan.turned(30), deeper_m=0.002)
        region = written_region(deeper.write)
        np.testing.assert_allclose(region["min"], scans.INSIDE[0])
        np.testing.assert_allclose(region["max"], scans.INSIDE[1] + [0, 0, 0.002])

    def test_both_scans_have_a_shallower_and_a_deeper_one(self):
        self.assertEqual(sorted(scans.FLOORS.values()), [-scans.FLOOR_M, scans.FLOOR_M])
        self.assertEqual(len(set(scans.FLOORS)), 2)


if __name__ == "__main__":
    unittest.main()
