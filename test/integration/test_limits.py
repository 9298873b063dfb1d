#!/usr/bin/python3
"""Statuses that need a start of their own, and how the detector ends while it works."""
import os
import resource
import sys
import threading
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from ppf_bin_picking.msg import MismatchRegion
from ppf_bin_picking.srv import GetPickablePosesRequest as Request
from ppf_bin_picking.srv import GetPickablePosesResponse as Response

import box_scenes
from running_detector import SERVICE, CloudSource, RunningDetector, call, to_message, wait_until

STEPS = box_scenes.lying(-0.03, 0.03, 0.6)
QUICK_S = 15.0  # roslaunch itself takes a second, and kills after this time


class LimitsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = CloudSource()

    def setUp(self):
        self.detector = None

    def tearDown(self):
        if self.detector:
            self.detector.stop()

    def start(self, **arguments):
        self.detector = RunningDetector(parts=["steps"], **arguments).start()
        return self.detector.wait_ready()

    def send_scan(self, **size):
        """Sends a cloud and waits until the detector holds it; its stamp is zero."""
        points = box_scenes.scan([("steps", STEPS)], **size)
        self.source.send(to_message(points, stamp=rospy.Time(0)))
        wait_until(lambda: "no stamp" in call(max_age=1).message, "the cloud is there")

    def test_time_limit_gives_what_was_found_until_then(self):
        self.start(settings={"time_limit_s": 0.001, "threads": 1})
        self.send_scan()
        answer = call()
        self.assertEqual(answer.status, Response.TIME_LIMIT, answer.message)
        self.assertIn("time_limit_s", answer.message)

    def test_parts_of_different_settings_do_not_share_a_place(self):
        self.detector = RunningDetector(parts=["steps"])
        for number in (0, 1):
            folder = os.path.join(self.detector.folder, str(number))
            text = "unit: mm\nmodel_id: other_%d\ndetector: {min_score: 0.%d}\n" % (
                number,
                48 + number,
            )
            self.detector.cell["parts"].append(box_scenes.write_part(folder, "steps", text))
        self.detector.start().wait_ready()
        self.send_scan()
        answer = call(include_mismatching=True)
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual(answer.message, "1 reliable pose")
        self.assertEqual(len(answer.poses), 1)
        reasons = [region.reason for region in answer.mismatching_regions]
        self.assertEqual(reasons.count(MismatchRegion.OVERLAP), 2)

    def test_not_ready_while_parts_are_loaded(self):
        self.detector = RunningDetector(parts=["steps"])
        for number in range(25):
            folder = os.path.join(self.detector.folder, str(number))
            text = "unit: mm\nmodel_id: part_%d\n" % number
            self.detector.cell["parts"].append(box_scenes.write_part(folder, "steps", text))
        self.detector.start()
        rospy.wait_for_service(SERVICE, 60)
        last = call(model_id="part_24")
        self.assertEqual(last.status, Response.NOT_READY, last.message)
        self.assertIn("'part_24'", last.message)
        self.assertIn("again", last.message)
        everything = call()
        self.assertEqual(everything.status, Response.NOT_READY, everything.message)
        # The first part can be used while others are loaded.
        first = wait_until(
            lambda: next(
                (a for a in [call(model_id="steps")] if a.status != Response.NOT_READY), 0
            ),
            "the first part is loaded",
        )
        self.assertEqual(first.status, Response.NO_CLOUD, first.message)
        self.assertEqual(call(model_id="part_24").status, Response.NOT_READY)

    def test_internal_error_where_memory_runs_out(self):
        self.start()
        self.send_scan(width=2400, height=2000)
        pid = process_id("/pose_detector")
        before = resource.prlimit(pid, resource.RLIMIT_AS)
        resource.prlimit(pid, resource.RLIMIT_AS, (virtual_bytes(pid), before[1]))
        try:
            answer = call()
        finally:
            resource.prlimit(pid, resource.RLIMIT_AS, before)
        self.assertEqual(answer.status, Response.INTERNAL_ERROR, answer.message)
        self.assertIn("defect", answer.message)
        self.assertEqual(answer.poses, [])
        answer = call()  # it goes on
        self.assertEqual(answer.status, Response.OK, answer.message)

    def test_ends_at_once_while_a_request_waits(self):
        for launch_args in ([], ["standalone:=false"]):
            with self.subTest(launch_args):
                self.start(launch_args=launch_args)
                waiting = threading.Thread(target=self.call_until_the_end)
                waiting.start()
                wait_until(lambda: call().status == Response.BUSY, "the request waits")
                self.assertLess(self.detector.stop(), QUICK_S)
                self.assertNotIn("escalating", self.detector.last_output)
                waiting.join()
                self.detector = None

    def test_ends_soon_while_it_detects(self):
        self.start()
        self.send_scan(width=2400, height=2000)
        working = threading.Thread(target=self.call_until_the_end, kwargs={"latest": True})
        working.start()
        wait_until(
            lambda: call(model_id="none").status == Response.BUSY, "the request is worked on"
        )
        self.assertLess(self.detector.stop(), QUICK_S)
        self.assertNotIn("escalating", self.detector.last_output)
        working.join()
        self.detector = None

    @staticmethod
    def call_until_the_end(latest=False):
        """Calls until there is nobody to answer."""
        try:
            while True:
                call(acquisition=Request.LATEST if latest else Request.NEXT, timeout=1000)
        except rospy.ServiceException:
            pass


def process_id(node):
    """The process that a node of this machine runs in."""
    uri = rosgraph.Master("/test").lookupNode(node)
    return xmlrpc.client.ServerProxy(uri).getPid("/test")[2]


def virtual_bytes(pid):
    with open("/proc/%d/statm" % pid) as statm:
        return int(statm.read().split()[0]) * resource.getpagesize()


if __name__ == "__main__":
    rospy.init_node("limits_test")
    rostest.rosrun("ppf_bin_picking", "limits", LimitsTest, sys.argv)
