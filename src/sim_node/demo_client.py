#!/usr/bin/python3
"""Plays the robot controller of the demo: asks once for pickable poses and compares the answer
with the simulated scene's truth. Ends with 0 only if there are poses and none of them is wrong."""
import sys
import time

import numpy as np
import rospy
import tf2_ros
import yaml
from geometry_msgs.msg import PoseArray
from ppf_bin_picking.msg import MismatchRegion
from ppf_bin_picking.srv import GetPickablePoses, GetPickablePosesRequest, GetPickablePosesResponse

WRONG_REL = 0.1  # a pose is wrong if a point of the part is off by more, relative to its diameter
METRES = {"m": 1.0, "mm": 0.001}


def constant_name(message, value):
    """Name of the constant of a message that has the value."""
    return next(n for n in dir(message) if n.isupper() and getattr(message, n) == value)


def rotation(x, y, z, w):
    """Rotation matrix of a unit quaternion."""
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def matrix(position, orientation):
    """4 x 4 matrix of a position [m] and a quaternion as messages have them."""
    result = np.eye(4)
    result[:3, :3] = rotation(orientation.x, orientation.y, orientation.z, orientation.w)
    result[:3, 3] = position.x, position.y, position.z
    return result


def turn_about(axis, angle_rad, point):
    """Rotation about a line."""
    half = angle_rad / 2
    direction = np.array(axis, float) / np.linalg.norm(axis)
    result = np.eye(4)
    result[:3, :3] = rotation(*(np.sin(half) * direction), np.cos(half))
    result[:3, 3] = point - result[:3, :3] @ point
    return result


class Part:
    """What the comparison needs of a part: corners of its mesh, size, symmetries [m]."""

    def __init__(self, path):
        with open(path) as file:
            part = yaml.safe_load(file)
        scale = METRES[part["unit"]]
        mesh = path.rsplit("/", 1)[0] + "/" + part.get("mesh", "model.stl")
        facets = np.fromfile(mesh, [("numbers", "<f4", (4, 3)), ("attribute", "<u2")], offset=84)
        corners = np.unique(facets["numbers"][:, 1:].reshape(-1, 3), axis=0).astype(float)
        self.corners = corners * scale
        self.center = (self.corners.min(axis=0) + self.corners.max(axis=0)) / 2
        self.diameter = 2 * np.linalg.norm(self.corners - self.center, axis=1).max()
        self.is_ball = len(part.get("symmetries_continuous", [])) > 1
        self.motions = [] if self.is_ball else self._motions(part, scale)

    @staticmethod
    def _motions(part, scale):
        """All turns that map the part onto itself; a revolution in steps of one degree."""

        def line(symmetry):
            return symmetry["axis"], scale * np.array(symmetry.get("point", (0, 0, 0)), float)

        motions = [np.eye(4)]
        for symmetry in part.get("symmetries_discrete", []):
            axis, point = line(symmetry)
            steps = round(360 / symmetry["angle_deg"])
            turns = [turn_about(axis, 2 * np.pi * k / steps, point) for k in range(steps)]
            motions = [m @ t for m in motions for t in turns]
        for symmetry in part.get("symmetries_continuous", []):
            axis, point = line(symmetry)
            turns = [turn_about(axis, np.radians(k), point) for k in range(360)]
            motions = [m @ t for m in motions for t in turns]
        return motions

    def error(self, pose, truth):
        """Of the symmetric truth that fits best: greatest error of a point of the part [m], error
        of its centre [m], turn [deg]. A ball has no turn."""
        if self.is_ball:
            center = np.linalg.norm((pose - truth) @ np.append(self.center, 1))
            return center, center, 0.0
        best = (np.inf, 0, 0)
        for motion in self.motions:
            change = np.linalg.inv(truth @ motion) @ pose
            moved = self.corners @ (change[:3, :3] - np.eye(3)).T + change[:3, 3]
            surface = np.linalg.norm(moved, axis=1).max()
            if surface < best[0]:
                center = np.linalg.norm(change[:3] @ np.append(self.center, 1) - self.center)
                cosine = np.clip((np.trace(change[:3, :3]) - 1) / 2, -1, 1)
                best = (surface, center, np.degrees(np.arccos(cosine)))
        return best


