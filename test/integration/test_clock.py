#!/usr/bin/python3
"""A ROS clock that stands still or jumps back, as bags make it."""
import sys
import time
import unittest

import rospy
import rostest
from ppf_bin_picking.srv import GetPickablePosesRequest as Request
from ppf_bin_picking.srv import GetPickablePosesResponse as Response
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

import box_scenes
from running_detector import CloudSource, RunningDetector, call, to_message, transform, wait_until

STEPS = box_scenes.lying(-0.03, 0.03, 0.6)


class ClockTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = rospy.Publisher("/clock", Clock, queue_size=10, latch=True)
        cls.tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
        cls.source = CloudSource()
        cls.scan = box_scenes.scan([("steps", STEPS)])

    def setUp(self):
        self.detector = RunningDetector(parts=["steps"]).start()
        self.set_time(1000.0)
        self.detector.wait_ready()
        wait_until(lambda: self.clock.get_num_connections() > 1, "the detector hears the clock")

    def tearDown(self):
        self.detector.stop()

    def set_time(self, seconds):
        self.clock.publish(Clock(rospy.Time.from_sec(seconds)))

    def send_scan(self, stamp_s):
        self.source.send(to_message(self.scan, stamp=rospy.Time.from_sec(stamp_s)))

    def wait_for_answer(self, stamp_s, **request):
        stamp = rospy.Time.from_sec(stamp_s)
        return wait_until(
            lambda: next((a for a in [call(**request)] if a.header.stamp == stamp), None),
            "an answer on the cloud",
        )

    def test_clock_at_rest_does_not_stretch_the_wait_for_a_cloud(self):
        start = time.monotonic()
        answer = call(acquisition=Request.NEXT, timeout=0.5)
        self.assertEqual(answer.status, Response.NO_CLOUD, answer.message)
        self.assertGreater(time.monotonic() - start, 0.45)

    def test_clock_at_rest_does_not_stretch_the_wait_for_a_transform(self):
        self.send_scan(1000.0)
        answer = self.wait_for_answer(1000.0, target_frame="nowhere")
        self.assertEqual(answer.status, Response.TF_FAILED, answer.message)

    def test_clock_at_rest_does_not_age_the_cloud(self):
        self.send_scan(999.0)
        answer = self.wait_for_answer(999.0)
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual(answer.cloud_age, rospy.Duration(1))
        self.assertEqual(call(max_age=1.5).status, Response.OK)
        self.assertEqual(call(max_age=0.5).status, Response.CLOUD_TOO_OLD)

    def test_jump_back_drops_the_cloud(self):
        self.send_scan(1000.0)
        self.wait_for_answer(1000.0)
        self.set_time(10.0)
        gone = wait_until(
            lambda: next((a for a in [call()] if a.status == Response.NO_CLOUD), None),
            "the cloud is dropped",
        )
        self.assertEqual(gone.poses, [])
        self.send_scan(10.0)
        answer = self.wait_for_answer(10.0)
        self.assertEqual(answer.status, Response.OK, answer.message)

    def test_jump_back_drops_the_transforms(self):
        self.send_scan(1000.0)
        for stamp_s in (999.0, 1001.0):
            stamp = rospy.Time.from_sec(stamp_s)
            self.tf.publish([transform("robot", "base_link", (0, 0, 1), (0, 0, 0, 1), stamp)])
        wait_until(
            lambda: call(target_frame="robot").status == Response.OK, "the transform is there"
        )
        self.set_time(10.0)
        wait_until(lambda: call().status == Response.NO_CLOUD, "the jump is noticed")
        self.send_scan(1000.0)  # which the old transforms would cover
        answer = self.wait_for_answer(1000.0, target_frame="robot")
        self.assertEqual(answer.status, Response.TF_FAILED, answer.message)
        # What is static stays.
        answer = self.wait_for_answer(1000.0, target_frame="base_link")
        self.assertEqual(answer.status, Response.OK, answer.message)


if __name__ == "__main__":
    rospy.init_node("clock_test")
    rostest.rosrun("ppf_bin_picking", "clock", ClockTest, sys.argv)
