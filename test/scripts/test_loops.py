"""The bound of the share of wrong picks, against the binomial distribution."""

import sys
import unittest
from pathlib import Path

from scipy.stats import binom

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from benchmark_lib.report import loop_sums
from loops_lib.bound import upper_bound


class UpperBound(unittest.TestCase):
    def test_leaves_five_percent_to_what_was_seen_or_less(self):
        for wrong, picks in ((0, 100), (1, 95), (3, 700), (20, 40)):
            bound = upper_bound(wrong, picks)
            self.assertAlmostEqual(binom.cdf(wrong, picks, bound), 0.05, places=9)
            self.assertGreater(bound, wrong / picks)

    def test_is_one_where_all_are_wrong_or_none_was_tried(self):
        self.assertEqual(upper_bound(4, 4), 1)
        self.assertEqual(upper_bound(0, 0), 1)

    def test_refuses_more_wrong_ones_than_picks(self):
        with self.assertRaises(ValueError):
            upper_bound(2, 1)


class LoopSums(unittest.TestCase):
    def test_adds_loop_by_loop(self):
        loop = {"picked": 5, "wrong": 1, "blocked": 2, "left": 3, "cycles": 8, "why": "empty"}
        self.assertEqual(
            loop_sums([loop, loop]),
            {"picked": 10, "wrong": 2, "blocked": 4, "left": 6, "cycles": 16},
        )


if __name__ == "__main__":
    unittest.main()
