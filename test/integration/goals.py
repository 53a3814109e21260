# SPDX-License-Identifier: Apache-2.0
"""Clients of the actions, for tests: a SimpleActionClient that keeps what it hears, and bare topics."""
import threading

import actionlib
import rospy
from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray
from geometry_msgs.msg import Point

import support
from external_command import msg

ACTIONS = {"lane_follow": msg.LaneFollowAction, "valet_parking": msg.ValetParkingAction,
           "free_space": msg.FreeSpaceAction, "path_follow": msg.PathFollowAction,
           "precise_parking": msg.PreciseParkingAction, "zone_cover": msg.ZoneCoverAction}
ENDS = (GoalStatus.PREEMPTED, GoalStatus.SUCCEEDED, GoalStatus.ABORTED, GoalStatus.REJECTED, GoalStatus.RECALLED)


def name_of(state):
    """Of a GoalStatus' number."""
    return GoalStatus.to_string(state)


def large_zone(**fields):
    """A command that takes seconds to plan."""
    corners = [(-600.0, -600.0), (600.0, -500.0), (700.0, 600.0), (100.0, 700.0), (-650.0, 500.0)]
    holes = [[(x, y), (x + 9.0, y + 2.0), (x + 4.0, y + 9.0)] for x in range(-500, 500, 120) for y in range(-400, 400, 90)]
    return msg.ZoneCoverCommand(drivable_roi=polygon(corners), non_drivable_roi=[polygon(hole) for hole in holes],
                                swath_width=2.0, **fields)


def polygon(corners):
    return msg.RoiPolygon(points=[Point(x, y, 0.0) for x, y in corners])


class Client:
    """A SimpleActionClient of one of the actions, with all the feedback and states that came since send()."""

    def __init__(self, name, namespace="external_command/"):
        self._goal_class = ACTIONS[name]().action_goal.goal.__class__
        self._client = actionlib.SimpleActionClient(namespace + name, ACTIONS[name])
        assert self._client.wait_for_server(rospy.Duration(support.DEADLINE)), "no server of the action " + name
        self._lock = threading.Lock()
        self._feedback = []
        self.was_active = threading.Event()

    def send(self, command):
        self._feedback = []
        self.was_active.clear()
        self._client.send_goal(self._goal_class(command=command), active_cb=self.was_active.set,
                               feedback_cb=self._on_feedback)

    def _on_feedback(self, feedback):
        with self._lock:
            self._feedback.append((rospy.get_time(), feedback.status))

    @property
    def feedback(self):
        """(time, CommandStatus) each."""
        with self._lock:
            return list(self._feedback)

    def wait_for_feedback(self):
        """The newest, once there is one."""
        support.wait_until(lambda: self.feedback, "feedback")
        return self.feedback[-1][1]

    def cancel(self):
        self._client.cancel_goal()

    def stop_tracking(self):
        self._client.stop_tracking_goal()

    def end(self, deadline=support.DEADLINE):
        """(state, result)"""
        assert self._client.wait_for_result(rospy.Duration(deadline)), \
            "the goal has not ended within %.0f s; it is %s" % (deadline, name_of(self._client.get_state()))
        return self._client.get_state(), self._client.get_result()

    def do(self, command):
        self.send(command)
        return self.end()


class BareClient:
    """The topics of one action."""

    def __init__(self, name, namespace="external_command/"):
        action = ACTIONS[name]()
        self._goal_class = action.action_goal.__class__
        base = namespace + name
        self.goals = rospy.Publisher(base + "/goal", self._goal_class, queue_size=1000)
        self.cancels = rospy.Publisher(base + "/cancel", GoalID, queue_size=1000)
        self.results = support.Collector(base + "/result", action.action_result.__class__)
        self.states = support.Collector(base + "/status", GoalStatusArray)
        for publisher in (self.goals, self.cancels):
            support.wait_until(lambda: publisher.get_num_connections() > 0, "a subscriber of " + publisher.name)

    def goal(self, goal_id, command, stamp=None):
        """The message; not sent."""
        message = self._goal_class()
        message.goal_id = GoalID(id=goal_id, stamp=stamp or rospy.Time())
        message.goal.command = command
        return message

    def send(self, goal_id, command, stamp=None):
        self.goals.publish(self.goal(goal_id, command, stamp))

    def cancel(self, goal_id="", stamp=None):
        self.cancels.publish(GoalID(id=goal_id, stamp=stamp or rospy.Time()))

    def end(self, goal_id):
        """The result of the goal, once there is one."""
        return self.results.wait_for(lambda m: m.status.goal_id.id == goal_id, "a result of " + goal_id)

    def results_of(self, goal_id):
        return [message for message in self.results.messages if message.status.goal_id.id == goal_id]

    def wait_until_known(self, goal_id, *states):
        """That the server lists the goal, in one of the states where some are given."""
        def is_known(message):
            return any(s.goal_id.id == goal_id and (not states or s.status in states) for s in message.status_list)
        self.states.wait_for(is_known, "the status of goal " + goal_id)

    def close(self):
        for topic in (self.results, self.states):
            topic.close()
        for publisher in (self.goals, self.cancels):
            publisher.unregister()
