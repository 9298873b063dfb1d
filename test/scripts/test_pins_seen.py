"""The judgement of poses by where a person sees the pins."""

import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

PACKAGE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("PPF_BIN_PICKING_DATA", PACKAGE / "../shared/data"))
PICTURE = DATA / "real/pins/preview.jpg"
CLOUD = DATA / "real/pins/one_bin.pcd"
AT_THE_WALL = 7  # of the cloud's pins: its tail is not to be seen
sys.path[:0] = [str(PACKAGE / "scripts"), str(PACKAGE / "test/scripts")]

from real_scan_lib import seen  # after the path that it is found on
from support import write_part

CAMERA = {"fx": 1800.0, "fy": 1790.0, "cx": 980.0, "cy": 610.0}


class EndsTest(unittest.TestCase):
    def ends(self, corners_mm, symmetry):
        with tempfile.TemporaryDirectory() as folder:
            write_part(Path(folder), corners_mm)
            part_file = Path(folder) / "part.yaml"
            part_file.write_text(
                f"unit: mm\nmesh: model.stl\nsymmetries_continuous: [{symmetry}]\n"
            )
            return seen.head_and_tail_m(part_file)

    def test_the_head_is_where_the_part_is_widest(self):
        symmetry = "{axis: [2, 0, 0], point: [0, 1, 0]}"
        ends = self.ends([[0, 6, 0], [20, 3, 0], [7, 1, 2]], symmetry)
        np.testing.assert_allclose(ends, [[0, 0.001, 0], [0.02, 0.001, 0]], atol=1e-9)
        ends = self.ends([[0, 3, 0], [20, 6, 0], [7, 1, 2]], symmetry)
        np.testing.assert_allclose(ends, [[0.02, 0.001, 0], [0, 0.001, 0]], atol=1e-9)

    def test_the_axis_may_lie_askew(self):
        slope = np.array([1, 0, -1]) / 2**0.5
        side = np.array([0, 1, 0])
        corners = [-10 * slope + 4 * side, 12 * slope + side, 2 * side]
        symmetry = f"{{axis: {slope.tolist()}, point: [0, 0, 0]}}"
        expected = np.outer([-0.010, 0.012], slope)
        np.testing.assert_allclose(self.ends(corners, symmetry), expected, atol=1e-6)


