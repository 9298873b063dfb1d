"""What the integration tests share: a detector that is started and ended, its service, clouds."""
import os
import shutil
import signal
import subprocess
import tempfile
import threading
import time

import numpy as np
import rospy
import yaml
from geometry_msgs.msg import TransformStamped
from ppf_bin_picking.srv import GetPickablePoses, GetPickablePosesRequest, GetPickablePosesResponse
from sensor_msgs.msg import PointCloud2, PointField
from tf2_msgs.msg import TFMessage

import box_scenes

LONG_S = 120.0  # ends only a test that fails; the machine may be busy
SERVICE = "/pose_detector/get_pickable_poses"


def wait_until(condition, what, timeout_s=LONG_S):
    """Returns the first true value of condition()."""
    deadline = time.monotonic() + timeout_s
    pause = threading.Event()
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        pause.wait(0.02)
    raise AssertionError("not within %g s: %s" % (timeout_s, what))


def to_message(points, frame="camera", stamp=None):
    """A cloud message of float32 points [height, width, 3]."""
    height, width, _ = points.shape
    message = PointCloud2(height=height, width=width, point_step=12, row_step=12 * width)
    message.header.frame_id = frame
    message.header.stamp = rospy.Time.now() if stamp is None else stamp
    message.fields = [PointField(n, 4 * i, PointField.FLOAT32, 1) for i, n in enumerate("xyz")]
    message.data = points.tobytes()
    return message


def matrix(pose):
    """4x4 of a geometry_msgs/Pose."""
    q = pose.orientation
    x, y, z, w = q.x, q.y, q.z, q.w
    result = np.eye(4)
    result[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    result[:3, 3] = [pose.position.x, pose.position.y, pose.position.z]
    return result


def transform(parent, child, translation, rotation_xyzw, stamp=None):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp = stamp or rospy.Time(0)
    t, r = message.transform.translation, message.transform.rotation
    t.x, t.y, t.z = translation
    r.x, r.y, r.z, r.w = rotation_xyzw
    return message


class CloudSource:
    """Publishes clouds for a detector, and the frames base_link and bin of the camera."""

    def __init__(self):
        self.clouds = rospy.Publisher("/camera/depth/points", PointCloud2, queue_size=1)
        self._tf = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self._tf.publish(
            [
                transform("base_link", "camera", (0.1, 0.2, 0.7), (1, 0, 0, 0)),
                transform("camera", "bin", (0, 0, 0.5), (0, 0, 0, 1)),
            ]
        )

    def send(self, message):
        """Publishes a cloud once the detector listens; returns its stamp."""
        wait_until(lambda: self.clouds.get_num_connections() > 0, "a detector listens")
        self.clouds.publish(message)
        return message.header.stamp


class Launched:
    """A launch file of the package that runs; its output goes into a folder of its own."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="pose_detector_test_")
        self.process = None
        self.last_output = ""

    def launch(self, name, *arguments):
        self.log = open(os.path.join(self.folder, "log"), "w+")
        command = ["roslaunch", "--wait", "ppf_bin_picking", name, *arguments]
        self.process = subprocess.Popen(command, stdout=self.log, stderr=subprocess.STDOUT)

    def write_yaml(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "w") as out:
            yaml.safe_dump(content, out)
        return path

    def wait_ready(self, model_id=""):
        """Waits until the parts are loaded."""
        not_ready = GetPickablePosesResponse.NOT_READY
        rospy.wait_for_service(SERVICE, LONG_S)
        wait_until(lambda: call(model_id=model_id).status != not_ready, "the parts are loaded")
        return self

    def output(self):
        """What has been printed so far."""
        with open(self.log.name) as log:
            return log.read()

    def stop(self):
        """Ends it; returns the seconds that took."""
        start = time.monotonic()
        if self.process:
            if self.process.poll() is None:
                self.process.send_signal(signal.SIGINT)
                self.process.wait(LONG_S)
            self.last_output = self.output()
            self.log.close()
        shutil.rmtree(self.folder)
        return time.monotonic() - start


class RunningDetector(Launched):
    """detector.launch with parts made of boxes."""

    def __init__(self, parts=("steps", "tower"), cell=None, settings=None, launch_args=()):
        super().__init__()
        self.parts = [box_scenes.write_part(self.folder, name) for name in parts]
        self.cell = {"parts": self.parts, "region_of_interest": box_scenes.REGION}
        self.cell.update(cell or {})
        self.settings = settings or {"threads": 2}
        self.launch_args = list(launch_args)

    def start(self):
        cell = self.write_yaml("cell.yaml", self.cell)
        settings = self.write_yaml("detector.yaml", self.settings)
        self.launch("detector.launch", "cell:=" + cell, "config:=" + settings, *self.launch_args)
        return self


def call(**fields):
    """One request; durations are given in seconds."""
    for name in ("timeout", "max_age"):
        if name in fields:
            fields[name] = rospy.Duration.from_sec(fields[name])
    return rospy.ServiceProxy(SERVICE, GetPickablePoses)(GetPickablePosesRequest(**fields))
