#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the component says and does when a processor, or a parameter, is wrong."""
import os
import signal
import subprocess
import tempfile
import textwrap
import time

import rosgraph
import rospy
import rostest

import support
from component import LANE_FOLLOW, Component, configuration
from external_command.msg import CommandStatus
from external_command.srv import GetCommandStatus
from processes import Launch, Process

NAMESPACE = "/loading_test"
ACTION = "external_command/ActionCommandProcessor"
ADAPTER = "external_command/OldRoutingAdapter"
UNKNOWN = "nobody/NoSuchProcessor"


def component(processors, others=None, environment=None, **parameters):
    own = dict(parameters, processors=processors)
    return Component(NAMESPACE, dict(others or {}, external_command=own), environment)


class LoadingTest(support.TestCase):
    def assert_stops(self, started, *words):
        with started:
            code = started.wait_for_end()
            output = started.output
        self.assertNotEqual(code, 0, output)
        self.assertGreater(code, 0, "it crashed:\n" + output)
        self.assertIn("FATAL", output)
        for word in words:
            self.assertIn(word, output)

    def assert_starts(self, started, *words):
        with started:
            status = started.service("external_command/command_status", GetCommandStatus)(command_id=1).status
            self.assertEqual(status.error_code, CommandStatus.UNKNOWN_ID)
            self.assertTrue(started.is_running)
            output = started.output
        for word in words:
            self.assertIn(word, output)

    def test_starts_with_what_it_was_told_to(self):
        self.assert_starts(component([LANE_FOLLOW, ACTION]))

    def test_an_unknown_class_stops_the_start(self):
        self.assert_stops(component([LANE_FOLLOW, UNKNOWN]), UNKNOWN, "no nodelet plug-in declares", LANE_FOLLOW,
                          "setup.bash", "require_all")

    def test_a_class_that_throws_while_starting_stops_the_start(self):
        others = {"lane_follow_command_processor": {"input_command_name": 5}}
        self.assert_stops(component([ACTION, LANE_FOLLOW], others), LANE_FOLLOW,
                          NAMESPACE + "/lane_follow_command_processor/input_command_name", "string", "whole number")

    def test_a_class_that_throws_with_its_topics_open_stops_the_start(self):
        others = {"old_routing_adapter": {"goal_name": "no name of a topic"}}
        self.assert_stops(component([LANE_FOLLOW, ADAPTER], others), ADAPTER, "no name of a topic")

    def test_the_same_class_twice_stops_the_start(self):
        self.assert_stops(component([LANE_FOLLOW, LANE_FOLLOW]), LANE_FOLLOW, "twice")

    def test_two_processors_of_one_service_name_stop_the_start_with_its_parameter(self):
        others = {"lane_follow_command_processor": {"input_command_name": "external_command/action"}}
        self.assert_stops(component([ACTION, LANE_FOLLOW], others), LANE_FOLLOW, NAMESPACE + "/external_command/action",
                          NAMESPACE + "/lane_follow_command_processor/input_command_name")

    def test_two_services_of_the_component_with_one_name_stop_the_start(self):
        self.assert_stops(component([ACTION], current_command_service_name="external_command/command_status"),
                          NAMESPACE + "/external_command/command_status", "loaded twice, or", "_name")

    def test_a_map_is_looked_for_in_the_home_folder(self):
        started = component([LANE_FOLLOW], map_file="~/no_such_map.bin", environment={"HOME": "/home/somebody"})
        self.assert_stops(started, "/home/somebody/no_such_map.bin")

    def test_an_empty_list_stops_the_start(self):
        self.assert_stops(component([]), NAMESPACE + "/external_command/processors", "empty")

    def test_a_library_that_cannot_be_loaded_stops_the_start(self):
        with tempfile.TemporaryDirectory() as folder:
            broken = self._package_without_library(folder)
            paths = os.environ.get("ROS_PACKAGE_PATH", "") + ":" + folder
            self.assert_stops(component([broken], environment={"ROS_PACKAGE_PATH": paths}), broken,
                              "the library liblost", "lost_package/plugins.xml")

    @staticmethod
    def _package_without_library(folder):
        """Declares a plug-in whose library is not there."""
        package = os.path.join(folder, "lost_package")
        os.mkdir(package)
        with open(os.path.join(package, "package.xml"), "w", encoding="utf-8") as file:
            file.write(textwrap.dedent("""\
                <package format="2">
                  <name>lost_package</name><version>0.0.1</version><description>None.</description>
                  <maintainer email="nobody@example.invalid">Nobody</maintainer><license>Apache-2.0</license>
                  <buildtool_depend>catkin</buildtool_depend><depend>nodelet</depend>
                  <export><nodelet plugin="${prefix}/plugins.xml"/></export>
                </package>
                """))
        with open(os.path.join(package, "plugins.xml"), "w", encoding="utf-8") as file:
            file.write(textwrap.dedent("""\
                <library path="liblost">
                  <class name="lost_package/LostProcessor" type="lost_package::LostProcessor"
                         base_class_type="nodelet::Nodelet"/>
                </library>
                """))
        return "lost_package/LostProcessor"

    def test_a_topic_that_would_carry_two_types_stops_the_start(self):
        others = {"lane_follow_command_processor": {"output_command_name": ["planning/pad"]}}
        self.assert_stops(component([ACTION, LANE_FOLLOW], others), LANE_FOLLOW, NAMESPACE + "/planning/pad",
                          "external_command/PlanningCommand")

    def test_commands_that_would_go_nowhere_stop_the_start(self):
        others = {"action_command_processor": {"output_command_name": []}}
        self.assert_stops(component([ACTION], others), NAMESPACE + "/action_command_processor/output_command_name",
                          "empty")

    def test_what_is_no_name_of_a_topic_stops_the_start_with_the_parameter(self):
        for key, value in (("input_command_name", "a b"), ("input_command_name", ""), ("chassis_name", "~chassis"),
                           ("output_command_name", ["planning/pad", "1st"])):
            with self.subTest(key=key, value=value):
                self.assert_stops(component([ACTION], {"action_command_processor": {key: value}}),
                                  NAMESPACE + "/action_command_processor/" + key, "no name of a topic or service")

    def test_starts_the_others_where_not_all_are_required(self):
        broken = {"action_command_processor": {"input_command_name": False}}
        processors = [UNKNOWN, ACTION, LANE_FOLLOW, LANE_FOLLOW]
        started = component(processors, broken, require_all=False)
        self.assert_starts(started, UNKNOWN + " did not start", ACTION + " did not start", "input_command_name",
                           LANE_FOLLOW + " did not start", "twice")
        self.assert_starts(component([], require_all=False), "processors", "empty")

    def test_a_wrong_parameter_stops_the_start_with_its_name(self):
        wrong = {
            "processors": ("lane_follow", "list of strings"),
            "require_all": ("yes please", "boolean"),
            "map_file": ("/nowhere/base_map.bin", "/nowhere/base_map.bin"),
            "map_origin": ([1.0], "none, auto, or [x, y]"),
            "map_frame": (3, "string"),
            "diagnostic_period": ("often", "number"),
            "diagnostics_use_fqn": ("yes", "diagnostics_use_fqn must be a boolean, it is a string"),
            "max_pose_age": (-1.0, "[0.01, 3600]"),
            "planner_silence_timeout": ("long", "number"),
            "vehicle": ({"width": -2.0}, "vehicle/width"),
            "routing": ({"snap_distance": "far"}, "snap_distance"),
        }
        for name, (value, expected) in wrong.items():
            with self.subTest(name):
                parameters = dict({"processors": [LANE_FOLLOW]}, **{name: value})
                self.assert_stops(Component(NAMESPACE, {"external_command": parameters}), name, expected)

    def test_a_frame_without_a_name_stops_the_start(self):
        for key, value in (("map_frame", ""), ("map_frame", "/"), ("base_frame", "")):
            with self.subTest(key=key, value=value):
                self.assert_stops(component([LANE_FOLLOW], **{key: value}), NAMESPACE + "/external_command/" + key,
                                  "is '%s', no name of a frame" % value)

    def test_one_frame_for_map_and_vehicle_stops_the_start(self):
        for frames in ({"base_frame": "map"}, {"map_frame": "base_link"}, {"map_frame": "/odom", "base_frame": "odom"}):
            with self.subTest(frames):
                self.assert_stops(component([LANE_FOLLOW], **frames), NAMESPACE + "/external_command/map_frame",
                                  NAMESPACE + "/external_command/base_frame", "both")

    def test_starts_with_frames_of_other_names(self):
        self.assert_starts(component([LANE_FOLLOW], map_frame="/world", base_frame="rear_axle"))

    def test_a_period_of_diagnostics_that_is_none_stops_the_start(self):
        for period in (-1.0, 0.0, 0.05, 5e9, 1e30, float("inf"), float("nan")):
            with self.subTest(period):
                self.assert_stops(component([LANE_FOLLOW], diagnostic_period=period),
                                  "parameter %s/external_command/diagnostic_period is " % NAMESPACE, "[0.1, 3600]")

    def test_starts_with_either_kind_of_names_in_the_diagnostics(self):
        for has_full_names in (True, False):
            with self.subTest(has_full_names):
                self.assert_starts(component([LANE_FOLLOW], diagnostics_use_fqn=has_full_names))

    def test_starts_with_a_period_of_diagnostics_at_either_end(self):
        for period in (0.1, 3600):
            with self.subTest(period):
                self.assert_starts(component([LANE_FOLLOW], diagnostic_period=period))

    def test_a_range_is_told_by_the_parameters_name(self):
        own = {"routing": {"path_spacing": 100.0}, "arrival_silence": -1.0, "arrival_tolerance": {"along": 0.0}}
        for key, value in own.items():
            with self.subTest(key):
                name = key if not isinstance(value, dict) else next(iter(value))
                self.assert_stops(component([LANE_FOLLOW], **{key: value}), NAMESPACE + "/external_command", key,
                                  name + " is ")
        manoeuvres = {"lane_follow_command_processor": {"free_space": {"path_spacing": 100.0}}}
        self.assert_stops(component([LANE_FOLLOW], manoeuvres), "lane_follow_command_processor/free_space",
                          "path_spacing is 100; it must lie in [0.01, 1]")

    def test_a_number_that_is_none_stops_the_start(self):
        routing = {"tight_lane_change_price": float("nan")}
        self.assert_stops(component([LANE_FOLLOW], routing=routing), "routing/tight_lane_change_price is nan",
                          "[0, 1000000]")

    def test_a_missing_size_of_the_vehicle_stops_the_start_with_its_name(self):
        for key in ("wheelbase", "width", "front_overhang", "rear_overhang", "min_turning_radius"):
            with self.subTest(key):
                self.assert_stops(component([LANE_FOLLOW], vehicle={key: None}), NAMESPACE + "/external_command/vehicle/" + key,
                                  "not set")
        self.assert_stops(component([LANE_FOLLOW], vehicle={"wheelbase": None, "weelbase": 2.8}), "vehicle/wheelbase",
                          "weelbase is set")

    def test_a_size_that_an_earlier_launch_has_left_does_not_count(self):
        rospy.set_param(NAMESPACE + "/external_command/vehicle/wheelbase", 9.9)
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as vehicle:
            vehicle.write("{width: 2.0, front_overhang: 1.0, rear_overhang: 1.0, min_turning_radius: 5.0}")
            vehicle.flush()
            with Launch("external_command_process.launch", ns=NAMESPACE[1:], vehicle=vehicle.name, respawn="false") as launch:
                support.wait_until(lambda: "parameters not set" in launch.output, "it stops")
                self.assertIn(NAMESPACE + "/external_command/vehicle/wheelbase", launch.output)
        rospy.delete_param(NAMESPACE)

    def test_a_process_without_parameters_says_where_they_come_from(self):
        self.assert_stops(Component(NAMESPACE, {}), NAMESPACE + "/external_command", "processors", "vehicle",
                          "external_command_process.launch")
        self.assert_stops(Component(NAMESPACE, {"external_command": {"map_file": ""}}), "processors")

    def test_warns_of_a_key_that_nothing_reads(self):
        others = {
            "lane_follow_command_processor": {"free_space": {"margni": 0.2}, "colour": "red", "snap_distnace": 1.0},
            "action_command_processor": {"scenarios": {"stopp": ["EMERGENCY_STOP"]}},
        }
        own = {"routing": {"snap_distnace": 1.0}, "vehicle": {"max_sped": 3.0}, "map_fiel": "", "default_speed_limt": 5.0}
        prefix = NAMESPACE + "/"
        self.assert_starts(
            component([ACTION, LANE_FOLLOW], others, **own),
            *("parameter %s%s is set, but nothing reads it; did you mean %s%s?" % (prefix, wrong, prefix, right)
              for wrong, right in (
                  ("external_command/routing/snap_distnace", "external_command/routing/snap_distance"),
                  ("external_command/vehicle/max_sped", "external_command/vehicle/max_speed"),
                  ("external_command/map_fiel", "external_command/map_file"),
                  ("external_command/default_speed_limt", "external_command/routing/default_speed_limit"),
                  ("lane_follow_command_processor/snap_distnace", "external_command/routing/snap_distance"),
                  ("lane_follow_command_processor/free_space/margni", "lane_follow_command_processor/free_space/margin"),
                  ("action_command_processor/scenarios/stopp", "action_command_processor/scenarios/stop"))),
            "parameter %slane_follow_command_processor/colour is set, but nothing reads it" % prefix)

    def test_says_when_it_is_ready_and_what_it_serves_and_warns_of_nothing_in_its_own_configuration(self):
        with Component(NAMESPACE, configuration(more_processors=[ADAPTER])) as started:
            support.wait_until(lambda: "is ready" in started.output, "it is ready")
            ready = next(line for line in started.output.splitlines() if "is ready" in line)
            for service in ("lane_follow", "valet_parking", "free_space", "path_follow", "precise_parking", "zone_cover",
                            "action", "speed", "chassis", "command_status"):
                self.assertIn("%s/external_command/%s" % (NAMESPACE, service), ready)
            self.assertIn("without a map", ready)
            self.assertNotIn("WARN", started.output)

    def test_does_not_repeat_what_stops_it_as_fast_as_it_is_started(self):
        wrong = component([LANE_FOLLOW], map_file="/nowhere/base_map.bin")
        with wrong:
            wrong.wait_for_end()
            durations = []
            for _ in range(2):
                begin = time.monotonic()
                wrong.start()
                self.assertEqual(wrong.wait_for_end(), 1, wrong.output)
                durations.append(time.monotonic() - begin)
            self.assertGreater(durations[0], 2.0)
            self.assertGreater(durations[1], 4.0)
            self.assertIn("it is the same as before", wrong.output)
            rospy.set_param(NAMESPACE + "/external_command/map_file", "")
            wrong.start()
            support.wait_until(lambda: "is ready" in wrong.output, "it starts when that is mended")

    def test_a_second_one_of_the_same_name_gives_up_and_leaves_the_first_alone(self):
        with component([ACTION]) as first:
            first.service("external_command/command_status", GetCommandStatus)
            second = component([ACTION])
            second.start()
            self.assertEqual(second.wait_for_end(), 1, second.output)
            self.assertIn("there is a node %s/external_command already, process %d" % (NAMESPACE, first.pid), second.output)
            self.assertIn("FATAL", second.output)
            first.send_signal(signal.SIGSTOP)
            second.start()
            self.assertEqual(second.wait_for_end(), 1, second.output)
            self.assertIn("does not answer", second.output)
            first.send_signal(signal.SIGCONT)
            first.service("external_command/command_status", GetCommandStatus)(command_id=1)
            self.assertTrue(first.is_running)

    def test_takes_the_name_of_one_that_was_killed(self):
        with component([ACTION]) as first:
            support.wait_until(lambda: "is ready" in first.output, "it is ready")
            first.send_signal(signal.SIGKILL)
            first.wait_for_end()
            first.start()
            support.wait_until(lambda: first.output.count("is ready") == 2, "it is ready again")

    def test_takes_the_name_of_one_whose_port_is_another_nodes_by_now(self):
        with Process("rostopic", "pub", "/chatter", "std_msgs/Empty", "__name:=heir"):
            support.wait_until(lambda: support.pid_of("/heir"), "the other node is up")
            dead = rosgraph.Master(NAMESPACE + "/external_command")
            heir = rosgraph.Master("/loading_test").lookupNode("/heir")
            dead.registerPublisher(NAMESPACE + "/external_command/status", "external_command/CommandStatus", heir)
            self.assert_starts(component([ACTION]))

    def test_the_loader_of_a_manager_is_told_too(self):
        name = "/loading_test_in_manager"
        rospy.set_param(name, {"processors": [UNKNOWN]})
        load = ["rosrun", "nodelet", "nodelet", "load", "external_command/ExternalCommandProcessComponent", "manager",
                "__name:=" + name[1:]]
        result = subprocess.run(load, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=support.DEADLINE,
                                check=False)
        self.assertNotEqual(result.returncode, 0, result.stdout.decode())


if __name__ == "__main__":
    rospy.init_node("loading_test")
    rostest.rosrun("external_command", "loading", LoadingTest)