class VerdictTest(unittest.TestCase):
    """Three pins in the picture, and a part of 30 mm along x on one of them."""

    ENDS = np.array([[-0.015, 0, 0], [0.015, 0, 0]])

    def setUp(self):
        self.pose = np.eye(4)
        self.pose[:3, :3] = [[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]]
        self.pose[:3, 3] = [-0.02, 0.03, 0.49]
        pixels, self.width_m = seen.picture_view(CAMERA).places(
            self.ENDS @ self.pose[:3, :3].T + self.pose[:3, 3]
        )
        self.pins = [pixels + 70, pixels, pixels - [100, 0]]

    def verdict(self, pose):
        return seen.verdict(pose, self.ENDS, seen.picture_view(CAMERA, self.pins))

    def moved(self, offset_m):
        pose = self.pose.copy()
        pose[:3, 3] += offset_m
        return pose

    def test_a_pixel_of_the_picture_is_two_of_the_image(self):
        # the corner between the image's first four pixels is the middle of the picture's first pixel
        z = 0.5
        point = np.array([[(0.5 - CAMERA["cx"]) / 1800 * z, (0.5 - CAMERA["cy"]) / 1790 * z, z]])
        pixels, width_m = seen.picture_view(CAMERA).places(point)
        np.testing.assert_allclose(pixels, [[0.5, 0.5]], atol=1e-9)
        np.testing.assert_allclose(width_m, [2 * z / 1800])

    def test_a_pose_on_a_pin_is_right(self):
        self.assertEqual(self.verdict(self.pose), "right")
        self.assertEqual(self.verdict(self.moved([0.9 * seen.NEAR_M, 0, 0])), "right")
        self.assertEqual(self.verdict(self.moved([0, 0, 0.002])), "right")

    def test_head_on_tail_is_end_for_end(self):
        turned = self.pose.copy()
        turned[:3, :3] = self.pose[:3, :3] @ np.diag([-1, 1, -1])
        self.assertEqual(self.verdict(turned), "end for end")

    def test_the_nearer_of_two_pins_that_lie_the_other_way_round_decides(self):
        aside_m = 1.2 * seen.NEAR_M * np.array([0.8, -0.6, 0])
        head, tail = self.pins[1]
        self.pins[1] = np.array([tail, head])
        self.pins[2] = np.array([head, tail]) + aside_m[:2] / self.width_m[0]
        self.assertEqual(self.verdict(self.moved(0.3 * aside_m)), "end for end")
        self.assertEqual(self.verdict(self.moved(0.7 * aside_m)), "right")

    def test_a_pose_beside_every_pin_is_elsewhere(self):
        self.assertEqual(self.verdict(self.moved([1.1 * seen.NEAR_M, 0, 0])), "elsewhere")
        across = self.pose.copy()
        across[:3, :3] = np.eye(3)
        self.assertEqual(self.verdict(across), "elsewhere")

    @unittest.skipUnless(PICTURE.is_file(), f"{PICTURE} is missing: set PPF_BIN_PICKING_DATA")
    def test_tails_are_darker_than_heads(self):
        with Image.open(PICTURE) as picture:
            blue = np.array(picture.convert("RGB"))[:, :, 2].astype(float)  # tails are brown

        def brightness(head, tail, shares):
            places = (head + np.outer(shares, tail - head)).astype(int)
            return np.mean([blue[y - 1 : y + 2, x - 1 : x + 2].max() for x, y in places])

        for head, tail in np.array(seen.PICTURE_PINS):
            with self.subTest(head=head):
                self.assertGreater(
                    brightness(head, tail, np.linspace(0.05, 0.3, 12)),
                    brightness(head, tail, np.linspace(0.75, 0.97, 12)),
                )

    @unittest.skipUnless(CLOUD.is_file(), f"{CLOUD} is missing: set PPF_BIN_PICKING_DATA")
    def test_tails_are_browner_than_heads_in_the_cloud(self):
        rows = np.frombuffer(CLOUD.read_bytes().split(b"DATA binary\n")[1], "<f4").reshape(-1, 7)
        directions = seen.cloud_view().places(rows[:, :3])[0]
        blue = (rows[:, 6].copy().view(np.uint32) & 255).astype(float)

        def brightness(head, tail, shares):
            places = head + np.outer(shares, tail - head)
            apart = np.linalg.norm(places[:, None] - directions, axis=2)
            return np.mean([blue[near < 2.5].max() for near in apart])

        for head, tail in np.delete(seen.CLOUD_PINS, AT_THE_WALL, axis=0):
            with self.subTest(head=head):
                self.assertGreater(
                    brightness(head, tail, np.linspace(0.05, 0.3, 12)),
                    brightness(head, tail, np.linspace(0.8, 0.97, 12)),
                )

    def test_a_place_in_the_cloud_is_a_thousandth_of_its_distance(self):
        places, width_m = seen.cloud_view().places(np.array([[0.01, -0.02, 0.5]]))
        np.testing.assert_allclose(places, [[20, -40]])
        np.testing.assert_allclose(width_m, [0.0005])

    def test_the_pins_are_equally_long_and_none_stands_there_twice(self):
        for pins in (seen.PICTURE_PINS, seen.CLOUD_PINS):
            head, tail = np.array(pins).swapaxes(0, 1)
            long = np.linalg.norm(head - tail, axis=1)
            self.assertGreater(long.min(), 0.9 * np.median(long))
            self.assertLess(long.max(), 1.1 * np.median(long))
            middles = (head + tail) / 2
            apart = np.linalg.norm(middles[:, None] - middles, axis=2)
            apart += 1000 * np.eye(len(middles))
            self.assertGreater(apart.min(), 5)  # none twice


if __name__ == "__main__":
    unittest.main()
