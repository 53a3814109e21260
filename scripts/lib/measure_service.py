# SPDX-License-Identifier: Apache-2.0
"""Times lane-follow calls of real components, one vehicle and many of one process."""
import contextlib
import multiprocessing
import os
import sys
from concurrent.futures import ProcessPoolExecutor

from benchmark_programs import executable, measure
from campaign import Gateway, memory_of
from demo_stack import DemoError, Stack

TIMEOUT = 300.0  # of the timing client [s]
CALLS = 1000
ROOT = "/apollo"  # namespace of the first vehicle


def measure_service(build_dir, map_file, vehicles):
    """The round trip of a lane-follow call over a long route beside that of an empty service of the same process: for
    one vehicle, and for `vehicles` that share process and map, called in turn; with the memory and threads of each."""
    alone = in_new_process(measure_fleet, build_dir, map_file, [])
    if vehicles < 2:
        return alone
    others = [f"/vehicle_{number}" for number in range(2, vehicles + 1)]
    fleet = in_new_process(measure_fleet, build_dir, map_file, others)
    for one, many in zip(alone, fleet):
        if "error" not in one and "error" not in many:
            many["first_vehicle_mb"] = one["memory_mb"]
            many["further_vehicle_mb"] = (many["memory_mb"] - one["memory_mb"]) / len(others)
    return alone + fleet


def in_new_process(job, *arguments):
    """rospy knows one master for as long as a process lives."""
    with ProcessPoolExecutor(max_workers=1, mp_context=multiprocessing.get_context("spawn")) as pool:
        return pool.submit(job, *arguments).result()


def measure_fleet(build_dir, map_file, others):
    stack = Stack(build_dir)
    try:
        os.environ["EC_BENCHMARK_VEHICLES"] = " ".join(others)
        stack.launch("external_command_process.launch", map=map_file, map_origin="auto",
                     executable="service_benchmark_server")
        from demo_drive import Drive  # rospy reads ROS_MASTER_URI when it is first imported
        drive = Drive(stack)
        drive.connect()
        with contextlib.redirect_stdout(sys.stderr):
            start, goal = drive.choose(None, None)
        pid = Gateway.find_pid()
        places = [repr(value) for value in (start.x, start.y, goal.x, goal.y)]
        measurements = measure("service_benchmark", [executable(build_dir, "service_benchmark"), f"__ns:={ROOT}",
                                                     *places, str(CALLS), ROOT, *others], TIMEOUT)
        figures = {"map": map_file, "memory_mb": memory_of(pid, "VmRSS"), "threads": len(os.listdir(f"/proc/{pid}/task"))}
        return [{**measurement, **figures} for measurement in measurements]
    except DemoError as error:
        return [{"benchmark": "service_benchmark", "map": map_file, "error": str(error)}]
    finally:
        stack.end()
