# SPDX-License-Identifier: Apache-2.0
"""Measures how long STOP takes: run_stop_benchmark.py BUILD_DIR MAP CLIENTS CALLS.

One line of JSON per load, then a table: idle, clients on light services, clients on the planners; one run, one process.
"""
import json
import os
import subprocess
import sys
import time

import owned_processes
from benchmark_programs import executable, measure
from demo_stack import DemoError, Stack

WARM_UP = 5.0  # until the planners are busy [s]
TIMEOUT = 300.0  # of one measurement [s]
NAMESPACE = "__ns:=/apollo"
AUTOGROUP = "/proc/sys/kernel/sched_autogroup_enabled"


def groups_sessions():
    """True where the kernel shares the processor among sessions first: a thread's priority then counts in its own."""
    try:
        with open(AUTOGROUP, encoding="ascii") as file:
            return file.read().strip() == "1"
    except OSError:
        return False


def measure_under(load, build_dir, clients, calls):
    """`load`: "idle", or a kind of load of stop_benchmark."""
    program = executable(build_dir, "stop_benchmark")
    others = None
    if load != "idle":
        mark = owned_processes.new_mark()
        others = subprocess.Popen([program, "load", load, str(clients), NAMESPACE], stdin=subprocess.DEVNULL,
                                  env=owned_processes.marked_environment(mark))
        time.sleep(WARM_UP)
    try:
        result = measure("stop", [program, "probe", str(calls), NAMESPACE], TIMEOUT)[0]
    finally:
        if others:
            others.terminate()
            try:
                others.wait(10.0)
            except subprocess.TimeoutExpired:
                others.kill()
                others.wait()
    return {**result, "load": load, "clients": 0 if load == "idle" else clients, "cores": os.cpu_count(),
            "autogroup": groups_sessions()}


def main(build_dir, map_file, clients, calls):
    stack = Stack(build_dir)
    try:
        stack.launch("demo.launch", map=map_file, rviz="false", x="90", y="194.75")
        from demo_drive import Drive  # rospy reads ROS_MASTER_URI when it is first imported
        Drive(stack).connect()
        results = [measure_under(load, build_dir, clients, calls) for load in ("idle", "light", "planners")]
    except DemoError as error:
        print(json.dumps({"benchmark": "stop", "error": str(error)}))
        return 1
    finally:
        stack.end()
    for result in results:
        print(json.dumps(result))
    print("\n%-10s %8s %12s %10s %10s" % ("load", "clients", "median [ms]", "p99 [ms]", "max [ms]"))
    for result in results:
        if "error" not in result:
            print("%-10s %8d %12.2f %10.2f %10.2f" % (result["load"], result["clients"], result["median_ms"],
                                                      result["p99_ms"], result["max_ms"]))
    if groups_sessions():
        print("The kernel shares the processor among sessions first (%s is 1): what nodes of low priority do delays "
              "others all the same." % AUTOGROUP)
    return 1 if any("error" in result for result in results) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])))
