# SPDX-License-Identifier: Apache-2.0
"""What scripts/faults runs: run_faults.py ROOT BUILD_DIR [NAME...]. A gateway of its own for each fault."""
import contextlib
import errno
import glob
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

from campaign import DemoError, Figures, Gateway, NAMESPACE, Periodic
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


class Clock(Periodic):
    """Simulated time, which goes on from `now` [s] unless it `stands`."""
    STEP = 0.02  # [s]

    def __init__(self, now):
        import rospy
        from rosgraph_msgs.msg import Clock as Message
        super().__init__(self.STEP, self._tick)
        self.now = now
        self.stands = False
        self._message = Message
        self._publisher = rospy.Publisher("/clock", Message, queue_size=1)

    def _tick(self):
        import rospy
        self._publisher.publish(self._message(rospy.Time.from_sec(self.now)))
        if not self.stands:
            self.now += self.STEP


def clock_jumps(gateway, figures):
    """Simulated time jumps while the vehicle drives, and stands still."""
    def drives():
        return lane_follow(gateway).status == 1

    with Clock(1000.0) as clock, Vehicle():
        figures.show("simulated time: lane_follow", seconds_until(drives), "s", 15.0)
        for name, now in (("ahead by a day", 87400.0), ("back by a day", 1000.0), ("back to 0", 0.0),
                          ("ahead to 2106", 4294967000.0), ("back by all of that", 100.0)):
            clock.now = now
            figures.show("clock jumps %s: STOP" % name, stop(gateway), "s", STOP_LIMIT)
            figures.show("clock jumps %s: lane_follow again after" % name, seconds_until(drives), "s", 15.0)
        clock.stands = True
        time.sleep(3.0)
        figures.show("clock stands: STOP", stop(gateway), "s", STOP_LIMIT)
        figures.show("clock stands: lane_follow", seconds_until(drives), "s", 15.0)


class SmallDisk:
    """A file system of half a megabyte, where this user may mount one; else `is_real` is False, and `path` a file."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self._folder.name, "disk")
        self._filler = os.path.join(self.path, "filler")
        self.is_real = False

    def __enter__(self):
        os.mkdir(self.path)
        try:
            self.is_real = subprocess.call(["mount", "-t", "tmpfs", "-o", "size=512k", "tmpfs", self.path],
                                           stderr=subprocess.DEVNULL) == 0
        except OSError:
            pass  # there is no mount
        if not self.is_real:
            os.rmdir(self.path)
            with open(self.path, "wb"):
                pass
        return self

    def __exit__(self, *_):
        if self.is_real:
            subprocess.call(["umount", "--lazy", self.path])
        self._folder.cleanup()

    def fill(self):
        try:
            with open(self._filler, "ab", buffering=0) as file:
                while True:
                    file.write(bytes(1024))
        except OSError as error:
            if error.errno not in (errno.ENOSPC, errno.ENOTDIR):
                raise

    def free(self):
        os.remove(self._filler)


def disk_is_full(gateway, figures):
    """That of the zone files and of what is printed; or, where none can be mounted, the folder of zone files is a file."""
    import fuzz_bytes
    disk = gateway.disk
    name = "full disk" if disk.is_real else "no folder for zone files"
    command = fuzz_bytes.example("zone_cover")
    command.dry_run = False
    disk.fill()
    with Vehicle():
        time.sleep(1.0)
        begin = time.monotonic()
        response = gateway.call("zone_cover", command)
        figures.show("%s: zone_cover" % name, time.monotonic() - begin, "s", LATEST_ANSWER)
        figures.show("%s: zone_cover does not tell of it" % name,
                     int(not any("is not kept" in warning for warning in response.report.warnings)), "", 0)
        begin = time.monotonic()
        for _ in range(100):
            lane_follow(gateway)
        figures.show("%s: 100 x lane_follow" % name, time.monotonic() - begin, "s", 100 * LATEST_ANSWER)
        figures.show("%s: STOP" % name, stop(gateway), "s", STOP_LIMIT)
        if not disk.is_real:
            return
        disk.free()
        gateway.call("zone_cover", command)
        written = seconds_until(lambda: glob.glob(os.path.join(disk.path, "*.zone")))
        figures.show("full disk: the zone is kept once there is room, after", written, "s", 15.0)


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


FAULTS = [planner_is_silent, chassis_is_silent, transforms_jump, clock_jumps, calls_are_cut, connections_are_many,
          disk_is_full, name_is_taken, nodelet_is_unloaded, process_is_killed, master_is_new]


def main(root, build_dir, *names):
    chosen = [fault for fault in FAULTS if not names or any(name in fault.__name__ for name in names)]
    if len(chosen) == 1:
        return run(root, build_dir, chosen[0])
    # rospy cannot change its master: a process for each.
    codes = [subprocess.call([sys.executable, __file__, root, build_dir, fault.__name__]) for fault in chosen]
    print("%d of %d faults beyond a limit" % (sum(code != 0 for code in codes), len(codes)))
    return int(any(codes))


def run(root, build_dir, fault):
    figures = Figures()
    try:
        with SmallDisk() if fault is disk_is_full else contextlib.nullcontext() as disk:
            options = {}
            if fault is process_is_killed:
                options["respawn"] = True
            if fault is clock_jumps:
                options["parameters"] = {"/use_sim_time": True}
            if fault is disk_is_full:
                options["changes"] = {"zone_cover_command_processor": {"progress_folder": disk.path}}
                options["log_dir"] = disk.path if disk.is_real else None
            with Gateway(root, build_dir, **options) as gateway:
                gateway.disk = disk
                fault(gateway, figures)
    except (DemoError, OSError) as error:
        figures.fault("%s: %s" % (fault.__name__, error))
    return int(figures.faults > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