def ask(service, deadline_s):
    """One answer about the next cloud; waits until the detector has loaded its model and has time."""
    end = time.monotonic() + deadline_s
    rospy.wait_for_service(service, timeout=deadline_s)
    call = rospy.ServiceProxy(service, GetPickablePoses)
    request = GetPickablePosesRequest(
        acquisition=GetPickablePosesRequest.NEXT, include_mismatching=True
    )
    not_yet = (GetPickablePosesResponse.NOT_READY, GetPickablePosesResponse.BUSY)
    while True:
        answer = call(request)
        if answer.status not in not_yet or time.monotonic() > end:
            return answer
        time.sleep(0.5)


def truth_in(frame, topic, deadline_s):
    """Poses of all parts of the scene in a frame, as matrices."""
    truth = rospy.wait_for_message(topic, PoseArray, timeout=deadline_s)
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    end = time.monotonic() + deadline_s
    while not buffer.can_transform(frame, truth.header.frame_id, rospy.Time(0)):
        if time.monotonic() > end:
            raise RuntimeError(f"no transform from {truth.header.frame_id} to {frame}")
        time.sleep(0.05)
    found = buffer.lookup_transform(frame, truth.header.frame_id, rospy.Time(0)).transform
    listener.unregister()
    to_frame = matrix(found.translation, found.rotation)
    return [to_frame @ matrix(pose.position, pose.orientation) for pose in truth.poses]


def report(answer, part, truths):
    """Prints the answer beside the truth. Returns how many poses are wrong."""
    print(f"\nStatus {constant_name(GetPickablePosesResponse, answer.status)}: {answer.message}")
    print(f"{answer.roi_points} points in the region of interest, ", end="")
    print(f"{answer.processing_time.to_sec():.2f} s of detection\n")
    print(f"            position in {answer.header.frame_id} [m]       nearest  its centre  turned")
    print("                 x      y      z  score  votes     part     off by      by")
    taken = set()
    wrong = 0
    for found in answer.poses:
        pose = found.pose.pose
        errors = [part.error(matrix(pose.position, pose.orientation), truth) for truth in truths]
        nearest = int(np.argmin([surface for surface, _, _ in errors]))
        surface, center, turn = errors[nearest]
        is_wrong = surface > WRONG_REL * part.diameter or nearest in taken
        wrong += is_wrong
        taken.add(nearest)
        place = f"{pose.position.x:7.3f}{pose.position.y:7.3f}{pose.position.z:7.3f}"
        print(f"{found.id:12}{place}{found.score:7.2f}{found.votes:7.0f}{nearest:9}", end="")
        print(f"{1000 * center:8.2f} mm{turn:6.2f} deg{'  WRONG' if is_wrong else ''}")
    regions = answer.mismatching_regions
    print(f"\n{len(truths)} parts in the bin, {len(answer.poses)} reliable poses, {wrong} wrong")
    print(f"{len(regions)} mismatching regions, whose poses are not to be picked")
    for region in regions:
        reason = constant_name(MismatchRegion, region.reason)
        print(f"{region.id:20}{reason:10}{region.hypotheses:5} hypotheses. {region.detail}")
    sys.stdout.flush()
    return wrong


def main():
    rospy.init_node("demo_client")
    deadline_s = rospy.get_param("~deadline_s", 120)
    part = Part(rospy.get_param("~part"))
    answer = ask(rospy.get_param("~service"), deadline_s)
    frame = answer.header.frame_id
    truths = truth_in(frame, rospy.get_param("~truth"), deadline_s) if answer.poses else []
    wrong = report(answer, part, truths)
    end = time.monotonic() + rospy.get_param("~hold_s", 0)
    while time.monotonic() < end and not rospy.is_shutdown():
        time.sleep(0.1)
    return 0 if answer.poses and wrong == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
