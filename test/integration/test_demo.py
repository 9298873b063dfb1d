#!/usr/bin/python3
"""The demo ends by itself with right poses, and its client can tell right poses from wrong ones."""
import re
import subprocess
import sys
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

import numpy as np
import rostest
from roslib.packages import find_node

PACKAGE = Path(__file__).resolve().parents[2]
client = SourceFileLoader("demo_client", str(PACKAGE / "src/sim_node/demo_client.py")).load_module()


def part(name):
    return client.Part(str(PACKAGE / f"config/parts/{name}.yaml"))


def turned(model, axis, angle_deg):
    """A truth somewhere, and the same pose turned about the part's axis through its origin."""
    truth = client.turn_about([1, 2, 3], 0.7, np.array([0.4, 0.1, -0.2]))
    return model.error(truth @ client.turn_about(axis, np.radians(angle_deg), np.zeros(3)), truth)


class DemoTest(unittest.TestCase):
    def test_sees_no_error_in_symmetric_turns(self):
        for name, axis, angle_deg in [
            ("tee", [0, 0, 1], 180),
            ("bolt", [0, 0, 1], 77),
            ("gear", [0, 0, 1], 45),
            ("gear", [1, 0, 0], 180),
        ]:
            surface, center, turn = turned(part(name), axis, angle_deg)
            self.assertLess(surface, 1e-6, name)
            self.assertLess(center, 1e-6, name)
            self.assertLess(turn, 1e-3, name)

    def test_looks_at_the_centre_of_a_ball_alone(self):
        ball = part("sphere")
        surface, center, turn = turned(ball, [1, 2, 3], 50)
        self.assertLess(surface, 5e-5)  # its facets
        self.assertEqual(surface, center)
        self.assertEqual(turn, 0)
        pose = np.eye(4)
        pose[1, 3] = 0.003
        self.assertAlmostEqual(ball.error(pose, np.eye(4))[0], 0.003)

    def test_sees_other_turns(self):
        for name, axis in [("bracket", [0, 0, 1]), ("tee", [1, 0, 0]), ("bolt", [1, 0, 0])]:
            model = part(name)
            surface, _, turn = turned(model, axis, 180)
            self.assertGreater(surface, client.WRONG_REL * model.diameter, name)
            self.assertGreater(turn, 90, name)

    def test_measures_a_shift(self):
        model = part("bracket")
        pose = np.eye(4)
        pose[:3, 3] = 0.003, 0, 0.004
        surface, center, turn = model.error(pose, np.eye(4))
        self.assertAlmostEqual(surface, 0.005)
        self.assertAlmostEqual(center, 0.005)
        self.assertAlmostEqual(turn, 0)

    def test_camera_names_a_misspelt_parameter(self):
        node = find_node("ppf_bin_picking", "simulated_camera")[0]
        command = [node, "_conut:=3", "__name:=other_camera"]  # parameters outlive their node
        run = subprocess.run(command, capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, 2)
        self.assertIn("unknown key 'conut': the nearest known name is 'count'", run.stderr)

    def test_demo_ends_with_right_poses(self):
        demo = subprocess.run(
            ["roslaunch", "ppf_bin_picking", "demo.launch"],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,  # roslaunch says there how its processes ended
            text=True,
            timeout=280,
        )
        output = demo.stdout
        self.assertRegex(output, r"demo_client-\d+\] has died!\s+process has finished cleanly")
        summary = re.search(r"(\d+) parts in the bin, (\d+) reliable poses, (\d+) wrong", output)
        self.assertIsNotNone(summary, output)
        parts, poses, wrong = (int(number) for number in summary.groups())
        self.assertEqual(parts, 14)
        self.assertGreaterEqual(poses, 7)
        self.assertEqual(wrong, 0)


if __name__ == "__main__":
    rostest.rosrun("ppf_bin_picking", "demo", DemoTest, sys.argv)
