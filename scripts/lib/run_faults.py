# SPDX-License-Identifier: Apache-2.0
"""What scripts/faults runs: run_faults.py ROOT BUILD_DIR [NAME...]. A gateway of its own for each fault."""
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
import time

from campaign import DemoError, Figures, Gateway, NAMESPACE
from run_soak import QUIET, Vehicle

LATEST_ANSWER = 5.0  # [s]
STOP_LIMIT = 1.0  # of a machine that other programs load too [s]
CONNECTIONS = 1000
UNLOADS = 200
UNLOAD_GROWTH = 10.0  # [MB]
SERVICE = "/%s/external_command/" % NAMESPACE


def seconds_until(condition, limit=60.0):
    """How long until `condition()` is true; more than `limit` where it does not come [s]."""
    begin = time.monotonic()
    while time.monotonic() < begin + limit:
        if condition():
            return time.monotonic() - begin
        time.sleep(0.02)
    return limit + 1.0


def stop(gateway):
    """How long STOP takes; raises DemoError where it is refused [s]."""
    from external_command import msg
    begin = time.monotonic()
    status = gateway.call("action", msg.ActionCommand(command=msg.ActionCommand.STOP)).status
    if status.status == msg.CommandStatus.ERROR:
        raise DemoError("STOP was refused: %s" % status.message)
    return time.monotonic() - begin


def answers(gateway):
    from external_command.client import ServiceUnavailable
    try:
        stop(gateway)
        return True
    except (ServiceUnavailable, OSError):
        return False


def lane_follow(gateway):
    from external_command import msg
    from external_command.client import pose
    return gateway.call("lane_follow", msg.LaneFollowCommand(end_pose=pose(478.0, 338.25))).status


def put_vehicle(x, y, ahead=0.0):
    """One transform; `ahead`: of its stamp [s]."""
    import rospy
    import tf2_ros
    from geometry_msgs.msg import TransformStamped
    broadcaster = tf2_ros.TransformBroadcaster()
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = "map", "base_link"
    transform.transform.rotation.w = 1.0
    transform.transform.translation.x, transform.transform.translation.y = x, y
    for _ in range(20):
        transform.header.stamp = rospy.Time.now() + rospy.Duration(ahead)
        broadcaster.sendTransform(transform)
        time.sleep(0.02)


def planner_is_silent(gateway, figures):
    with Vehicle():
        time.sleep(1.0)
        status = lane_follow(gateway)
        figures.show("silent planner: STOP", stop(gateway), "s", STOP_LIMIT)
        figures.show("silent planner: lane_follow is RUNNING", int(status.status != 1), "", 0)


def chassis_is_silent(gateway, figures):
    from external_command import msg
    status = gateway.call("action", msg.ActionCommand(command=msg.ActionCommand.SWITCH_TO_MANUAL)).status
    from external_command.srv import GetCommandStatus
    import rospy
    ask = rospy.ServiceProxy(SERVICE + "command_status", GetCommandStatus)
    took = seconds_until(lambda: ask(command_id=status.command_id).status.status != msg.CommandStatus.RUNNING)
    figures.show("silent chassis: the switch to manual ends after", took, "s", 10.0)


def transforms_jump(gateway, figures):
    slowest = 0.0
    for x, y, ahead in ((90.0, 194.75, 0.0), (1e7, -1e7, 0.0), (90.0, 194.75, 1000.0), (float("nan"), 0.0, 0.0),
                        (90.0, 194.75, -1000.0)):
        put_vehicle(x, y, ahead)
        begin = time.monotonic()
        lane_follow(gateway)
        slowest = max(slowest, time.monotonic() - begin)
    figures.show("jumping transforms: slowest answer", slowest, "s", LATEST_ANSWER)
    figures.show("jumping transforms: STOP", stop(gateway), "s", STOP_LIMIT)
    with Vehicle():
        figures.show("jumping transforms: good ones count again after",
                     seconds_until(lambda: lane_follow(gateway).status == 1), "s", 15.0)


def calls_are_cut(gateway, figures):
    """Connections that end in the middle of a request, or before the answer is read."""
    import rosservice
    import fuzz_bytes
    from external_command.client import SERVICES
    name = SERVICE + "zone_cover"
    host, port = rosservice.get_service_uri(name)[len("rosrpc://"):].rsplit(":", 1)
    request = fuzz_bytes.serialized(SERVICES["zone_cover"][0]._request_class(fuzz_bytes.example("zone_cover")))
    header = fuzz_bytes.frame([b"service=" + name.encode(), b"md5sum=*", b"callerid=/cut"])
    whole = header + len(request).to_bytes(4, "little") + request
    for size in list(range(0, len(whole), 7)) + 20 * [len(whole)]:
        with socket.create_connection((host, int(port)), LATEST_ANSWER) as connection:
            connection.sendall(whole[:size])
    figures.show("cut calls: STOP", stop(gateway), "s", STOP_LIMIT)


def connections_are_many(gateway, figures):
    import rosservice
    host, port = rosservice.get_service_uri(SERVICE + "action")[len("rosrpc://"):].rsplit(":", 1)
    connections = []
    try:
        for _ in range(CONNECTIONS):
            connections.append(socket.create_connection((host, int(port)), LATEST_ANSWER))
        figures.show("%d connections that say nothing: STOP" % CONNECTIONS, stop(gateway), "s", STOP_LIMIT)
    finally:
        for connection in connections:
            connection.close()
    figures.show("%d connections closed: STOP" % CONNECTIONS, stop(gateway), "s", STOP_LIMIT)


