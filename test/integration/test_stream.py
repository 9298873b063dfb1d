#!/usr/bin/python3
"""Requests while clouds arrive ten times a second, and what is published meanwhile."""
import sys
import threading
import unittest

import numpy as np
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseArray
from ppf_bin_picking.msg import Detection
from ppf_bin_picking.srv import GetPickablePosesRequest as Request
from ppf_bin_picking.srv import GetPickablePosesResponse as Response
from sensor_msgs.msg import PointCloud2
from visualization_msgs.msg import Marker, MarkerArray

import box_scenes
from running_detector import CloudSource, RunningDetector, call, matrix, to_message, wait_until

STEPS = box_scenes.lying(-0.03, 0.03, 0.6)


class Listener:
    """The last message of a topic."""

    def __init__(self, topic, kind):
        self.message = None
        self.subscriber = rospy.Subscriber(topic, kind, self.keep)

    def keep(self, message):
        self.message = message

    def wait_for(self, stamp):
        """The message on the cloud with this stamp."""
        is_it = lambda m: m and header_of(m).stamp == stamp and m
        return wait_until(lambda: is_it(self.message), self.subscriber.name)


def header_of(message):
    return message.markers[0].header if hasattr(message, "markers") else message.header


class StreamTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = CloudSource()
        cls.scan = box_scenes.scan([("steps", STEPS)])
        cls.detector = RunningDetector(parts=["steps"], cell={"output_frame": "base_link"})
        cls.detector.start().wait_ready()
        cls.source.send(to_message(cls.scan))
        cls.streaming = rospy.Timer(
            rospy.Duration(0.1), lambda _: cls.source.clouds.publish(to_message(cls.scan))
        )
        wait_until(lambda: call().status != Response.NO_CLOUD, "clouds arrive")

    @classmethod
    def tearDownClass(cls):
        cls.streaming.shutdown()
        cls.detector.stop()

    def expect_pose(self, answer):
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual(len(answer.poses), 1)
        base_from_camera = np.diag([1.0, -1, -1, 1])
        base_from_camera[:3, 3] = [0.1, 0.2, 0.7]
        expected = (base_from_camera @ STEPS)[:3, 3]
        np.testing.assert_allclose(matrix(answer.poses[0].pose.pose)[:3, 3], expected, atol=0.003)

    def test_each_request_is_answered_on_a_fresh_cloud(self):
        last = rospy.Time(0)
        for number in range(12):
            acquisition = Request.NEXT if number % 2 else Request.LATEST
            before = rospy.Time.now()
            answer = call(acquisition=acquisition, timeout=60)
            self.expect_pose(answer)
            self.assertGreaterEqual(answer.header.stamp, last)
            if acquisition == Request.NEXT:
                self.assertGreater(answer.header.stamp, before)
            last = answer.header.stamp

    def test_requests_at_once_are_answered_or_told_to_wait(self):
        answers = []
        callers = [threading.Thread(target=lambda: answers.append(call())) for _ in range(6)]
        for caller in callers:
            caller.start()
        for caller in callers:
            caller.join()
        self.assertEqual(len(answers), 6)
        for answer in answers:
            self.assertIn(answer.status, (Response.OK, Response.BUSY), answer.message)
        self.assertTrue(any(answer.status == Response.OK for answer in answers))

    def test_same_cloud_gives_the_same_answer(self):
        first, second = call(), call()
        self.assertEqual(first.poses, second.poses)

    def test_everything_is_published_in_the_target_frame(self):
        clouds = ["pose_distribution", "pose_distribution_orientation", "scene"]
        kinds = {"detection": Detection, "markers": MarkerArray, "poses": PoseArray}
        kinds.update({name: PointCloud2 for name in clouds})
        listeners = {n: Listener("/pose_detector/" + n, kind) for n, kind in kinds.items()}
        wait_until(
            lambda: all(l.subscriber.get_num_connections() for l in listeners.values()), "topics"
        )
        answer = call()
        for name, listener in listeners.items():
            with self.subTest(name):
                header = header_of(listener.wait_for(answer.header.stamp))
                self.assertEqual(header.frame_id, "base_link")
        detection = listeners["detection"].message
        self.assertEqual(detection.status, answer.status)
        self.assertEqual(detection.message, answer.message)
        self.assertEqual(detection.poses, answer.poses)
        self.assertGreater(len(detection.stage_names), 3)
        self.assertEqual(len(detection.stage_names), len(detection.stage_seconds))
        self.assertEqual(listeners["poses"].message.poses, [answer.poses[0].pose.pose])
        self.assertGreater(listeners["pose_distribution"].message.width, 0)
        self.assertEqual(
            listeners["pose_distribution"].message.width,
            listeners["pose_distribution_orientation"].message.width,
        )
        self.assertGreater(listeners["scene"].message.width, 100)

    def test_markers_reach_one_who_comes_late(self):
        answer = call()
        markers = Listener("/pose_detector/markers", MarkerArray).wait_for(answer.header.stamp)
        self.assertEqual(markers.markers[0].action, Marker.DELETEALL)
        mesh = [m for m in markers.markers if m.ns == "pickable"]
        self.assertEqual(len(mesh), 1)
        self.assertEqual(mesh[0].type, Marker.TRIANGLE_LIST)
        self.assertEqual(mesh[0].pose, answer.poses[0].pose.pose)
        self.assertGreater(mesh[0].color.g, mesh[0].color.r + mesh[0].color.b)

    def test_failure_wipes_out_what_was_drawn(self):
        call()
        markers = Listener("/pose_detector/markers", MarkerArray)
        poses = Listener("/pose_detector/poses", PoseArray)
        wait_until(lambda: poses.subscriber.get_num_connections() and markers.message, "topics")
        self.assertEqual(call(target_frame="nowhere").status, Response.TF_FAILED)
        wait_until(lambda: len(markers.message.markers) == 1, "markers of the failure")
        self.assertEqual(markers.message.markers[0].action, Marker.DELETEALL)
        self.assertEqual(markers.message.markers[0].header.frame_id, "base_link")
        wait_until(lambda: poses.message and not poses.message.poses, "an empty list of poses")

    def test_diagnostics_tell_of_input_parts_and_last_request(self):
        listener = Listener("/diagnostics", DiagnosticArray)

        def find(name, words):
            statuses = listener.message.status if listener.message else []
            return next((s for s in statuses if s.name == name and words in s.message), None)

        call()
        for name, words in [
            ("pose_detector: input", "The last cloud came "),
            ("pose_detector: parts", "All parts are loaded"),
            ("pose_detector: last request", "reliable"),
        ]:
            status = wait_until(lambda: find(name, words), name)
            self.assertEqual(status.level, DiagnosticStatus.OK)
        call(target_frame="nowhere")
        status = wait_until(lambda: find("pose_detector: last request", "'nowhere'"), "a warning")
        self.assertEqual(status.level, DiagnosticStatus.WARN)


if __name__ == "__main__":
    rospy.init_node("stream_test")
    rostest.rosrun("ppf_bin_picking", "stream", StreamTest, sys.argv)
