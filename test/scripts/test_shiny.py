"""The shiny copies of scenes that scripts/fit_reliability learns from."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

PACKAGE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PACKAGE / "scripts"))

from reliability_lib import shiny  # after the path that it is found on


class ShinyTest(unittest.TestCase):
    """A floor at 1000 with, on its left, a block at 800 and a ramp of 60 degrees; some pixels are empty."""

    FOCAL_PX = 500

    def setUp(self):
        self.depth = np.full((120, 160), 1000.0)
        self.depth[20:100, 20:60] = 800
        columns = np.arange(40)
        self.depth[20:100, 90:130] = 1000 - np.tan(np.pi / 3) * columns * 900 / self.FOCAL_PX
        self.depth[110:, :] = 0

    def shiny(self, seed):
        return shiny.make_shiny(self.depth, self.FOCAL_PX, np.random.default_rng(seed))

    def test_surfaces_that_face_the_camera_stay_as_they_are(self):
        for seed in range(10):
            result = self.shiny(seed)
            np.testing.assert_array_equal(result[30:90, 30:50], self.depth[30:90, 30:50])
            np.testing.assert_array_equal(result[:10, :], self.depth[:10, :])

    def test_every_pixel_is_as_before_empty_or_as_deep_as_a_kept_one(self):
        for seed in range(10):
            result = self.shiny(seed)
            changed = (result != self.depth) & (result > 0)
            kept = np.where((result == self.depth) & (result > 0), result, 0)
            deepest = shiny.ndimage.maximum_filter(kept, size=2 * shiny.REACH_PX[1] + 1)
            self.assertTrue(np.isin(result[changed], self.depth).all())
            self.assertTrue((result[changed] <= deepest[changed]).all())

    def test_steep_surfaces_are_lost(self):
        for seed in range(10):
            ramp = (slice(30, 90), slice(100, 120))
            same = self.shiny(seed)[ramp] == self.depth[ramp]
            self.assertEqual(same.sum(), 0, f"seed {seed}")

    def test_in_some_places_what_lies_behind_shows_through_and_others_are_empty(self):
        shown = []
        for seed in range(10):
            result = self.shiny(seed)
            kept = (result == self.depth) & (result > 0)
            fillable = shiny.ndimage.maximum_filter(kept, size=shiny.REACH_PX[0])
            lost = (self.depth > 0) & ~kept & fillable
            self.assertTrue((result[lost] == 0).any(), f"seed {seed}")
            shown.append((result[30:90, 50:60] == 1000).any())
        self.assertGreater(sum(shown), 5)

    def test_pixels_beside_empty_ones_are_lost(self):
        self.depth = np.repeat(1000 + 0.2 * np.arange(120.0)[:, None], 160, axis=1)
        self.depth[60, :] = 0
        for seed in range(10):
            same = self.shiny(seed) == self.depth
            self.assertFalse(same[[59, 61], :].any(), f"seed {seed}")
            self.assertTrue(same[[57, 63], :].all(), f"seed {seed}")

    def test_some_of_the_pixels_that_were_empty_stay_so(self):
        filled = np.array([self.shiny(seed)[109:111, :] > 0 for seed in range(20)])
        lost_row, empty_row = filled.mean(axis=(0, 2))
        self.assertAlmostEqual(empty_row / lost_row, 1 - shiny.EMPTY_SHARE, delta=0.05)

    def test_empty_regions_out_of_reach_stay_empty(self):
        self.depth[60:, :] = 0
        self.assertEqual(self.shiny(1)[80:, :].max(), 0)

    def test_a_seed_repeats(self):
        np.testing.assert_array_equal(self.shiny(4), self.shiny(4))
        self.assertTrue((self.shiny(4) != self.shiny(5)).any())

    def test_a_scene_is_copied_with_its_truth(self):
        with tempfile.TemporaryDirectory() as folder:
            source, copy = Path(folder) / "part/plain", Path(folder) / "part/shiny"
            source.mkdir(parents=True)
            image = shiny.Image.fromarray(self.depth.astype(np.uint16))
            image.save(source / "depth.png")
            (source / "camera.yaml").write_text("fx: 500\n")
            (source / "gt.json").write_text("{}")
            (source / "roi.yaml").write_text("x: 1\n")
            shiny.write_shiny_scene(source, copy)
            self.assertEqual((copy / "gt.json").read_text(), "{}")
            with shiny.Image.open(copy / "depth.png") as image:
                written = np.array(image)
        np.testing.assert_array_equal(written[30:90, 30:50], 800)


if __name__ == "__main__":
    unittest.main()
