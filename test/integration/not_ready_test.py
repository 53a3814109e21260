#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What is missing is named, and what does not need it works."""

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Point

import support
from external_command.msg import (CommandStatus, LaneFollowCommand, PathFollowCommand, PlanningCommand, Pose,
                                  PreciseParkingCommand, RoiPolygon, ValetParkingCommand, ZoneCoverCommand)
from external_command.srv import LaneFollow, PathFollow, PreciseParking, ValetParking, ZoneCover
from localization import transform

EAST_END = Pose(x=300.0, y=195.0)


def lane_follow(ns, **fields):
    return support.service("/%s/external_command/lane_follow" % ns, LaneFollow)(LaneFollowCommand(**fields)).status


def path_follow(ns, command):
    return support.service("/%s/external_command/path_follow" % ns, PathFollow)(command).status


def commands_from(place):
    """{what it is: a call of the gateway that knows no pose, as a dry run}, for motions that take a start."""
    square = RoiPolygon([Point(x=place.x + x, y=place.y + y) for x, y in ((-6, -6), (30, -6), (30, 12), (-6, 12))])
    kinds = {
        "lane_follow": (LaneFollow, LaneFollowCommand, dict(end_pose=EAST_END)),
        "valet_parking": (ValetParking, ValetParkingCommand, dict(parking_spot_id="n_out_10")),
        "precise_parking": (PreciseParking, PreciseParkingCommand,
                            dict(parking_spot_pose=Pose(x=322.0, y=110.0, has_heading=True), parking_inwards=True)),
        "zone_cover of an area": (ZoneCover, ZoneCoverCommand, dict(zone_cover_area_id="yard", swath_width=5.0)),
        "zone_cover of a polygon": (ZoneCover, ZoneCoverCommand, dict(drivable_roi=square, swath_width=4.0))}

    def call(kind, **fields):
        service_type, command, own = kinds[kind]
        service = support.service("/without_pose/external_command/" + kind.split()[0], service_type)
        return service(command(dry_run=True, **own, **fields)).status
    return {kind: lambda kind=kind, **fields: call(kind, **fields) for kind in kinds}


class NotReadyTest(support.TestCase):
    def test_says_that_no_map_is_loaded(self):
        status = lane_follow("without_map", end_pose=EAST_END)
        self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
        self.assertIn("map_file", status.message)

    def test_says_that_the_pose_is_missing_and_replays_nothing_when_it_comes(self):
        sent = support.Collector("/without_pose/planning/command", PlanningCommand)
        status = lane_follow("without_pose", end_pose=EAST_END)
        self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
        self.assertIn("nobody", status.message)

        broadcaster = tf2_ros.TransformBroadcaster()

        def is_known():
            broadcaster.sendTransform(transform("map", "nobody", x=100.0, y=195.0))
            answer = lane_follow("without_pose", end_pose=EAST_END, dry_run=True)
            return answer.error_code != CommandStatus.NOT_READY

        in_its_frame = PathFollowCommand(way_point=[Pose(), Pose(x=10.0)], dry_run=True)
        in_its_frame.header.frame_id = "nobody"
        self.assertEqual(path_follow("without_pose", in_its_frame).error_code, CommandStatus.NOT_READY)
        support.wait_until(is_known, "the pose is known")
        self.assertEqual(path_follow("without_pose", in_its_frame).status, CommandStatus.FINISHED)
        rospy.sleep(1.5)  # beyond ~max_pose_age
        status = path_follow("without_pose", in_its_frame)
        self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
        self.assertIn("~max_pose_age", status.message)
        self.assertEqual(sent.messages, [])

    def test_what_lies_in_a_frame_that_the_vehicle_carries_needs_its_pose(self):
        broadcaster, fixed = tf2_ros.TransformBroadcaster(), tf2_ros.StaticTransformBroadcaster()
        fixed.sendTransform([transform("nobody", "lidar", x=1.0), transform("map", "dock", x=50.0)])

        def status_in(frame):
            command = PathFollowCommand(way_point=[Pose(), Pose(x=10.0)], dry_run=True)
            command.header.frame_id = frame
            return path_follow("without_pose", command)

        def are_known():
            broadcaster.sendTransform([transform("map", "nobody", x=100.0, y=195.0), transform("lidar", "beam")])
            return all(status_in(frame).status == CommandStatus.FINISHED for frame in ("lidar", "beam", "dock"))

        support.wait_until(are_known, "the frames are known")
        rospy.sleep(1.5)  # beyond ~max_pose_age
        for frame in ("lidar", "beam"):
            with self.subTest(frame):
                status = status_in(frame)
                self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
                self.assertIn("~max_pose_age", status.message)
        self.assertEqual(status_in("dock").status, CommandStatus.FINISHED)

    def test_a_given_start_needs_no_vehicle(self):
        start = Pose(x=100.0, y=195.0, heading=0.0, has_heading=True)
        for name, call in commands_from(start).items():
            with self.subTest(name):
                status = call(is_start_pose_set=True, way_point=[start])
                self.assertEqual(status.status, CommandStatus.FINISHED, support.describe(status))

    def test_without_a_given_start_the_vehicle_is_asked_for(self):
        for name, call in commands_from(EAST_END).items():
            with self.subTest(name):
                status = call()
                self.assertEqual(status.error_code, CommandStatus.NOT_READY, support.describe(status))
                self.assertIn("pose", status.message)


if __name__ == "__main__":
    rospy.init_node("not_ready_test")
    rostest.rosrun("external_command", "not_ready", NotReadyTest)
