#!/usr/bin/python3
"""Provokes the statuses of the service; test_limits.py those that need another start."""
import sys
import threading
import unittest

import numpy as np
import rospy
import rostest
from ppf_bin_picking.srv import GetPickablePosesRequest as Request
from ppf_bin_picking.srv import GetPickablePosesResponse as Response
from sensor_msgs.msg import PointField

import box_scenes
from running_detector import CloudSource, RunningDetector, call, matrix, to_message, wait_until

STEPS = box_scenes.lying(-0.03, 0.03, 0.6)
TOWER = box_scenes.lying(0.04, -0.04, -1.1)


class StatusesTest(unittest.TestCase):
    """One detector, a nodelet in a manager, for all tests: none of them may end it."""

    @classmethod
    def setUpClass(cls):
        cls.detector = RunningDetector(
            cell={"region_of_interest": cls.region_in_bin()}, launch_args=["standalone:=false"]
        ).start()
        cls.detector.wait_ready()
        cls.first_answer = call()
        cls.first_wait = call(acquisition=Request.NEXT, timeout=0.05)
        cls.source = CloudSource()
        cls.good = to_message(box_scenes.scan([("steps", STEPS), ("tower", TOWER)]))

    @classmethod
    def tearDownClass(cls):
        cls.detector.stop()

    @staticmethod
    def region_in_bin():
        """The region in frame bin, which lies on the floor, its axes those of the camera."""
        low, high = box_scenes.REGION["min"], box_scenes.REGION["max"]
        shift = [0, 0, -box_scenes.FLOOR_M]
        return {
            "frame": "bin",
            "min": [float(a + b) for a, b in zip(low, shift)],
            "max": [float(a + b) for a, b in zip(high, shift)],
        }

    def answer(self, message, **fields):
        """The answer to a request on this cloud."""
        message.header.stamp = rospy.Time.now()
        stamp = self.source.send(message)
        request = dict(model_id="steps", **fields) if "model_id" not in fields else fields
        return wait_until(lambda: self.answer_on(stamp, request), "an answer on the cloud")

    @staticmethod
    def answer_on(stamp, request):
        """An answer, unless it is on another cloud."""
        answer = call(**request)
        return answer if answer.header.stamp == stamp else None

    def expect(self, answer, status, *words):
        self.assertEqual(answer.status, status, answer.message)
        for word in words:
            self.assertIn(word, answer.message)
        if status < 0 or status == Response.NO_PICKABLE_POSE:
            self.assertEqual(answer.poses, [])

    def expect_pose(self, pose, expected):
        """Within 3 mm, and 0.06 in each entry of the rotation."""
        np.testing.assert_allclose(matrix(pose)[:3, 3], expected[:3, 3], atol=0.003)
        np.testing.assert_allclose(matrix(pose)[:3, :3], expected[:3, :3], atol=0.06)

    def expect_good(self):
        self.expect(self.answer(self.good), Response.OK)

    def test_ok_gives_the_pose_in_the_clouds_frame(self):
        answer = self.answer(self.good)
        self.expect(answer, Response.OK)
        self.assertEqual(answer.header.frame_id, "camera")
        self.assertEqual(answer.header.stamp, self.good.header.stamp)
        self.assertEqual([pose.id for pose in answer.poses], ["steps/1"])
        self.expect_pose(answer.poses[0].pose.pose, STEPS)
        self.assertGreater(answer.poses[0].pose.covariance[0], 0)
        self.assertGreater(answer.poses[0].score, 0.6)
        self.assertGreater(answer.roi_points, 1000)
        self.assertGreater(answer.processing_time.to_sec(), 0)
        self.assertGreaterEqual(answer.cloud_age.to_sec(), answer.processing_time.to_sec())

    def test_ok_gives_the_pose_in_the_frame_asked_for(self):
        answer = self.answer(self.good, target_frame="base_link")
        self.expect(answer, Response.OK)
        self.assertEqual(answer.header.frame_id, "base_link")
        base_from_camera = np.diag([1.0, -1, -1, 1])
        base_from_camera[:3, 3] = [0.1, 0.2, 0.7]
        self.expect_pose(answer.poses[0].pose.pose, base_from_camera @ STEPS)

    def test_ok_finds_two_parts_at_once(self):
        answer = self.answer(self.good, model_id="")
        self.expect(answer, Response.OK)
        found = {pose.model_id: pose.pose.pose for pose in answer.poses}
        self.assertEqual(set(found), {"steps", "tower"})
        self.assertEqual(len(answer.poses), 2)
        self.expect_pose(found["steps"], STEPS)
        self.expect_pose(found["tower"], TOWER)

    def test_ok_gives_no_more_poses_than_asked_for(self):
        answer = self.answer(self.good, model_id="", max_poses=1)
        self.expect(answer, Response.OK)
        self.assertEqual(answer.message, "2 reliable poses (max_poses: only the first 1 returned)")
        self.assertEqual(len(answer.poses), 1)

    def test_ok_on_a_large_cloud(self):
        points = box_scenes.scan([("steps", STEPS)], width=2400, height=2000)
        self.expect(self.answer(to_message(points)), Response.OK)

    def test_no_pickable_pose_on_a_crumb(self):
        points = box_scenes.scan([("crumb", STEPS)])
        answer = self.answer(to_message(points))
        self.expect(answer, Response.NO_PICKABLE_POSE, "nothing like the part was found")
        self.assertGreater(answer.roi_points, 0)

    def test_roi_empty_on_an_empty_floor(self):
        answer = self.answer(to_message(box_scenes.scan([])))
        self.expect(answer, Response.ROI_EMPTY, "region of interest")
        self.assertEqual(answer.roi_points, 0)

    def test_no_cloud_before_the_first(self):
        self.expect(self.first_answer, Response.NO_CLOUD, "/camera/depth/points", "check")
        self.expect(self.first_wait, Response.NO_CLOUD, "/camera/depth/points", "check")

    def test_no_cloud_where_only_older_ones_come(self):
        answers = []
        waiting = threading.Thread(
            target=lambda: answers.append(call(acquisition=Request.NEXT, timeout=1.0))
        )
        waiting.start()
        while waiting.is_alive():
            self.source.send(to_message(np.ones((2, 2, 3), "<f4"), stamp=rospy.Time(5)))
            waiting.join(0.1)
        self.expect(answers[0], Response.NO_CLOUD, "older stamp", "clock")

    def test_cloud_too_old(self):
        self.expect_good()
        answer = call(max_age=0.000001)
        self.expect(answer, Response.CLOUD_TOO_OLD, "max_age", "NEXT")

    def test_cloud_too_old_where_the_cameras_clock_is_ahead(self):
        ahead = rospy.Duration(5)
        self.good.header.stamp = rospy.Time.now() + ahead
        self.source.send(self.good)
        wait_until(lambda: "in the future" in call(max_age=1).message, "the cloud is there")
        answer = call(max_age=1)
        self.expect(answer, Response.CLOUD_TOO_OLD, "in the future", "clock")
        answers = []
        waiting = threading.Thread(
            target=lambda: answers.append(call(acquisition=Request.NEXT, timeout=100))
        )
        waiting.start()
        while waiting.is_alive():
            self.good.header.stamp = rospy.Time.now() + ahead
            self.source.send(self.good)
            waiting.join(0.1)
        self.expect(answers[0], Response.CLOUD_TOO_OLD, "in the future", "clock")
        self.expect_good()

    def test_tf_failed_for_an_unknown_target_frame(self):
        answer = self.answer(self.good, target_frame="nowhere")
        self.expect(answer, Response.TF_FAILED, "'nowhere'", "'camera'", "check the frame names")

    def test_tf_failed_for_a_cloud_in_an_unknown_frame(self):
        message = to_message(box_scenes.scan([("steps", STEPS)]), frame="other_camera")
        answer = self.answer(message, target_frame="base_link")
        self.expect(answer, Response.TF_FAILED, "'other_camera'")
        answer = self.answer(message)  # no target, but the region has a frame
        self.expect(answer, Response.TF_FAILED, "'other_camera'", "'bin'")

    def test_unknown_model(self):
        self.expect(call(model_id="stps"), Response.UNKNOWN_MODEL, "'stps'", "nearest", "'steps'")

    def test_bad_request(self):
        self.expect(call(acquisition=7), Response.BAD_REQUEST, "acquisition", "LATEST")
        self.expect(call(timeout=-1), Response.BAD_REQUEST, "timeout")
        self.expect(call(max_age=-1), Response.BAD_REQUEST, "max_age")

    def test_busy_while_another_request_waits(self):
        self.expect_good()
        answers = []

        def wait_for_cloud():
            """Calls until it is not told to come back: the calls below may come first."""
            while not answers or answers[-1].status == Response.BUSY:
                answers.append(call(model_id="steps", acquisition=Request.NEXT, timeout=100))

        waiting = threading.Thread(target=wait_for_cloud)
        waiting.start()
        busy = wait_until(
            lambda: next((a for a in [call(model_id="stps")] if a.status == Response.BUSY), None),
            "the first request waits",
        )
        self.expect(busy, Response.BUSY, "Another", "again")
        self.good.header.stamp = rospy.Time.now()
        self.source.send(self.good)
        waiting.join()
        self.expect(answers[-1], Response.OK)
        self.assertEqual(answers[-1].header.stamp, self.good.header.stamp)

    def test_bad_cloud(self):
        for name, spoil, words in BAD_CLOUDS:
            with self.subTest(name):
                message = to_message(box_scenes.scan([("steps", STEPS)]))
                spoil(message)
                self.expect(self.answer(message), Response.BAD_CLOUD, *words)
        self.expect_good()


