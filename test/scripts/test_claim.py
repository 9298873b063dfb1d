"""Precision at a recall, against counting by hand; and intervals."""

import math
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from claim_lib import report
from claim_lib.precision import Ranking, bootstrap


def ranking(*scenes):
    """Each scene: its targets, and pairs of score and right or wrong."""
    return Ranking.of([(t, [((score,), right) for score, right in poses]) for t, poses in scenes])


class PrecisionAtRecall(unittest.TestCase):
    def test_counts_the_shortest_list_that_reaches_it(self):
        ranked = ranking((2, [(0.9, True), (0.5, False)]), (2, [(0.8, False), (0.4, True)]))
        np.testing.assert_allclose(ranked.precision_at([0.25, 0.5]), [1, 2 / 4])
        self.assertTrue(math.isnan(ranked.precision_at([0.75])[0]))

    def test_is_nothing_without_poses(self):
        self.assertTrue(math.isnan(ranking((3, [])).precision_at([0.3])[0]))

    def test_counts_scenes_as_often_as_told(self):
        ranked = ranking((1, [(0.9, True)]), (1, [(0.95, False), (0.1, True)]))
        self.assertAlmostEqual(ranked.precision_at([1.0], np.array([3, 1]))[0], 4 / 5)
        self.assertAlmostEqual(ranked.precision_at([1.0], np.array([1, 0]))[0], 1)

    def test_ranks_by_the_first_key_first(self):
        ranked = Ranking.of([(1, [((False, 0.9), False), ((True, 0.2), True)])])
        self.assertEqual(ranked.precision_at([1.0])[0], 1)

    def test_is_that_of_counting_scene_by_scene(self):
        generator = np.random.default_rng(5)
        scenes = [
            (4, [(generator.random(), generator.random() < 0.6) for _ in range(6)])
            for _ in range(20)
        ]
        ranked = ranking(*scenes)
        for recall in (0.1, 0.4, 0.7):
            poses = sorted((p for _, poses in scenes for p in poses), reverse=True)
            right = 0
            for count, (_, is_right) in enumerate(poses, 1):
                right += is_right
                if right >= recall * 80:
                    break
            self.assertAlmostEqual(ranked.precision_at([recall])[0], right / count)


class Bootstrap(unittest.TestCase):
    def test_holds_the_difference_and_is_nothing_for_the_same(self):
        generator = np.random.default_rng(7)
        worse, better = [], []
        for _ in range(40):
            rights = generator.random(5) < 0.7
            worse.append((4, [(generator.random(), r) for r in rights]))
            better.append((4, [(0.5 + 0.1 * r + 0.1 * generator.random(), r) for r in rights]))
        low, high = bootstrap(ranking(*worse), ranking(*better), [0.5])
        self.assertGreater(low[0], 0)
        self.assertGreater(high[0], low[0])
        same = bootstrap(ranking(*worse), ranking(*worse), [0.5])
        np.testing.assert_array_equal(same, [[0], [0]])

    def test_tells_nothing_of_a_recall_that_is_not_reached(self):
        ranked = ranking((4, [(0.9, True)]))
        self.assertTrue(np.isnan(bootstrap(ranked, ranked, [0.9])).all())


def pose(reason, spread, verdict):
    """As written by detect_poses, with its verdict."""
    return {"reason": reason, "reliable": not reason, "spread": spread}, verdict


class Tables(unittest.TestCase):
    def test_each_reason_counts_what_it_turns_down(self):
        poses = [pose("", 0.1, "right"), pose("", 0.1, "right"), pose("SPREAD", 2, "wrong")]
        poses += [pose("SPREAD", 2, "right"), pose("SLIPPAGE", 0, "duplicate")]
        lines = report.reason_table(poses).splitlines()
        self.assertIn("| SPREAD | 1 | 1 |", lines)
        self.assertIn("| none: reliable | 0 | 2 |", lines)
        self.assertEqual(len(lines), 4)  # a second pose on a part is neither

    def test_spreads_are_those_of_poses_called_reliable(self):
        high = report.MAX_SPREAD + 0.1
        poses = [pose("", spread, "right") for spread in (0.1, 0.2, 0.3, high)]
        poses += [pose("LOW_SCORE", 9, "right")]
        lines = report.spread_table(poses).splitlines()
        self.assertIn("| wrong | 0 | - | - | 0 |", lines)
        self.assertTrue(lines[-1].startswith("| right | 4 | 0.25 | "), lines)
        self.assertTrue(lines[-1].endswith(" | 1 |"), lines)


if __name__ == "__main__":
    unittest.main()
