#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Following a given path without any map: by the service, and by nav_msgs/Path on a topic."""
import math

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Point, PoseStamped, TransformStamped
from nav_msgs.msg import Path

import support
from external_command import any_message
from external_command.msg import CommandLogEntry, CommandStatus, PathFollowCommand, PathPoint, PlanningCommand
from external_command.srv import PathFollow
from vehicle import Vehicle


def points(*xy):
    return [Point(x, y, 0.0) for x, y in xy]


STRAIGHT = points((0.0, 0.0), (10.0, 0.0), (20.0, 0.0))


def follow(frame="", **fields):
    command = PathFollowCommand(**fields)
    command.header.frame_id = frame
    return support.service("external_command/path_follow", PathFollow)(command)


def yard():
    """A frame at (100, 200), turned to the left by a right angle."""
    transform = TransformStamped(child_frame_id="yard")
    transform.header.frame_id = "map"
    transform.transform.translation.x, transform.transform.translation.y = 100.0, 200.0
    transform.transform.rotation.z = transform.transform.rotation.w = math.sqrt(0.5)
    return transform


def dry_run(way_point, **fields):
    return follow(way_point=way_point, dry_run=True, **fields)


def about_the_path(answer):
    """The warnings, but for that of the vehicle's distance."""
    return [warning for warning in answer.report.warnings if "from the vehicle" not in warning]


