#!/usr/bin/python3
"""The demo empties a small bin by itself without a wrong pick, and its robot counts what becomes of its picks."""
import contextlib
import io
import re
import subprocess
import sys
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

import rostest
from ppf_bin_picking.msg import MismatchRegion, PickablePose
from ppf_bin_picking.srv import GetPickablePosesResponse as Answer
from ppf_bin_picking.srv import PickPartResponse as Pick

PACKAGE = Path(__file__).resolve().parents[2]
robot = SourceFileLoader(
    "robot_client", str(PACKAGE / "src/sim_node/robot_client.py")
).load_module()
robot.rospy.is_shutdown = lambda: False  # this test has no node


def answer(status, poses=0, reasons=()):
    regions = [MismatchRegion(reason=reason) for reason in reasons]
    found = [PickablePose(id="part/%d" % k, score=0.9) for k in range(poses)]
    return Answer(status=status, message="said.", poses=found, mismatching_regions=regions)


def pick(status, parts_left, error_m=0.001):
    success = status == Pick.OK
    return Pick(success=success, status=status, parts_left=parts_left, error_m=error_m)


class ScriptedCell:
    """Gives these answers and results, one after the other."""

    def __init__(self, answers, picks=()):
        self.answers = list(answers)
        self.picks = list(picks)

    def detect(self):
        return self.answers.pop(0)

    def pick(self, found, header):
        return self.picks.pop(0)


def run(cell, further_shots=2):
    """What the robot counts; fails if it did not use all of the script."""
    summary = robot.Summary()
    with contextlib.redirect_stdout(io.StringIO()):
        robot.empty_bin(cell, further_shots, summary)
    assert not cell.answers and not cell.picks
    return summary


class DemoTest(unittest.TestCase):
    def test_stops_when_the_bin_is_empty(self):
        cell = ScriptedCell(
            [answer(Answer.OK, 2), answer(Answer.TIME_LIMIT, 1)],
            [pick(Pick.OK, 1), pick(Pick.OK, 0)],
        )
        summary = run(cell)
        self.assertEqual(
            (summary.picked, summary.wrong, summary.blocked, summary.left), (2, 0, 0, 0)
        )
        self.assertIn("2 picked, 0 wrong picks, 0 blocked picks, 0 parts left", summary.text())
        self.assertIn("the bin is empty", summary.text())

    def test_tries_the_next_best_pose_and_counts_why(self):
        picks = [pick(Pick.COVERED, 2), pick(Pick.NO_PART_THERE, 2), pick(Pick.OK, 1)]
        nothing = answer(
            Answer.NO_PICKABLE_POSE,
            0,
            [MismatchRegion.SPREAD, MismatchRegion.LOW_SCORE],
        )
        summary = run(ScriptedCell([answer(Answer.OK, 3)] + 3 * [nothing], picks))
        self.assertEqual(
            (summary.picked, summary.wrong, summary.blocked, summary.left), (1, 1, 1, 1)
        )
        self.assertEqual(
            summary.why(),
            "NO_PICKABLE_POSE; mismatching regions: 1 SPREAD, 1 LOW_SCORE",
        )

    def test_looks_again_before_it_gives_up(self):
        nothing = answer(Answer.NO_PICKABLE_POSE)
        script = [nothing, nothing, answer(Answer.OK, 1), nothing, nothing, nothing]
        self.assertEqual(run(ScriptedCell(script, [pick(Pick.OK, 3)])).picked, 1)
        self.assertEqual(run(ScriptedCell([nothing]), further_shots=0).picked, 0)
        blocked = ScriptedCell(3 * [answer(Answer.OK, 1)], 3 * [pick(Pick.COVERED, 1)])
        self.assertIn(
            "OK, but no pose could be picked; mismatching regions: none", run(blocked).text()
        )

    def test_says_what_is_broken(self):
        with self.assertRaisesRegex(robot.Broken, "said."):
            run(ScriptedCell([answer(Answer.NO_CLOUD)]))

    def test_summary_of_nothing_can_be_printed(self):
        self.assertIn("0 picked, 0 wrong", robot.Summary().text())

    def test_empties_a_small_bin(self):
        demo = subprocess.run(
            ["roslaunch", "ppf_bin_picking", "demo.launch", "count:=4"],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,  # roslaunch says there how its processes ended
            text=True,
            timeout=280,
        )
        self.assertRegex(
            demo.stdout, r"robot_client-\d+\] has died!\s+process has finished cleanly"
        )
        summary = re.search(r"(\d+) picked, (\d+) wrong picks.* (\d+) parts left", demo.stdout)
        self.assertIsNotNone(summary, demo.stdout)
        self.assertEqual(summary.groups(), ("4", "0", "0"), demo.stdout)


if __name__ == "__main__":
    rostest.rosrun("ppf_bin_picking", "demo", DemoTest, sys.argv)
