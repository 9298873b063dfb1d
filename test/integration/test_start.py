#!/usr/bin/python3
"""How the detector starts: with right and wrong parameters, with parts that can and cannot be loaded."""
import os
import subprocess
import sys
import unittest

import rosgraph
import roslib.packages
import rospy
import rostest
from ppf_bin_picking.srv import GetPickablePosesResponse as Response

import box_scenes
from running_detector import LONG_S, CloudSource, RunningDetector, call, to_message, wait_until

STEPS = box_scenes.lying(-0.03, 0.03, 0.6)
WRONG = {
    "parts": ["pin.yaml"],
    "outputframe": "base_link",
    "tf_timeout_s": "0.5",
    "detector": {"lamda": 0.5, "min_score": "1e-2"},
}
# What is said about each of these.
COMPLAINTS = [
    "parts[0] is 'pin.yaml'",
    "unknown key 'outputframe': the nearest known name is 'output_frame'",
    "tf_timeout_s is '0.5'",
    "unknown key 'lamda': the nearest known name is 'lambda'",
    "min_score is '1e-2'",
]


class StartTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = CloudSource()

    def setUp(self):
        self.detector = None

    def tearDown(self):
        if self.detector:
            self.detector.stop()

    def run_to_the_end(self, *command):
        """Exit status and output of a program that ends by itself."""
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONG_S
        )
        return done.returncode, done.stdout.decode()

    def send_scan(self):
        points = box_scenes.scan([("steps", STEPS)])
        self.source.send(to_message(points, stamp=rospy.Time(0)))
        wait_until(lambda: "no stamp" in call(max_age=1).message, "the cloud is there")

    def test_node_with_wrong_parameters_says_all_and_fails(self):
        rospy.set_param("/pose_detector", WRONG)
        node = roslib.packages.find_node("ppf_bin_picking", "pose_detector_node")[0]
        status, output = self.run_to_the_end(node, "__name:=pose_detector")
        rospy.delete_param("/pose_detector")
        self.assertEqual(status, 1)
        for complaint in COMPLAINTS:
            self.assertEqual(output.count(complaint), 1, output)

    def test_nodelet_with_wrong_parameters_leaves_its_manager_alive(self):
        self.detector = RunningDetector(cell=WRONG, launch_args=["standalone:=false"]).start()
        wait_until(
            lambda: all(complaint in self.detector.output() for complaint in COMPLAINTS),
            "the complaints",
        )
        wait_until(lambda: "process has died" in self.detector.output(), "the loader fails")
        self.assertTrue(rosgraph.Master("/test").lookupNode("/pose_detector_manager"))
        self.assertIsNone(self.detector.process.poll())

    def test_node_without_parameters_asks_for_parts(self):
        node = roslib.packages.find_node("ppf_bin_picking", "pose_detector_node")[0]
        status, output = self.run_to_the_end(node, "__name:=lonely")
        self.assertEqual(status, 1)
        self.assertIn("/lonely: parts is missing: give a part file, or a list of them", output)

    def test_stand_alone_node_answers(self):
        self.detector = RunningDetector(parts=["steps"]).start().wait_ready()
        self.send_scan()
        answer = call()
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual([pose.id for pose in answer.poses], ["steps/1"])

    def test_part_that_cannot_be_loaded_leaves_the_others(self):
        self.detector = RunningDetector(parts=["steps"])
        folder = self.detector.folder
        no_unit = box_scenes.write_part(os.path.join(folder, "no_unit"), "tower", "")
        in_metres = os.path.join(folder, "in_metres")
        too_large = box_scenes.write_part(in_metres, "tower", "unit: m\nmodel_id: giant\n")
        twice = box_scenes.write_part(os.path.join(folder, "twice"), "steps")
        self.detector.cell["parts"] += [no_unit, too_large, twice, "/no/such/part.yaml"]
        self.detector.start().wait_ready()
        self.send_scan()
        answer = call()
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual([pose.model_id for pose in answer.poses], ["steps"])
        reasons = [
            "unit is missing",
            "the mesh's unit is probably wrong",
            "model_id 'steps' is that of another part",
            "/no/such/part.yaml does not exist",
        ]
        for reason in reasons:
            self.assertIn(reason, answer.message)
            self.assertIn(reason, self.detector.output())
        answer = call(model_id="giant")
        self.assertEqual(answer.status, Response.UNKNOWN_MODEL)
        self.assertIn("'giant' could not be loaded", answer.message)

    def test_no_part_at_all(self):
        self.detector = RunningDetector(cell={"parts": "/no/such/part.yaml"}).start().wait_ready()
        answer = call()
        self.assertEqual(answer.status, Response.UNKNOWN_MODEL, answer.message)
        self.assertIn("No part is loaded", answer.message)

    def test_trained_model_is_taken_from_its_file_and_checked(self):
        self.detector = RunningDetector(parts=["steps"])
        folder, part = self.detector.folder, self.detector.parts[0]
        train = roslib.packages.find_node("ppf_bin_picking", "train_model")[0]
        model = os.path.join(folder, "steps.ppf")
        status, output = self.run_to_the_end(train, "--part", part, "--output", model)
        self.assertEqual(status, 0, output)
        text = "unit: mm\nmodel: %s\nmodel_id: %s\n"
        with open(model, "rb") as whole, open(os.path.join(folder, "cut.ppf"), "wb") as cut:
            cut.write(whole.read()[:-100])
        write = box_scenes.write_part
        self.detector.cell["parts"] = [
            write(folder + "/whole", "steps", text % (model, "whole")),
            write(folder + "/cut", "steps", text % (os.path.join(folder, "cut.ppf"), "cut")),
            write(folder + "/other", "tower", text % (model, "other")),
        ]
        self.detector.start().wait_ready()
        self.send_scan()
        answer = call()
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual([pose.model_id for pose in answer.poses], ["whole"])
        self.assertEqual(answer.message.count("(not loaded: "), 2, answer.message)

    def test_parts_with_settings_of_their_own_are_found_in_one_request(self):
        self.detector = RunningDetector(parts=["steps", "tower"])
        text = "unit: mm\ndetector: {step_rel: 0.06}\n"
        self.detector.parts[1] = box_scenes.write_part(self.detector.folder, "tower", text)
        self.detector.start().wait_ready()
        points = box_scenes.scan([("steps", STEPS), ("tower", box_scenes.lying(0.04, -0.04, 2))])
        self.source.send(to_message(points, stamp=rospy.Time(0)))
        wait_until(lambda: "no stamp" in call(max_age=1).message, "the cloud is there")
        answer = call()
        self.assertEqual(answer.status, Response.OK, answer.message)
        self.assertEqual({pose.model_id for pose in answer.poses}, {"steps", "tower"})


if __name__ == "__main__":
    rospy.init_node("start_test")
    rostest.rosrun("ppf_bin_picking", "start", StartTest, sys.argv)
