# SPDX-License-Identifier: Apache-2.0
"""The simulated vehicle as the tests of the running system see and drive it."""
import math
import time

import rospy
import tf2_ros
from geometry_msgs.msg import Point, PoseWithCovarianceStamped

import support
from external_command.msg import Chassis, PathFollowCommand
from external_command.srv import PathFollow


class Vehicle:
    """What the vehicle reports. Its topics and services are those below `namespace`, by default the test's own."""

    def __init__(self, namespace=""):
        self._namespace = namespace
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer)
        self._chassis = None
        self._initial_pose = rospy.Publisher(namespace + "initialpose", PoseWithCovarianceStamped, queue_size=1)
        self._subscriber = rospy.Subscriber(namespace + "canbus/chassis", Chassis, self._on_chassis)
        support.wait_until(lambda: self._chassis is not None, "a message of the chassis")
        support.wait_until(lambda: self._buffer.can_transform("map", "base_link", rospy.Time()), "the vehicle's pose")

    def _on_chassis(self, chassis):
        self._chassis = chassis

    @property
    def chassis(self):
        return self._chassis

    @property
    def speed(self):
        """[m/s], negative in reverse"""
        return self._chassis.speed_mps

    @property
    def pose(self):
        """(x, y, heading)"""
        transform = self._buffer.lookup_transform("map", "base_link", rospy.Time()).transform
        q = transform.rotation
        return transform.translation.x, transform.translation.y, 2.0 * math.atan2(q.z, q.w)

    def place(self, x, y, heading=0.0):
        """Puts it there, and waits until the component knows. One that stands there already is told nothing: nobody could
        see when it has heard it, and while it drives that would end its command. One that rolled on a little after it was
        last seen there is put back."""
        support.wait_until(lambda: self._put(x, y, heading), "the component knows where the vehicle is")

    def _put(self, x, y, heading):
        """Whether the component sees it there, if that is where it is."""
        if not self.is_at(x, y, heading):
            message = PoseWithCovarianceStamped()
            message.pose.pose.position.x, message.pose.pose.position.y = x, y
            message.pose.pose.orientation.z = math.sin(heading / 2.0)
            message.pose.pose.orientation.w = math.cos(heading / 2.0)
            support.wait_until(lambda: self._initial_pose.get_num_connections() > 0, "the vehicle takes poses")
            self._initial_pose.publish(message)
            end = time.monotonic() + 3.0
            while not self.is_at(x, y, heading):
                if time.monotonic() > end:  # it took a command that was under way yet, and has left again
                    return False
                time.sleep(0.01)
        return self._component_sees_it_at(x, y)

    def is_at(self, x, y, heading):
        turned = math.remainder(self.pose[2] - heading, 2.0 * math.pi)
        return math.hypot(self.pose[0] - x, self.pose[1] - y) < 1e-3 and abs(turned) < 1e-3

    def _component_sees_it_at(self, x, y):
        command = PathFollowCommand(way_point=[Point(0.0, 0.0, 0.0), Point(10.0, 0.0, 0.0)], dry_run=True)
        command.header.frame_id = "base_link"
        points = self._follow(command).path.points
        return bool(points) and math.hypot(points[0].x - x, points[0].y - y) < 0.01

    def _follow(self, command):
        return support.service(self._namespace + "external_command/path_follow", PathFollow)(command)

    def wait_until_moving(self):
        support.wait_until(lambda: abs(self.speed) > 0.5, "the vehicle moves")

    def wait_until_standing(self):
        support.wait_until(lambda: self.speed == 0.0, "the vehicle stands")

    def ahead(self, *offsets):
        """Points ahead of the vehicle: each of `offsets` is (forward, to the left) [m]."""
        x, y, heading = self.pose
        c, s = math.cos(heading), math.sin(heading)
        return [Point(x + c * forward - s * left, y + s * forward + c * left, 0.0) for forward, left in offsets]

    def drive_straight(self, length=500.0, **fields):
        """The id of a motion command that keeps the vehicle driving."""
        command = PathFollowCommand(way_point=self.ahead((0.0, 0.0), (length, 0.0)), **fields)
        status = self._follow(command).status
        assert status.command_id > 0 and status.error_code == 0, support.describe(status)
        return status.command_id
