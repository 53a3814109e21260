# SPDX-License-Identifier: Apache-2.0
import math
import unittest

from external_command.any_message import pack
from external_command.bicycle import VehicleState
from external_command.msg import (CommandStatus, FreeSpaceCommand, PathPoint, PlanningCommand, PlanningPad,
                                  SpeedCommand, ZoneCoverCommand)
from external_command.simulated_planner import PlannerSettings, SimulatedPlanner, scenario_of
from paths import DT, LIMITS, limited, make_path, motion_command


class SimulatedPlannerTest(unittest.TestCase):
    def setUp(self):
        self.planner = SimulatedPlanner(LIMITS, PlannerSettings(), VehicleState())
        self.statuses = self.planner.statuses

    def drive(self, seconds, obstacle=""):
        for _ in range(round(seconds / DT)):
            self.planner.step(DT, obstacle)

    def drive_to_end(self):
        for _ in range(50000):
            if not self.planner.has_task:
                return
            self.planner.step(DT, "")
        self.fail("the command did not end")

    def pad(self, action):
        del self.statuses[:]
        self.planner.accept_pad(action)

    def assert_last(self, command_id, status, text=""):
        self.assertEqual((self.statuses[-1].command_id, self.statuses[-1].status), (command_id, status))
        self.assertIn(text, self.statuses[-1].message)

    def test_reports_running_on_the_way_and_finished_at_the_end(self):
        self.planner.accept(motion_command(make_path([(30.0, 0.0)])))
        self.assert_last(7, CommandStatus.RUNNING)
        self.assertEqual(self.planner.scenario, "LANE_FOLLOW")
        self.drive_to_end()
        self.assert_last(7, CommandStatus.FINISHED, "arrived")
        self.assertAlmostEqual(self.planner.state.x, 30.0, delta=0.01)
        self.assertEqual(self.planner.state.speed, 0.0)
        self.assertEqual(self.planner.scenario, "IDLE")

    def test_finishes_at_once_where_it_stands_already(self):
        self.planner.accept(motion_command(make_path([(0.0, 0.0)])))
        self.assert_last(7, CommandStatus.FINISHED, "already")
        self.assertTrue(self.planner.is_idle)

    def test_refuses_a_path_without_length_elsewhere(self):
        self.planner.accept(motion_command(make_path([(0.0, 0.0)], start=(9.0, 0.0, 0.0))))
        self.assert_last(7, CommandStatus.ERROR, "no length")

    def test_is_idle_before_and_after_a_command_only(self):
        self.assertTrue(self.planner.is_idle)
        self.planner.accept(motion_command(make_path([(5.0, 0.0)])))
        self.assertFalse(self.planner.is_idle)
        self.drive_to_end()
        self.assertTrue(self.planner.is_idle)

    def test_takes_its_time_for_a_gear_change(self):
        durations = []
        for gear_change_time in (0.0, 2.0):
            planner = SimulatedPlanner(LIMITS, PlannerSettings(gear_change_time=gear_change_time), VehicleState())
            planner.accept(motion_command(make_path([(5.0, 0.0), (-5.0, 0.0)])))
            steps = 0
            while planner.has_task:
                planner.step(DT, "")
                steps += 1
            durations.append(steps * DT)
        self.assertAlmostEqual(durations[1] - durations[0], 2.0, delta=0.1)

    def test_refuses_a_bad_path_and_goes_on_with_the_running_command(self):
        self.planner.accept(motion_command(make_path([(30.0, 0.0)])))
        for points, text in (([], "0 points"), ([PathPoint()], "1 points"),
                             ([PathPoint(), PathPoint(x=math.nan)], "not finite"),
                             (make_path([(5.0, 0.0)], start=(80.0, 0.0, 0.0)), "80.0 m from the vehicle")):
            self.planner.accept(motion_command(points, command_id=8))
            self.assert_last(8, CommandStatus.ERROR, text)
            self.assertEqual(self.statuses[-1].error_code, CommandStatus.INVALID_REQUEST)
        self.drive_to_end()
        self.assert_last(7, CommandStatus.FINISHED)

    def test_refuses_what_no_controller_can_follow_only_where_that_is_asked_for(self):
        for refuse in (False, True):
            planner = SimulatedPlanner(LIMITS, PlannerSettings(refuse_bad_paths=refuse), VehicleState())
            planner.accept(motion_command(make_path([(30.0, 0.0)])))
            self.assertEqual(planner.has_task, not refuse)
            self.assertIn("where the vehicle must stop", planner.statuses[-1].message if refuse else planner.faults[0])
            planner.accept(motion_command(limited(make_path([(30.0, 0.0)])), command_id=8))
            self.assertEqual(planner.statuses[-1].status, CommandStatus.RUNNING)

    def test_refuses_a_path_that_begins_elsewhere_where_that_is_asked_for(self):
        planner = SimulatedPlanner(LIMITS, PlannerSettings(refuse_bad_paths=True), VehicleState())
        planner.accept(motion_command(limited(make_path([(30.0, 0.0)], start=(1.0, 0.0, 0.0)))))
        self.assertIn("begins 1.00 m from the vehicle", planner.statuses[-1].message)
        planner.place(VehicleState(0.0, 0.0, 0.0, speed=5.0))
        planner.accept(motion_command(limited(make_path([(30.0, 0.0)], start=(1.0, 0.0, 0.0)))))
        self.assertEqual(planner.statuses[-1].status, CommandStatus.RUNNING)

    def test_takes_bends_beyond_the_vehicle_where_they_are_allowed(self):
        for allow in (False, True):
            settings = PlannerSettings(refuse_bad_paths=True, allow_tight_bends=allow)
            planner = SimulatedPlanner(LIMITS, settings, VehicleState())
            planner.accept(motion_command(limited(make_path([(5.0, 0.3)]))))
            self.assertEqual(planner.has_task, allow)

    def test_refuses_a_path_in_another_frame(self):
        command = motion_command(make_path([(5.0, 0.0)]))
        command.path.header.frame_id = "odom"
        self.planner.accept(command)
        self.assert_last(7, CommandStatus.ERROR, "frame odom")

    def test_a_new_command_replaces_the_running_one_without_a_stop(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)])))
        self.drive(5.0)
        speed = self.planner.state.speed
        start = (self.planner.state.x, self.planner.state.y, self.planner.state.heading)
        self.planner.accept(motion_command(make_path([(40.0, 0.05)], start=start), command_id=8))
        self.drive(0.5)
        self.assertGreater(self.planner.state.speed, speed - 1.0)
        self.drive_to_end()
        self.assert_last(8, CommandStatus.FINISHED)

    def test_a_new_command_in_the_other_gear_is_driven_after_a_stop(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)])))
        self.drive(5.0)
        start = (self.planner.state.x, self.planner.state.y, self.planner.state.heading)
        self.planner.accept(motion_command(make_path([(-20.0, 0.0)], start=start), command_id=8))
        self.drive_to_end()
        self.assert_last(8, CommandStatus.FINISHED)

    def test_an_end_that_is_missed_is_an_error(self):
        self.planner.place(VehicleState(0.0, 5.0, 2.0))
        self.planner.accept(motion_command(make_path([(2.0, 0.0)])))
        self.drive_to_end()
        self.assert_last(7, CommandStatus.ERROR, "from the end of the path")

    def test_being_put_elsewhere_ends_the_command(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)])))
        self.drive(2.0)
        self.planner.place(VehicleState(1.0, 2.0, 3.0))
        self.assert_last(7, CommandStatus.ERROR, "put somewhere else")
        self.assertEqual((self.planner.state.x, self.planner.state.speed), (1.0, 0.0))

    def test_an_obstacle_of_the_chassis_holds_the_vehicle_and_is_told(self):
        self.planner.accept(motion_command(make_path([(30.0, 0.0)])))
        self.drive(2.0, "manual mode")
        self.assertEqual(self.planner.state.x, 0.0)
        self.planner.report_progress("manual mode")
        self.assert_last(7, CommandStatus.RUNNING, "waiting: manual mode")
        self.drive_to_end()
        self.assert_last(7, CommandStatus.FINISHED)

    def test_stop_brakes_hard_and_is_finished_when_the_vehicle_stands(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)])))
        self.drive(5.0)
        speed = self.planner.state.speed
        self.pad(PlanningPad.STOP)
        self.assertEqual(self.planner.scenario, "EMERGENCY_STOP")
        self.drive(0.9 * speed / LIMITS.max_deceleration)
        self.assertEqual(self.statuses, [])
        self.drive(0.2 * speed / LIMITS.max_deceleration)
        self.assert_last(0, CommandStatus.FINISHED)
        self.planner.report_progress("")
        self.assert_last(7, CommandStatus.RUNNING, "EMERGENCY_STOP")

    def test_stop_of_a_standing_vehicle_is_finished_at_once(self):
        self.pad(PlanningPad.STOP)
        self.drive(DT)
        self.assert_last(0, CommandStatus.FINISHED)

    def test_resume_goes_on_after_stop_and_pull_over(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)])))
        for action in (PlanningPad.STOP, PlanningPad.PULL_OVER):
            self.drive(4.0)
            self.pad(action)
            self.drive(10.0)
            self.assertEqual(self.planner.state.speed, 0.0)
            self.planner.accept_pad(PlanningPad.RESUME_CRUISE)
        self.drive_to_end()
        self.assert_last(7, CommandStatus.FINISHED)

    def test_pull_over_stops_to_the_right_of_the_path(self):
        self.planner.accept(motion_command(make_path([(90.0, 0.0)])))
        self.drive(5.0)
        self.pad(PlanningPad.PULL_OVER)
        self.drive(10.0)
        self.assertEqual(self.planner.scenario, "EMERGENCY_PULL_OVER")
        self.assert_last(0, CommandStatus.FINISHED)
        self.assertLess(self.planner.state.y, -0.5)

    def test_a_new_motion_command_ends_a_stop(self):
        self.pad(PlanningPad.STOP)
        self.drive(1.0)
        self.planner.accept(motion_command(make_path([(10.0, 0.0)])))
        self.drive_to_end()
        self.assert_last(7, CommandStatus.FINISHED)

    def test_clear_planning_forgets_the_path_and_stops(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)])))
        self.drive(5.0)
        self.pad(PlanningPad.CLEAR_PLANNING)
        self.drive(5.0)
        self.assertEqual((self.planner.state.speed, self.planner.scenario), (0.0, "IDLE"))
        self.assertEqual(self.statuses, [])
        self.assertTrue(self.planner.is_idle)

    def test_other_actions_show_as_scenario_for_a_while(self):
        for action, scenario in ((PlanningPad.CHANGE_LEFT, "CHANGE_LEFT"),
                                 (PlanningPad.ENTER_MISSION, "ENTER_MISSION")):
            self.pad(action)
            self.assertEqual(self.planner.scenario, scenario)
            self.assert_last(0, CommandStatus.FINISHED)
            self.drive(2.1)
            self.assertEqual(self.planner.scenario, "IDLE")

    def test_the_target_speed_of_the_command_is_kept(self):
        self.planner.accept(motion_command(make_path([(60.0, 0.0)]), target_speed=2.0))
        self.drive(5.0)
        self.assertAlmostEqual(self.planner.state.speed, 2.0, places=3)

    def test_speed_commands_change_and_restore_the_speed(self):
        self.planner.accept(motion_command(make_path([(200.0, 0.0)])))
        for command, speed in ((SpeedCommand(kind=1, target_speed=3.0), 3.0),
                               (SpeedCommand(kind=2, target_speed_factor=0.5), 1.5),
                               (SpeedCommand(kind=2, target_speed_factor=0.0), 0.0),
                               (SpeedCommand(kind=3), 5.0)):
            command.command_id = 40
            self.planner.accept_speed(command)
            self.assert_last(40, CommandStatus.FINISHED)
            self.drive(6.0)
            self.assertAlmostEqual(self.planner.state.speed, speed, places=3)

    def test_a_speed_command_packed_in_a_planning_command_works_too(self):
        self.planner.accept(motion_command(make_path([(200.0, 0.0)])))
        packed = pack(SpeedCommand(command_id=41, kind=1, target_speed=1.0))
        self.planner.accept(PlanningCommand(command_id=41, custom_command=packed))
        self.assert_last(41, CommandStatus.FINISHED)

    def test_speed_commands_that_make_no_sense_are_refused(self):
        self.planner.accept_speed(SpeedCommand(command_id=9, kind=3))
        self.assert_last(9, CommandStatus.ERROR, "no motion command")
        self.planner.accept(motion_command(make_path([(20.0, 0.0)])))
        for command, text in ((SpeedCommand(kind=1), "target_speed is 0"), (SpeedCommand(kind=7), "kind is 7"),
                              (SpeedCommand(kind=1, target_speed=math.nan), "target_speed is nan"),
                              (SpeedCommand(kind=2, target_speed_factor=1.5), "target_speed_factor is 1.5")):
            self.planner.accept_speed(command)
            self.assert_last(0, CommandStatus.ERROR, text)


class ScenarioTest(unittest.TestCase):
    def test_is_named_after_the_command(self):
        self.assertEqual(scenario_of(PlanningCommand()), "LANE_FOLLOW")
        self.assertEqual(scenario_of(PlanningCommand(command_type=PlanningCommand.PARKING)), "VALET_PARKING")
        for message, name in ((FreeSpaceCommand(), "FREE_SPACE"), (ZoneCoverCommand(), "ZONE_COVER")):
            self.assertEqual(scenario_of(PlanningCommand(custom_command=pack(message))), name)


if __name__ == "__main__":
    unittest.main()
