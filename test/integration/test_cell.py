#!/usr/bin/python3
"""The simulated cell's services: picks right and wrong, refills, triggers; what it publishes, and when."""
import subprocess
import sys
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Pose, PoseArray, PoseStamped
from ppf_bin_picking.srv import PickPart, PickPartResponse, RefillBin
from roslib.packages import find_node
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from running_detector import LONG_S, wait_until

CELL = "/simulated_cell/"


class Received:
    """The messages of a topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, kind, self.messages.append)
        wait_until(lambda: self.messages, "a message on " + topic)

    def next(self, action):
        """The message that comes after an action begins, and the action's result."""
        known = len(self.messages)
        result = action()
        return wait_until(lambda: self.messages[known:], "another message")[-1], result


class CellTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for name in ("pick", "trigger", "refill"):
            rospy.wait_for_service(CELL + name, LONG_S)
        cls.pick_part = rospy.ServiceProxy(CELL + "pick", PickPart)
        cls.trigger = rospy.ServiceProxy(CELL + "trigger", Trigger)
        cls.refill = rospy.ServiceProxy(CELL + "refill", RefillBin)
        cls.clouds = Received(CELL + "points", PointCloud2)
        cls.truths = Received(CELL + "truth", PoseArray)
        frames = Received("/tf_static", TFMessage)
        cls.frames = wait_until(
            lambda: {
                t.child_frame_id: t
                for message in frames.messages
                for t in message.transforms
                if t.header.frame_id == "base_link"
            },
            "frames of the cell",
        )

    def truth(self):
        return self.truths.messages[-1]

    def pick(self, pose, frame="base_link", model_id=""):
        request = PoseStamped(pose=pose)
        request.header.frame_id = frame
        return self.pick_part(pose=request, model_id=model_id)

    def take_one(self):
        """Picks at the true poses until one part is out. Returns the poses before that and its index."""
        before = self.truth().poses
        for index, pose in enumerate(before):
            result = self.pick(pose)
            if result.success:
                return before, index, result
            self.assertEqual(result.status, PickPartResponse.COVERED)
        raise AssertionError("no part is free")

    def test_frames_and_clouds_belong_together(self):
        self.assertEqual(set(self.frames), {"bin", "camera_optical_frame"})
        self.assertEqual(self.frames["bin"].transform.translation.x, 0.5)
        cloud = self.clouds.messages[-1]
        self.assertEqual(cloud.header.frame_id, "camera_optical_frame")
        self.assertEqual((cloud.width, cloud.height), (640, 480))
        self.assertEqual([f.name for f in cloud.fields], ["x", "y", "z", "intensity"])
        self.assertEqual(self.truth().header.frame_id, "base_link")

    def test_trigger_takes_a_new_shot_of_the_same_pile(self):
        before = self.truth()
        first, result = self.clouds.next(self.trigger)
        self.assertTrue(result.success)
        self.assertRegex(result.message, r"\d+ of 307200 pixels measured, \d parts? in the bin")
        second, _ = self.clouds.next(self.trigger)
        self.assertGreater(second.header.stamp, first.header.stamp)
        self.assertTrue(second.data != first.data)
        self.assertEqual(self.truth(), before)

    def test_pick_takes_a_part_out_and_shows_the_others(self):
        self.truths.next(lambda: self.refill(count=1))
        cloud = self.clouds.messages[-1]
        truth, (before, index, result) = self.truths.next(self.take_one)
        self.assertEqual(result.status, PickPartResponse.OK)
        self.assertAlmostEqual(result.error_m, 0, places=6)
        self.assertEqual(result.message, f"part {index} is taken, its surface off by up to 0.0 mm")
        self.assertEqual(result.parts_left, len(before) - 1)
        self.assertEqual(len(truth.poses), len(before) - 1)
        wait_until(lambda: self.clouds.messages[-1].data != cloud.data, "a new shot")

    def test_pick_in_another_frame(self):
        self.truths.next(lambda: self.refill(count=1))
        in_base = self.truth().poses[-1]  # the last to fall
        bin_origin = self.frames["bin"].transform.translation
        in_bin = Pose(orientation=in_base.orientation)
        for axis in "xyz":
            value = getattr(in_base.position, axis) - getattr(bin_origin, axis)
            setattr(in_bin.position, axis, value)
        result = self.pick(in_bin, "bin", "bracket")
        self.assertIn(result.status, (PickPartResponse.OK, PickPartResponse.COVERED))
        self.assertAlmostEqual(result.error_m, 0, places=6)

    def test_wrong_pose_changes_nothing_and_is_explained(self):
        before = self.truth()
        pose = Pose(position=before.poses[0].position)
        pose.orientation.w = 1.0
        pose.position.z += 0.05
        result = self.pick(pose)
        self.assertFalse(result.success)
        self.assertEqual(result.status, PickPartResponse.NO_PART_THERE)
        self.assertRegex(
            result.message,
            r"no part lies there: the nearest, part \d, is off by \d+\.\d mm and",
        )
        self.assertGreater(result.error_m, 0.008)
        self.assertEqual(result.parts_left, len(before.poses))
        self.assertEqual(self.truth(), before)

    def test_requests_that_cannot_be_met_say_why(self):
        pose = self.truth().poses[0]
        for result, words in (
            (self.pick(pose, "nowhere"), "frame 'nowhere' is unknown"),
            (self.pick(pose, ""), "frame '' is unknown"),
            (
                self.pick(pose, model_id="tee"),
                "no part 'tee' in the cell, which holds 'bracket'",
            ),
            (self.pick(Pose()), "the pose is none"),
        ):
            self.assertEqual(result.status, PickPartResponse.BAD_REQUEST)
            self.assertIn(words, result.message)
            self.assertFalse(result.success)
            self.assertEqual(result.error_m, -1)
        result = self.refill(count=1000)
        self.assertFalse(result.success)
        self.assertIn("more than 500 parts", result.message)
        self.assertEqual(result.parts_left, len(self.truth().poses))

    def test_streams_at_a_rate(self):
        clouds = Received("/streaming_cell/points", PointCloud2)
        wait_until(lambda: len(clouds.messages) > 4, "a stream of clouds")
        stamps = [message.header.stamp.to_sec() for message in clouds.messages[1:]]
        self.assertTrue((np.diff(stamps) > 0).all())
        self.assertTrue(clouds.messages[-1].data != clouds.messages[-2].data)

    def test_names_a_misspelt_parameter(self):
        node = find_node("ppf_bin_picking", "simulated_cell")[0]
        command = [
            node,
            "_conut:=3",
            "__name:=other_cell",
        ]  # parameters outlive their node
        run = subprocess.run(command, capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, 2)
        self.assertIn("unknown key 'conut': the nearest known name is 'count'", run.stderr)


if __name__ == "__main__":
    rospy.init_node("cell_test")
    rostest.rosrun("ppf_bin_picking", "cell", CellTest, sys.argv)