def set_nothing_measured(message):
    message.data = np.full(len(message.data) // 4, np.nan, "<f4").tobytes()


def set_all_zero(message):
    message.data = bytes(len(message.data))


def set_behind_the_camera(message):
    message.data = (-np.frombuffer(message.data, "<f4")).tobytes()


def set_empty(message):
    message.width, message.height, message.row_step, message.data = 0, 0, 0, b""


def set_too_large(message):
    message.width, message.height, message.row_step = 5000001, 1, 12 * 5000001
    message.data = bytes(message.row_step)


BAD_CLOUDS = [
    ("empty", set_empty, ["no points", "check that the camera"]),
    ("nothing measured", set_nothing_measured, ["NaN", "check the camera"]),
    ("all zero", set_all_zero, ["zero", "check the camera"]),
    ("behind the camera", set_behind_the_camera, ["not before the camera", "z points forward"]),
    ("no x", lambda m: m.fields.pop(0), ["field x is missing"]),
    ("no fields", lambda m: m.fields.clear(), ["field x is missing"]),
    ("doubles", lambda m: setattr(m.fields[2], "datatype", PointField.FLOAT64), ["z", "FLOAT32"]),
    ("big-endian", lambda m: setattr(m, "is_bigendian", True), ["big-endian", "little-endian"]),
    ("row_step too small", lambda m: setattr(m, "row_step", 12), ["row_step"]),
    ("row_step too large", lambda m: setattr(m, "row_step", 2**32 - 1), ["row_step", "bytes"]),
    ("data too short", lambda m: setattr(m, "data", m.data[:-1]), ["bytes", "row_step"]),
    ("no frame", lambda m: setattr(m.header, "frame_id", ""), ["frame_id"]),
    ("too large", set_too_large, ["5000001", "max_points", "raise"]),
]


if __name__ == "__main__":
    rospy.init_node("statuses_test")
    rostest.rosrun("ppf_bin_picking", "statuses", StatusesTest, sys.argv)
