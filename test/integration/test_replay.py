#!/usr/bin/python3
"""The real scan as a bag through replay.launch: the same poses as the command line's, also after the bag's end."""
import json
import os
import re
import subprocess
import sys
import unittest

import numpy as np
import roslib.packages
import rospkg
import rospy
import rostest
import yaml
from ppf_bin_picking.srv import GetPickablePosesRequest as Request
from ppf_bin_picking.srv import GetPickablePosesResponse as Response
from visualization_msgs.msg import Marker, MarkerArray

from running_detector import Launched, call, matrix, wait_until

PACKAGE = rospkg.RosPack().get_path("ppf_bin_picking")
DATA = os.environ.get("PPF_BIN_PICKING_DATA", os.path.join(PACKAGE, "../shared/data"))
PINS = os.path.join(DATA, "real/pins")
SETTINGS = os.path.join(PACKAGE, "config/detector.yaml")
# As make_cloud.py says: the camera looks straight down from 0.5 m.
BASE_FROM_CAMERA = np.diag([1.0, -1, -1, 1])
BASE_FROM_CAMERA[2, 3] = 0.5


class ReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(PINS, "bins.yaml")) as bins:
            cls.region = yaml.safe_load(bins)["regions"]["pins"]
        cls.replay = Launched()
        bag = os.path.join(cls.replay.folder, "pins.bag")
        subprocess.check_call([os.path.join(PINS, "make_cloud.py"), bag])
        cell = {
            "parts": os.path.join(os.path.realpath(PINS), "part.yaml"),
            "output_frame": "base_link",
            "region_of_interest": dict(cls.region, frame="camera_optical"),
        }
        cell = cls.replay.write_yaml("cell.yaml", cell)
        cls.replay.launch("replay.launch", "bag:=" + bag, "cell:=" + cell, "rate:=2")
        cls.replay.wait_ready()
        ended = re.compile(r"\[player-\d+\] process has finished cleanly")
        wait_until(lambda: ended.search(cls.replay.output()), "the bag ends")
        cls.answer = call(include_mismatching=True)

    @classmethod
    def tearDownClass(cls):
        cls.replay.stop()

    def detected(self):
        """What detect_poses finds on the same scan."""
        tool = roslib.packages.find_node("ppf_bin_picking", "detect_poses")[0]
        roi = self.replay.write_yaml("roi.yaml", self.region)
        result = os.path.join(self.replay.folder, "result.json")
        command = [tool, "--part", os.path.join(PINS, "part.yaml"), "--config", SETTINGS]
        command += ["--depth", os.path.join(PINS, "depth.png"), "--roi", roi, "--output", result]
        subprocess.check_call(command + ["--camera", os.path.join(PINS, "camera.yaml")])
        with open(result) as text:
            return json.load(text)

    def test_poses_are_those_of_the_command_line(self):
        self.assertEqual(self.answer.status, Response.OK, self.answer.message)
        self.assertEqual(self.answer.header.frame_id, "base_link")
        result = self.detected()
        reliable = [pose for pose in result["poses"] if pose["reliable"]]
        self.assertEqual(len(self.answer.poses), len(reliable))
        for pose, expected in zip(self.answer.poses, reliable):
            expected_base = BASE_FROM_CAMERA @ np.reshape(expected["pose"], (4, 4))
            np.testing.assert_allclose(matrix(pose.pose.pose), expected_base, atol=1e-6)
            self.assertAlmostEqual(pose.score, expected["score"], places=6)
            self.assertTrue(pose.id.startswith("pins/"))
        self.assertEqual(self.answer.roi_points, result["roi_points"])
        self.assertEqual(len(self.answer.mismatching_regions), len(result["regions"]))

    def test_service_goes_on_after_the_end_of_the_bag(self):
        again = call(include_mismatching=True)
        self.assertEqual(again.status, Response.OK, again.message)
        self.assertEqual(again.poses, self.answer.poses)
        self.assertEqual(again.mismatching_regions, self.answer.mismatching_regions)
        self.assertEqual(again.header, self.answer.header)
        waited = call(acquisition=Request.NEXT, timeout=0.3)
        self.assertEqual(waited.status, Response.NO_CLOUD, waited.message)
        self.assertEqual(call().status, Response.OK)

    def test_markers_are_drawn_as_promised(self):
        call()
        received = []
        subscriber = rospy.Subscriber("/pose_detector/markers", MarkerArray, received.append)
        wait_until(lambda: received and len(received[-1].markers) > 1, "markers")
        subscriber.unregister()
        markers = received[-1].markers
        self.assertEqual(markers[0].action, Marker.DELETEALL)
        by_name = {}
        for marker in markers[1:]:
            self.assertEqual(marker.header.frame_id, "base_link")
            by_name.setdefault(marker.ns, []).append(marker)
        self.assertEqual(len(by_name["roi"]), 1)
        self.assertEqual(len(by_name["pickable"]), len(self.answer.poses))
        for marker, pose in zip(by_name["pickable"], self.answer.poses):
            self.assertEqual(marker.type, Marker.TRIANGLE_LIST)
            self.assertEqual(marker.pose, pose.pose.pose)
            self.assertGreater(marker.color.g, marker.color.r + marker.color.b)
        regions = self.answer.mismatching_regions
        self.assertGreater(len(regions), 0)
        for name in ("mismatching_regions", "mismatching_poses"):
            self.assertEqual(len(by_name.get(name, [])), len(regions))
            for marker in by_name.get(name, []):
                self.assertGreater(marker.color.r, 2 * (marker.color.g + marker.color.b))
        self.assertIn("clusters", by_name)


if __name__ == "__main__":
    rospy.init_node("replay_test")
    rostest.rosrun("ppf_bin_picking", "replay", ReplayTest, sys.argv)
