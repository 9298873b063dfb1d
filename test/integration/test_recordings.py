#!/usr/bin/python3
"""A small bag of each preset, recorded now, through replay.launch: no reliable pose contradicts the bag's truth."""
import filecmp
import hashlib
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
import rosbag
import roslib.packages
import rospkg
import rospy
import rostest
from ppf_bin_picking.srv import GetPickablePosesResponse as Response

from running_detector import Launched, call, matrix, wait_until

PACKAGE = rospkg.RosPack().get_path("ppf_bin_picking")
PART = os.path.join(PACKAGE, "config/parts/bracket.yaml")
CONFIG = os.path.join(PACKAGE, "config/simulated_cell.yaml")
CORNERS = np.array([[x, y, z, 1] for x in (-0.04, 0.04) for y in (-0.02, 0.02) for z in (0, 0.055)])
DIAMETER = 0.09  # of the bracket, about; it has no symmetry
SHOTS = 2


def record(output, config=CONFIG, **options):
    tool = roslib.packages.find_node("ppf_bin_picking", "record_cell")[0]
    command = [tool, "--config", config, "--part", PART, "--output", output]
    command += [text for name, value in options.items() for text in ("--" + name, str(value))]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def content(path):
    """A digest of what a bag's player publishes, and when."""
    digest = hashlib.sha256()
    with rosbag.Bag(path) as bag:
        for topic, message, stamp in bag.read_messages(raw=True):
            digest.update(topic.encode() + message[1] + str(stamp).encode())
    return digest.hexdigest()


def error(found, truth):
    """The largest distance between two places of a corner of the bracket's box [m]."""
    return np.linalg.norm(CORNERS @ (found - truth)[:3].T, axis=1).max()


class RecordingsTest(unittest.TestCase):
    def setUp(self):
        self.replay = Launched()
        self.bag = os.path.join(self.replay.folder, "cell.bag")

    def tearDown(self):
        self.replay.stop()

    def replay_preset(self, preset):
        """Answer to the replayed bag, and the truth in the bag."""
        made = record(self.bag, count=4, seed=3, preset=preset, shots=SHOTS)
        self.assertEqual(made.returncode, 0, made.stderr)
        with rosbag.Bag(self.bag) as bag:
            clouds = list(bag.read_messages("/camera/depth/points"))
            (truth,) = [m.message for m in bag.read_messages("/simulated_cell/truth")]
        self.assertEqual(len(clouds), SHOTS)
        is_same = clouds[0].message.data == clouds[1].message.data
        self.assertEqual(is_same, preset == "clean")  # which has no noise
        cell = os.path.join(PACKAGE, "config/demo_cell.yaml")
        self.replay.launch("replay.launch", "bag:=" + self.bag, "cell:=" + cell, "parts:=" + PART)
        self.replay.wait_ready()
        ended = "process has finished cleanly"
        wait_until(lambda: ended in self.replay.output(), "the bag ends")
        answer = call()
        self.assertEqual(answer.header.stamp, clouds[-1].message.header.stamp)
        return answer, truth

    def check(self, preset, least):
        answer, truth = self.replay_preset(preset)
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual(answer.header.frame_id, truth.header.frame_id)
        self.assertEqual(len(truth.poses), 4)
        self.assertGreaterEqual(len(answer.poses), least, preset)
        for found in answer.poses:
            errors = [error(matrix(found.pose.pose), matrix(pose)) for pose in truth.poses]
            self.assertLess(min(errors), 0.1 * DIAMETER, found.id)

    def test_clean(self):
        self.check("clean", 3)

    def test_industrial(self):
        self.check("industrial", 3)

    def test_low_cost(self):
        self.check("low_cost", 1)

    def test_same_arguments_give_the_same_bag(self):
        other = os.path.join(self.replay.folder, "other.bag")
        for path in (self.bag, other):
            self.assertEqual(record(path, count=1, seed=5, shots=1).returncode, 0)
        self.assertEqual(content(self.bag), content(other))
        self.assertEqual(record(other, count=1, seed=6, shots=1).returncode, 0)
        self.assertNotEqual(content(self.bag), content(other))

    def test_bad_arguments_are_named(self):
        for options, words in (
            ({"preset": "cheap"}, "cheap not in {clean,industrial,low_cost}"),
            ({"count": 501}, "--count"),
            ({"shots": 0}, "--shots"),
        ):
            made = record(self.bag, **options)
            self.assertEqual(made.returncode, 2)
            self.assertIn(words, made.stderr)
        made = record("/nowhere/cell.bag", count=0)
        self.assertEqual(made.returncode, 2)
        self.assertIn("/nowhere/cell.bag", made.stderr)

    def test_its_configuration_is_not_written_over(self):
        config = self.bag + ".yaml"
        shutil.copyfile(CONFIG, config)
        made = record(config, config=config, count=0)
        self.assertEqual(made.returncode, 2)
        self.assertIn("is both an input and the output", made.stderr)
        self.assertTrue(filecmp.cmp(CONFIG, config, shallow=False))


if __name__ == "__main__":
    rospy.init_node("recordings_test")
    rostest.rosrun("ppf_bin_picking", "recordings", RecordingsTest, sys.argv)
