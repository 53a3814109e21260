# SPDX-License-Identifier: Apache-2.0
"""A localization that the test holds in its hand."""
import math
import threading

import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

PERIOD = 0.05  # of wall time [s]


def transform(parent="map", child="base_link", x=0.0, y=0.0, stamp=None, w=1.0, z=0.0, heading=0.0):
    """`w` is that of the quaternion where there is no heading."""
    result = TransformStamped()
    result.header.frame_id, result.child_frame_id = parent, child
    result.header.stamp = rospy.Time.now() if stamp is None else stamp
    result.transform.translation.x, result.transform.translation.y, result.transform.translation.z = x, y, z
    result.transform.rotation.w = math.cos(heading / 2.0) if heading else w
    result.transform.rotation.z = math.sin(heading / 2.0)
    return result


class Localization:
    """Publishes the pose of `child` in map, between `start()` and `stop()`."""

    def __init__(self, x, y, heading=0.0, z=0.0, child="base_link"):
        self._child = child
        self.x, self.y, self.heading, self.z = x, y, heading, z
        self.publisher = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self._is_stopped = threading.Event()
        self._thread = None

    def send(self, *transforms):
        self.publisher.publish(TFMessage(list(transforms)))

    def start(self):
        self._is_stopped.clear()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def stop(self):
        self._is_stopped.set()
        self._thread.join()

    def _run(self):
        while not self._is_stopped.wait(PERIOD):
            self.send(transform(child=self._child, x=self.x, y=self.y, z=self.z, heading=self.heading))
