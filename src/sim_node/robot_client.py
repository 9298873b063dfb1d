#!/usr/bin/python3
"""Plays the robot of the simulated cell: asks for pickable poses and picks the best, until the bin is
empty or nothing can be trusted any more. Prints a line a cycle and a summary. Ends with 0 unless
something broke or a pick was wrong."""
import math
import sys
import threading
import time
from collections import Counter

import rospy
from geometry_msgs.msg import PoseStamped
from ppf_bin_picking.msg import MismatchRegion
from ppf_bin_picking.srv import (
    GetPickablePoses,
    GetPickablePosesRequest,
    GetPickablePosesResponse,
)
from ppf_bin_picking.srv import PickPart, PickPartResponse
from std_srvs.srv import Trigger

WITH_POSES = (GetPickablePosesResponse.OK, GetPickablePosesResponse.TIME_LIMIT)
NOT_YET = (GetPickablePosesResponse.NOT_READY, GetPickablePosesResponse.BUSY)
NOTHING_THERE = (
    GetPickablePosesResponse.NO_PICKABLE_POSE,
    GetPickablePosesResponse.ROI_EMPTY,
)
TRIGGER_AGAIN_S = 3.0


class Broken(Exception):
    """Something other than the poses failed; one sentence."""


def constant_name(message, value):
    """Name of the constant of a message that has the value."""
    return next(n for n in dir(message) if n.isupper() and getattr(message, n) == value)


def mean(values):
    """Their mean; nan of none."""
    return sum(values) / len(values) if values else math.nan


class Cell:
    """The services of detector and cell."""

    def __init__(self, detector, cell, deadline_s):
        self.deadline_s = deadline_s
        for name in (detector, cell + "/trigger", cell + "/pick"):
            rospy.wait_for_service(name, timeout=deadline_s)
        self._detect = rospy.ServiceProxy(detector, GetPickablePoses)
        self._trigger = rospy.ServiceProxy(cell + "/trigger", Trigger)
        self._pick = rospy.ServiceProxy(cell + "/pick", PickPart)

    def detect(self):
        """The answer about a new shot. NEXT takes only what is shot while it waits, and nobody says when it
        has begun to: so the camera is triggered during the call, again if no answer comes.
        """
        request = GetPickablePosesRequest(
            acquisition=GetPickablePosesRequest.NEXT, include_mismatching=True
        )
        answers = []
        call = threading.Thread(target=lambda: answers.append(self._detect(request)), daemon=True)
        call.start()
        end = time.monotonic() + self.deadline_s
        call.join(0.05)
        while call.is_alive() and time.monotonic() < end:
            self._trigger()
            call.join(TRIGGER_AGAIN_S)
        if not answers:
            raise Broken("the detector gave no answer")
        return answers[0]

    def wait_ready(self):
        """Waits until the detector has loaded its parts."""
        end = time.monotonic() + self.deadline_s
        while self._detect(GetPickablePosesRequest()).status in NOT_YET:
            if time.monotonic() > end:
                raise Broken("the detector did not get ready")
            time.sleep(0.2)

    def pick(self, found, header):
        """Sends the gripper to a pose of an answer."""
        pose = PoseStamped(header=header, pose=found.pose.pose)
        result = self._pick(pose=pose, model_id=found.model_id)
        if result.status < 0:
            raise Broken("the pick failed: " + result.message)
        return result


class Summary:
    """What has been counted so far."""

    def __init__(self):
        self.picked = self.wrong = self.blocked = 0
        self.cycles_s = []
        self.detections_s = []
        self.errors_m = []
        self.left = None
        self.last_answer = None

    def add(self, result):
        self.left = result.parts_left
        self.picked += result.status == PickPartResponse.OK
        self.wrong += result.status == PickPartResponse.NO_PART_THERE
        self.blocked += result.status == PickPartResponse.COVERED
        if result.status == PickPartResponse.OK:
            self.errors_m.append(result.error_m)

    def why(self):
        """Why the robot stopped."""
        answer = self.last_answer
        if self.left == 0:
            return "the bin is empty"
        if answer is None:
            return "the detector gave no answer"
        text = constant_name(GetPickablePosesResponse, answer.status)
        if answer.poses:
            text += ", but no pose could be picked"
        reasons = Counter(
            constant_name(MismatchRegion, r.reason) for r in answer.mismatching_regions
        )
        regions = ", ".join(f"{count} {reason}" for reason, count in reasons.most_common())
        return f"{text}; mismatching regions: {regions or 'none'}"

    def text(self):
        """All of it in two lines."""
        left = "?" if self.left is None else self.left
        lines = [
            f"Summary: {self.picked} picked, {self.wrong} wrong picks, {self.blocked} blocked picks, "
            f"{left} parts left ({self.why()})",
            f"Cycles: {len(self.cycles_s)} of {mean(self.cycles_s):.2f} s, the longest "
            f"{max(self.cycles_s, default=math.nan):.2f} s; detection {mean(self.detections_s):.2f} s; "
            f"the picks' largest surface error {1000 * max(self.errors_m, default=math.nan):.2f} mm, "
            f"in the mean {1000 * mean(self.errors_m):.2f} mm",
        ]
        return "\n".join(lines)


def pick_one(cell, answer, summary):
    """Tries the poses, best first, until one can be picked. Returns whether one was, and what to print."""
    notes = []
    for found in answer.poses:
        result = cell.pick(found, answer.header)
        summary.add(result)
        what = constant_name(PickPartResponse, result.status)
        notes.append(f"{found.id} score {found.score:.2f} {what}: {result.message}")
        if result.success:
            return True, "; ".join(notes)
    return False, "; ".join(notes) or answer.message


def empty_bin(cell, further_shots, summary):
    """Picks until the bin is empty, or nothing was picked on so many shots in a row after the first."""
    failed = 0
    while summary.left != 0 and failed <= further_shots and not rospy.is_shutdown():
        start = time.monotonic()
        answer = cell.detect()
        summary.last_answer = answer
        if answer.status not in WITH_POSES + NOTHING_THERE:
            raise Broken(f"the detector answers {answer.message}")
        picked, line = pick_one(cell, answer, summary)
        failed = 0 if picked else failed + 1
        summary.detections_s.append(answer.processing_time.to_sec())
        summary.cycles_s.append(time.monotonic() - start)
        status = constant_name(GetPickablePosesResponse, answer.status)
        print(
            f"{len(summary.cycles_s):3}  {summary.cycles_s[-1]:5.2f} s  {status}, {len(answer.poses)} poses, "
            f"{len(answer.mismatching_regions)} regions. {line}",
            flush=True,
        )


def main():
    rospy.init_node("robot_client")
    summary = Summary()
    status = 0
    try:
        cell = Cell(
            rospy.get_param("~detector"),
            rospy.get_param("~cell"),
            rospy.get_param("~deadline_s", 120),
        )
        cell.wait_ready()
        empty_bin(cell, rospy.get_param("~further_shots", 2), summary)
    except (Broken, rospy.ROSException, rospy.ServiceException) as error:
        print(f"Broken: {error}", flush=True)
        status = 1
    print(summary.text(), flush=True)
    end = time.monotonic() + rospy.get_param("~hold_s", 0)
    while time.monotonic() < end and not rospy.is_shutdown():
        time.sleep(0.1)
    return 1 if summary.wrong else status


if __name__ == "__main__":
    sys.exit(main())