def disk_is_full(gateway, figures):
    """The folder of zone files can hold nothing: it is a file."""
    import fuzz_bytes
    command = fuzz_bytes.example("zone_cover")
    command.dry_run = False
    with Vehicle():
        time.sleep(1.0)
        begin = time.monotonic()
        gateway.call("zone_cover", command)
        figures.show("no folder for zone files: zone_cover", time.monotonic() - begin, "s", LATEST_ANSWER)
    figures.show("no folder for zone files: STOP", stop(gateway), "s", STOP_LIMIT)


def name_is_taken(gateway, figures):
    """A second gateway of the same name."""
    second = subprocess.run(["rosrun", "external_command", "external_command_process", "__ns:=/" + NAMESPACE,
                             "__name:=external_command"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            timeout=60.0, check=False)
    figures.show("two of one name: the second ends with an error", int(second.returncode == 0), "", 0)
    figures.show("two of one name: the first lives on", int(not gateway.is_alive()), "", 0)
    figures.show("two of one name: STOP", stop(gateway), "s", STOP_LIMIT)


NO_ELEMENTS = struct.pack("<I", 0)


def text(words):
    return struct.pack("<I", len(words)) + words.encode()


class Done:
    """Stands for the services of nodelet, for which Debian has no Python package."""
    _md5sum = "*"

    class _response_class:
        def deserialize(self, data):
            if data != b"\1":
                raise DemoError("the nodelet was not loaded, or not unloaded")


def nodelet_is_unloaded(gateway, figures):
    """A processor, again and again, while it plans."""
    import rospy
    import fuzz_bytes
    from external_command.client import ServiceUnavailable
    manager = "/%s/external_command/" % NAMESPACE
    load = fuzz_bytes.RawCaller(manager + "load_nodelet", Done)
    unload = fuzz_bytes.RawCaller(manager + "unload_nodelet", Done)
    name = "/%s/second_zone_cover" % NAMESPACE
    load_request = text(name) + text("external_command/ZoneCoverCommandProcessor") + 3 * NO_ELEMENTS + text("")
    rospy.set_param(name, {"input_command_name": "external_command/second_zone_cover"})
    slowest = 0.0
    settled = None

    def plan():
        from external_command.srv import ZoneCover
        try:
            rospy.ServiceProxy(SERVICE + "second_zone_cover", ZoneCover)(command=fuzz_bytes.example("zone_cover"))
        except (rospy.ServiceException, ServiceUnavailable):
            pass  # unloaded meanwhile

    for i in range(UNLOADS):
        load.call(load_request)
        thread = threading.Thread(target=plan)
        thread.start()
        time.sleep(0.05)
        begin = time.monotonic()
        unload.call(text(name))
        slowest = max(slowest, time.monotonic() - begin)
        thread.join()
        if i == UNLOADS // 10:
            time.sleep(QUIET)
            settled = gateway.rss()
    time.sleep(QUIET)
    figures.show("%d unloads while planning: slowest" % UNLOADS, slowest, "s", LATEST_ANSWER)
    figures.show("%d unloads: memory after the first %d" % (UNLOADS, UNLOADS // 10), settled, "MB")
    figures.show("%d unloads: growth since then" % UNLOADS, gateway.rss() - settled, "MB", UNLOAD_GROWTH)
    figures.show("%d unloads: STOP" % UNLOADS, stop(gateway), "s", STOP_LIMIT)


def process_is_killed(gateway, figures):
    os.kill(gateway.pid, signal.SIGKILL)
    took = seconds_until(lambda: gateway.find_pid() not in (None, gateway.pid) and answers(gateway))
    figures.show("kill -9: STOP answers again after", took, "s", LATEST_ANSWER)


def master_is_new(gateway, figures):
    """The ROS master is killed, and another one started in its place."""
    import owned_processes
    for pid in owned_processes.pids(gateway.stack.mark):
        with open("/proc/%d/cmdline" % pid, "rb") as file:
            if b"/rosmaster" in file.read():
                os.kill(pid, signal.SIGKILL)
    time.sleep(1.0)
    gateway.start_master("another_master")
    took = seconds_until(lambda: gateway.find_pid() == gateway.pid and answers(gateway))
    figures.show("new ROS master: STOP answers again after", took, "s", 15.0)


FAULTS = [(planner_is_silent, {}), (chassis_is_silent, {}), (transforms_jump, {}), (calls_are_cut, {}),
          (connections_are_many, {}),
          (disk_is_full, {"zone_cover_command_processor": {"progress_folder": "{folder}/config.yaml"}}),
          (name_is_taken, {}), (nodelet_is_unloaded, {}), (process_is_killed, {}), (master_is_new, {})]


def main(root, build_dir, *names):
    chosen = [item for item in FAULTS if not names or any(name in item[0].__name__ for name in names)]
    if len(chosen) == 1:
        return run(root, build_dir, *chosen[0])
    # rospy cannot change its master: a process for each.
    codes = [subprocess.call([sys.executable, __file__, root, build_dir, fault.__name__]) for fault, _ in chosen]
    print("%d of %d faults beyond a limit" % (sum(code != 0 for code in codes), len(codes)))
    return int(any(codes))


def run(root, build_dir, fault, changes):
    figures = Figures()
    try:
        with Gateway(root, build_dir, changes, respawn=fault is process_is_killed) as gateway:
            fault(gateway, figures)
    except (DemoError, OSError) as error:
        figures.fault("%s: %s" % (fault.__name__, error))
    return int(figures.faults > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
