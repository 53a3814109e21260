#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whatever is published on /tf and /tf_static: the process goes on, and good transforms count again at once."""

import rospy
import rostest
from nav_msgs.msg import OccupancyGrid
from tf2_msgs.msg import TFMessage

import support
from external_command.msg import CommandStatus, FreeSpaceCommand, LaneFollowCommand, Pose
from external_command.srv import FreeSpace, LaneFollow
from localization import Localization, transform

NODE = "/apollo/external_command"
LATEST = rospy.Time(4294967295, 999999999)
NAN = float("nan")


class TransformsTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.localization = Localization(100.0, 195.0)
        cls.fixed = rospy.Publisher("/tf_static", TFMessage, queue_size=10)
        cls.lane_follow = staticmethod(support.service("external_command/lane_follow", LaneFollow))
        cls.free_space = staticmethod(support.service("external_command/free_space", FreeSpace))
        support.wait_until(lambda: cls.fixed.get_num_connections() > 0, "the component listens to /tf_static")
        cls.pid = support.pid_of(NODE)

    def setUp(self):
        self.localization.start()
        self.addCleanup(self.localization.stop)
        support.wait_until(self.starts_at_the_vehicle, "the vehicle's pose is known")

    def starts_at_the_vehicle(self):
        response = self.lane_follow(LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True))
        points = response.path.points
        return response.status.status == CommandStatus.FINISHED and abs(points[0].x - self.localization.x) < 0.5

    def assert_harmless(self, *transforms, publisher=None):
        for _ in range(3):
            (publisher or self.localization.publisher).publish(TFMessage(list(transforms)))
        support.wait_until(self.starts_at_the_vehicle, "the vehicle's pose is known again", 2.0)
        self.assertEqual(support.pid_of(NODE), self.pid, "it died")

    def test_no_stamp_does_harm(self):
        now = rospy.Time.now()
        for stamp in (LATEST, rospy.Time(4294967295, 0), now + rospy.Duration(30.0), now + rospy.Duration(0.4),
                      rospy.Time(0), rospy.Time(0, 1), rospy.Time(1)):
            for parent, child in (("map", "base_link"), ("base_link", "lidar"), ("earth", "map")):
                with self.subTest(stamp=stamp, child=child):
                    self.assert_harmless(transform(parent, child, x=1e6, stamp=stamp))

    def test_no_value_does_harm(self):
        for values in (dict(w=0.0), dict(w=NAN), dict(w=1e300), dict(x=NAN), dict(y=float("inf")), dict(x=1e300)):
            with self.subTest(values):
                self.assert_harmless(transform(**values))

    def test_no_frame_does_harm(self):
        for parent, child in (("", "base_link"), ("map", ""), ("", ""), ("base_link", "base_link"), ("/", "//"),
                              ("base_link", "map"), ("x" * 1000000, "base_link"), ("map", "\x01\x02\xe4")):
            with self.subTest(parent=parent[:20], child=child):
                self.assert_harmless(transform(parent, child))

    def test_no_fixed_transform_does_harm(self):
        for parent, child, stamp in (("base_link", "map", rospy.Time(0)), ("map", "base_link", LATEST),
                                     ("base_link", "base_link", LATEST), ("base_link", "camera", LATEST)):
            with self.subTest(parent=parent, child=child):
                self.assert_harmless(transform(parent, child, x=1e6, stamp=stamp), publisher=self.fixed)

    def test_no_number_of_transforms_does_harm(self):
        now = rospy.Time.now()
        self.assert_harmless(*(transform("map", "frame_%d" % i) for i in range(5000)))
        self.assert_harmless(*(transform("link_%d" % i, "link_%d" % (i + 1)) for i in range(2000)))
        self.assert_harmless(*(transform("map", "one", stamp=now - rospy.Duration(0.001 * i)) for i in range(5000)))

    def test_a_pose_of_the_future_is_none(self):
        self.localization.stop()
        self.addCleanup(self.localization.start)

        def refusal():
            self.localization.send(transform(x=100.0, y=195.0, stamp=rospy.Time.now() + rospy.Duration(30.0)))
            status = self.lane_follow(LaneFollowCommand(end_pose=Pose(x=300.0, y=195.0), dry_run=True)).status
            return status.error_code == CommandStatus.NOT_READY and "max_future_stamp" in status.message

        support.wait_until(refusal, "the pose of the future is refused")

    def test_a_grid_of_the_future_is_none_and_one_without_a_stamp_is_of_when_it_came(self):
        grids = rospy.Publisher("grid", OccupancyGrid, queue_size=1)
        support.wait_until(lambda: grids.get_num_connections() > 0, "the component listens to the grid")
        grid = OccupancyGrid()
        grid.header.frame_id = "map"
        grid.info.resolution, grid.info.width, grid.info.height = 1.0, 60, 40
        grid.info.origin.position.x, grid.info.origin.position.y, grid.info.origin.orientation.w = 80.0, 175.0, 1.0
        grid.data = [0] * 2400

        def answer():
            goal = Pose(x=110.0, y=195.0, heading=0.0, has_heading=True)
            return self.free_space(FreeSpaceCommand(parking_spot_pose=goal, dry_run=True)).status

        def refused_for(parameter):
            return lambda: (answer().error_code == CommandStatus.NOT_READY and parameter in answer().message)

        grid.header.stamp = rospy.Time.now() + rospy.Duration(30.0)
        grids.publish(grid)
        support.wait_until(refused_for("max_future_stamp"), "the grid of the future is refused")
        grid.header.stamp = rospy.Time(0)
        grids.publish(grid)
        support.wait_until(lambda: answer().status == CommandStatus.FINISHED, "the grid without a stamp is taken")
        support.wait_until(refused_for("max_grid_age"), "it has grown old")


if __name__ == "__main__":
    rospy.init_node("transforms_test")
    rostest.rosrun("external_command", "transforms", TransformsTest)