class PathFollowTest(support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vehicle = Vehicle()

    def setUp(self):
        self.sent = support.Collector("planning/command", PlanningCommand)

    def tearDown(self):
        self.sent.close()

    def assert_planned(self, answer):
        self.assertEqual(answer.status.status, CommandStatus.FINISHED, support.describe(answer.status))
        return answer.path.points

    def assert_refused(self, answer, *words):
        status = answer.status
        self.assertEqual(status.status, CommandStatus.ERROR, support.describe(status))
        self.assertEqual(status.error_code, CommandStatus.INVALID_REQUEST, support.describe(status))
        for word in words:
            self.assertIn(word, status.message)

    def sent_command(self, command_id):
        return self.sent.wait_for(lambda m: m.command_id == command_id, "planning command %d" % command_id)

    def test_drives_along_the_path_to_its_end(self):
        way = self.vehicle.ahead((0.0, 0.0), (10.0, 0.0), (20.0, 2.0), (30.0, 6.0))
        answer = follow(way_point=way, target_speed=4.0)
        self.assertEqual(answer.status.status, CommandStatus.RUNNING, support.describe(answer.status))
        self.assertEqual(answer.report.warnings, [])
        command = self.sent_command(answer.status.command_id)
        self.assertTrue(command.is_motion_command)
        self.assertFalse(command.has_lane_follow_command)
        self.assertEqual(command.command_type, PlanningCommand.CUSTOM)
        packed = any_message.unpack(command.custom_command, PathFollowCommand)
        self.assertEqual(packed.way_point, way)
        self.assertEqual(packed.command_id, answer.status.command_id)
        self.assertEqual(command.path.header.frame_id, "map")
        self.assertLessEqual(max(point.speed for point in command.path.points), 4.0)
        support.wait_for_status(answer.status.command_id, CommandStatus.FINISHED)
        x, y, _ = self.vehicle.pose
        self.assertLess(math.hypot(x - way[-1].x, y - way[-1].y), 0.3)

    def test_reverses_where_the_headings_say_so(self):
        _, _, heading = self.vehicle.pose
        way = self.vehicle.ahead((0.0, 0.0), (8.0, 0.0), (4.0, 0.0), (0.0, 0.0))
        answer = follow(way_point=way, heading=[heading] * 4)
        self.assertEqual(answer.report.gear_changes, 1)
        self.assertAlmostEqual(answer.report.reverse_length, 8.0, places=3)
        directions = [point.direction for point in self.sent_command(answer.status.command_id).path.points]
        self.assertEqual((directions[0], directions[-1]), (PathPoint.FORWARD, PathPoint.REVERSE))
        support.wait_until(lambda: self.vehicle.speed < -0.2, "the vehicle reverses")
        support.wait_for_status(answer.status.command_id, CommandStatus.FINISHED)

    def test_passes_through_every_way_point_smoothly(self):
        way = points(*[(20.0 * math.sin(0.1 * i), 20.0 - 20.0 * math.cos(0.1 * i)) for i in range(12)])
        path = self.assert_planned(dry_run(way))
        for point in way:
            self.assertLess(min(math.hypot(p.x - point.x, p.y - point.y) for p in path), 1e-6)
        for point in path:
            self.assertAlmostEqual(point.kappa, 0.05, delta=0.002)
        lengths = [after.s - before.s for before, after in zip(path, path[1:])]
        self.assertTrue(all(0.0 < length <= 0.51 for length in lengths), lengths)

    def test_warns_of_corners_bends_and_narrow_places(self):
        corner = dry_run(points((0.0, 0.0), (30.0, 0.0), (30.0, 30.0)))
        self.assert_planned(corner)
        self.assertEqual(len(about_the_path(corner)), 1, corner.report.warnings)
        for words in ("way_point[1]", "(30.00, 0.00)", "5.00 m", "1.57 rad"):
            self.assertIn(words, about_the_path(corner)[0])
        tight = dry_run(points(*[(3.0 * math.sin(0.2 * i), 3.0 - 3.0 * math.cos(0.2 * i)) for i in range(8)]))
        self.assertEqual(len(about_the_path(tight)), 1, tight.report.warnings)
        self.assertIn("radius of 3.0", about_the_path(tight)[0])
        narrow = dry_run(STRAIGHT, left_path_width=0.5, right_path_width=0.6)
        self.assertIn("1.10 m", about_the_path(narrow)[0])

    def test_takes_borders_or_widths(self):
        left, right = (points((0.0, y), (10.0, y), (20.0, y)) for y in (2.0, -2.0))
        self.assertEqual(about_the_path(dry_run(STRAIGHT, left_boundary=left, right_boundary=right)), [])
        self.assertEqual(about_the_path(dry_run(STRAIGHT, left_path_width=2.0, right_path_width=1.5)), [])
        both = dict(left_boundary=left, right_boundary=right, left_path_width=2.0, right_path_width=2.0)
        self.assert_refused(dry_run(STRAIGHT, **both), "not both")
        self.assert_refused(dry_run(STRAIGHT, left_boundary=left[:2], right_boundary=right), "left_boundary has 2")
        self.assert_refused(dry_run(STRAIGHT, left_boundary=left), "right_boundary has 0")
        self.assert_refused(dry_run(STRAIGHT, left_path_width=2.0), "right_path_width")
        self.assert_refused(dry_run(STRAIGHT, left_path_width=-2.0, right_path_width=2.0), "left_path_width is -2")

    def test_refuses_borders_that_are_swapped_and_warns_of_one_that_the_path_crosses(self):
        left, right = (points((0.0, y), (10.0, y), (20.0, y)) for y in (2.0, -1.5))
        self.assert_refused(
            dry_run(STRAIGHT, left_boundary=right, right_boundary=left),
            "left_boundary[0] (0.00, -1.50) lies 1.50 m to the right of the path, and right_boundary[0] (0.00, 2.00) "
            "lies 2.00 m to the left of the path, at way_point[0] (0.00, 0.00)", "exchange the two")
        in_part = dict(left_boundary=left[:2] + right[2:], right_boundary=right[:2] + left[2:])
        self.assert_refused(dry_run(STRAIGHT, **in_part), "left_boundary[2] (20.00, -1.50) lies 1.50 m to the right")
        beside = points((0.0, 2.0), (10.0, -0.5), (20.0, 2.0))
        crossed = about_the_path(dry_run(STRAIGHT, left_boundary=beside, right_boundary=right))
        self.assertIn("left_boundary[1] (10.00, -0.50) lies 0.50 m to the right of the path at way_point[1] (10.00, "
                      "0.00): the path leaves its borders", crossed)
        back = dict(way_point=STRAIGHT[::-1], left_boundary=left[::-1], right_boundary=right[::-1])
        self.assert_refused(dry_run(**back), "exchange the two")
        self.assert_planned(dry_run(heading=[0.0] * 3, **back))

    def test_transforms_another_frame(self):
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(yard())
        support.wait_until(lambda: dry_run(STRAIGHT, frame="yard").status.status == CommandStatus.FINISHED,
                           "the frame is known")
        path = self.assert_planned(dry_run(STRAIGHT, frame="yard"))
        self.assertAlmostEqual(path[-1].x, 100.0, places=3)
        self.assertAlmostEqual(path[-1].y, 220.0, places=3)
        self.assertAlmostEqual(path[-1].heading, math.pi / 2.0, places=3)
        self.assert_refused(dry_run(STRAIGHT, frame="no_such_frame"), "no_such_frame")

    def test_refuses_bad_paths_and_leaves_the_running_command_alone(self):
        running = self.vehicle.drive_straight()
        self.assert_refused(follow(), "way_point", "0 elements")
        self.assert_refused(follow(way_point=STRAIGHT[:1]), "way_point", "1 elements")
        self.assert_refused(follow(way_point=STRAIGHT[:1] * 3), "way_point", "all in one place")
        self.assert_refused(follow(way_point=points((0.0, 0.0), (math.nan, 0.0))), "way_point[1].x", "finite")
        self.assert_refused(follow(way_point=points((0.0, 0.0), (9e8, 0.0))), "too long")
        self.assert_refused(follow(way_point=STRAIGHT, heading=[0.0]), "heading has 1")
        self.assert_refused(follow(way_point=STRAIGHT, heading=[0.0, math.inf, 0.0]), "heading[1]", "finite")
        self.assert_refused(follow(way_point=STRAIGHT, heading=[0.0, 1.6, 1.6]), "across")
        self.assert_refused(follow(way_point=STRAIGHT, target_speed=-1.0), "target_speed")
        self.assertEqual(support.command_status(running).status, CommandStatus.RUNNING)

    def publish_path(self, way, frame="map", orientation=(0.0, 0.0), end_orientation=None, frames=()):
        """A nav_msgs/Path; its entry in the command log. Orientations are (z, w) of the quaternion."""
        publisher = rospy.Publisher("given_path", Path, queue_size=1)
        log = support.Collector("external_command/log", CommandLogEntry)
        support.wait_until(lambda: publisher.get_num_connections() > 0, "somebody takes the path")
        path = Path(poses=[PoseStamped() for _ in way])
        path.header.frame_id = frame
        for stamped, point in zip(path.poses, way):
            stamped.pose.position = point
            stamped.pose.orientation.z, stamped.pose.orientation.w = orientation
        for stamped, own in zip(path.poses, frames):
            stamped.header.frame_id = own
        if end_orientation:
            path.poses[-1].pose.orientation.z, path.poses[-1].pose.orientation.w = end_orientation
        publisher.publish(path)
        entry = log.wait_for(lambda _: True, "an entry in the log")
        log.close()
        return entry

    def test_follows_a_path_from_the_topic(self):
        entry = self.publish_path(self.vehicle.ahead((0.0, 0.0), (15.0, 0.0)))
        self.assertEqual(entry.reply.status, CommandStatus.RUNNING, support.describe(entry.reply))
        self.assertEqual(entry.caller, rospy.get_name())
        self.sent_command(entry.reply.command_id)
        support.wait_for_status(entry.reply.command_id, CommandStatus.FINISHED)

    def test_names_the_fields_of_the_message_in_what_it_warns_of(self):
        log = support.log_of("/apollo/external_command")
        corner = points((0.0, 0.0), (30.0, 0.0), (30.0, 30.0))
        for way, fields, words in (
                (corner, {}, "the path has a corner of 1.57 rad at poses[1], (30.00, 0.00)"),
                (STRAIGHT, dict(end_orientation=(math.sin(1.0), math.cos(1.0))),
                 "2.00 rad (the heading of the last of poses)")):
            with self.subTest(words):
                rospy.sleep(0.1)  # of a flood of such lines 20 a second are written
                reply = self.publish_path(way, **fields).reply
                self.assertEqual(reply.status, CommandStatus.RUNNING, support.describe(reply))
                start = "path_follow %d has warnings: " % reply.command_id
                line = log.wait_for(lambda m: m.msg.startswith(start), "the warnings in the log").msg
                self.assertIn(words, line)
                self.assertNotIn("way_point", line)
        log.close()
        self.assertIn("way_point[1]", about_the_path(dry_run(corner))[0])

    def assert_driven_forward(self, entry, *ends):
        """The path sent for it is driven forward, between these ends."""
        self.assertEqual(entry.reply.status, CommandStatus.RUNNING, support.describe(entry.reply))
        path = self.sent_command(entry.reply.command_id).path.points
        self.assertEqual({point.direction for point in path}, {PathPoint.FORWARD})
        for point, (x, y) in zip((path[0], path[-1]), ends):
            self.assertAlmostEqual(point.x, x, places=6)
            self.assertAlmostEqual(point.y, y, places=6)

    def test_orientations_that_nobody_filled_in_are_none(self):
        west = points(*[(5.0 - i, 5.0) for i in range(20)])
        north = points(*[(5.0, 5.0 + i) for i in range(20)])
        up = (math.sqrt(0.5), math.sqrt(0.5))
        for unset in ((0.0, 1.0), (0.0, 0.0)):
            self.assert_driven_forward(self.publish_path(west, orientation=unset), (5.0, 5.0), (-14.0, 5.0))
            navfn = self.publish_path(north, orientation=unset, end_orientation=up)
            self.assert_driven_forward(navfn, (5.0, 5.0), (5.0, 24.0))

    def test_each_pose_counts_in_its_own_frame(self):
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(yard())
        support.wait_until(lambda: dry_run(STRAIGHT, frame="/yard").status.status == CommandStatus.FINISHED,
                           "the frame is known")
        entry = self.publish_path(points((0.0, 0.0), (20.0, 0.0)), frames=("yard", "/yard"))
        self.assert_driven_forward(entry, (100.0, 200.0), (100.0, 220.0))
        entry = self.publish_path(points((0.0, 0.0), (100.0, 220.0)), frame="/map", frames=("yard", ""))
        self.assert_driven_forward(entry, (100.0, 200.0), (100.0, 220.0))
        unknown = self.publish_path(STRAIGHT, frames=("", "nowhere")).reply
        self.assertEqual(unknown.error_code, CommandStatus.INVALID_REQUEST, support.describe(unknown))
        self.assertIn("poses[1].header.frame_id 'nowhere'", unknown.message)

    def test_drops_repeated_points_with_their_borders_and_headings(self):
        way = [STRAIGHT[0], STRAIGHT[0], STRAIGHT[1], STRAIGHT[2], STRAIGHT[2]]
        left = points(*[(point.x, 2.0 + 0.1 * i) for i, point in enumerate(way)])
        right = points(*[(point.x, -2.0) for point in way])
        answer = follow(way_point=way, left_boundary=left, right_boundary=right, heading=[0.0] * 5)
        self.assertEqual(answer.status.status, CommandStatus.RUNNING, support.describe(answer.status))
        packed = any_message.unpack(self.sent_command(answer.status.command_id).custom_command, PathFollowCommand)
        self.assertEqual(packed.way_point, STRAIGHT)
        self.assertEqual(packed.left_boundary, [left[1], left[2], left[4]])
        self.assertEqual((len(packed.right_boundary), len(packed.heading)), (3, 3))

    def test_warns_where_the_path_cannot_end_with_the_wished_heading(self):
        answer = dry_run(STRAIGHT, has_end_heading=True, end_heading=2.0)
        self.assert_planned(answer)
        self.assertTrue([w for w in answer.report.warnings if "2.00 rad (end_heading)" in w], answer.report.warnings)

    def test_warns_of_a_path_that_begins_far_from_the_vehicle(self):
        near = dry_run(self.vehicle.ahead((1.0, 0.0), (10.0, 0.0)))
        self.assertEqual(near.report.warnings, [])
        far = dry_run(self.vehicle.ahead((100.0, 50.0), (110.0, 50.0)))
        self.assertTrue([w for w in far.report.warnings if "from the vehicle" in w], far.report.warnings)

    def test_refuses_a_bad_path_from_the_topic(self):
        statuses = support.Collector("external_command/status", CommandStatus)
        entry = self.publish_path(points((1.0, 1.0)))
        self.assertEqual(entry.reply.error_code, CommandStatus.INVALID_REQUEST, support.describe(entry.reply))
        statuses.wait_for(lambda m: m.command_id == entry.reply.command_id and m.status == CommandStatus.ERROR,
                          "the refusal on the topic of statuses")
        self.assertIn("poses has 1 elements", entry.reply.message)

    def test_names_the_fields_of_the_message_in_what_it_refuses_of_it(self):
        across = dict(orientation=(math.sqrt(0.5), math.sqrt(0.5)))
        for way, fields, words in (
                (STRAIGHT, dict(frame="nowhere"), "header.frame_id 'nowhere'"),
                (STRAIGHT, dict(frames=("nowhere",) * 3), "poses[0].header.frame_id 'nowhere'"),
                (points((0.0, 0.0), (math.nan, 0.0)), {}, "poses[1].pose.position.x is nan"),
                (points((1.0, 1.0), (1.0, 1.0)), {}, "poses has 2 points, all in one place"),
                (STRAIGHT, across, "the heading of poses[0] 1.57 rad")):
            with self.subTest(words):
                reply = self.publish_path(way, **fields).reply
                self.assertEqual(reply.error_code, CommandStatus.INVALID_REQUEST, support.describe(reply))
                self.assertIn(words, reply.message)
                self.assertNotIn("way_point", reply.message)


if __name__ == "__main__":
    rospy.init_node("path_follow_test")
    rostest.rosrun("external_command", "path_follow", PathFollowTest)
