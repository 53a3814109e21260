# SPDX-License-Identifier: Apache-2.0
"""What scripts/fuzz runs: run_fuzz.py ROOT BUILD_DIR [--minutes N] [--seed N]."""
import argparse
import glob
import os
import subprocess
import sys
import threading
import time

import answer_times
from benchmark_programs import executable
from campaign import DemoError, Figures, Gateway, MemoryWatch
from run_soak import QUIET

MOST_MEMORY = 500.0  # beyond that at the beginning [MB]
SHARE_OF_MAPS = 0.33
CLIENTS = 3


def fuzz_maps(root, build_dir, minutes, seed, figures):
    files = sorted(glob.glob(os.path.join(root, "test", "fuzz", "corpus", "*.txt")) +
                   glob.glob(os.path.join(root, "maps", "*", "base_map.bin")))
    result = subprocess.run([executable(build_dir, "map_fuzzer"), str(minutes), str(seed), *files],
                            stdout=subprocess.PIPE, universal_newlines=True, check=False)
    print(result.stdout, end="", flush=True)
    if result.returncode != 0:
        figures.fault("map_fuzzer ended with exit code %d" % result.returncode)


def watch(gateway, end, figures):
    """Until `end`, or the gateway's end, of which it tells."""
    while time.monotonic() < end:
        if not os.path.exists("/proc/%d" % gateway.pid):
            figures.fault("the gateway has ended; see %s" % gateway.stack.log_file("roslaunch"))
            return
        time.sleep(0.5)


def fuzz_gateway(root, build_dir, minutes, seed, figures):
    changes = {"zone_cover_command_processor": {"obstacle_grid_name": "grid", "progress_folder": "{folder}"},
               "free_space_command_processor": {"obstacle_grid_name": "grid"}}
    with Gateway(root, build_dir, changes) as gateway, MemoryWatch(gateway) as memory:
        import fuzz_bytes
        import fuzz_grids
        import fuzz_requests
        from actionlib_msgs.msg import GoalID
        from external_command import msg
        from geometry_msgs.msg import TransformStamped
        from nav_msgs.msg import OccupancyGrid
        from tf2_msgs.msg import TFMessage
        findings = fuzz_requests.Findings()
        grids = fuzz_grids.Grids(seed)
        zone_files = fuzz_grids.make_zone_file(grids, gateway.folder)
        if not zone_files:
            figures.fault("no zone was begun, and no file of one is damaged")
        end = time.monotonic() + 60.0 * minutes
        topics = {"/apollo/planning/command_status": msg.CommandStatus(message="a report"),
                  "/apollo/planning/state": msg.PlanningState(scenario="LANE_FOLLOW"),
                  "/apollo/canbus/chassis": msg.Chassis(vin="a vin"),
                  fuzz_grids.TOPIC: OccupancyGrid(data=[0] * 100),
                  "/tf": TFMessage(transforms=[TransformStamped()])}
        for service in answer_times.MOTION_SERVICES:
            topics["/apollo/external_command/%s/goal" % service] = fuzz_bytes.example_goal(service)
            topics["/apollo/external_command/%s/cancel" % service] = GoalID(id="a goal")
        requests = subprocess.Popen(
            [sys.executable, os.path.join(root, "scripts", "lib", "fuzz_requests.py"), "--seed", str(seed),
             "--duration", str(60.0 * minutes), "--threads", "4", "--stop-limit", "5"])
        jobs = [(fuzz_bytes.shoot_bytes, (seed + i, end, findings)) for i in range(CLIENTS)]
        jobs += [(fuzz_bytes.shake_hands_badly, (seed, end, findings)),
                 (fuzz_bytes.call_damaged, (seed, end, findings)),
                 (fuzz_bytes.publish_bytes, (seed, end, topics, findings, grids.is_left_alone)),
                 (fuzz_grids.fuzz_grids, (grids, end, findings)),
                 (fuzz_grids.fuzz_zone_files, (seed, end, zone_files, findings)),
                 (watch, (gateway, end, figures))]
        threads = [threading.Thread(target=job, args=arguments) for job, arguments in jobs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        if requests.wait() != 0:
            figures.fault("requests: see above")
        if findings.show():
            figures.fault("bytes, topics, grids or zone files: see above")
        if not gateway.is_alive():
            figures.fault("another gateway answers than at the beginning, or none")
        time.sleep(QUIET)
        figures.show("hostile bytes, messages, grids, zone files", sum(findings.calls.values()))
        figures.show("slowest answer to them", max(findings.slowest.values()), "s",
                     answer_times.latest_answer("zone_cover"))
        figures.show("most memory beyond that at the beginning", memory.most, "MB", MOST_MEMORY)
        figures.show("memory that stayed", gateway.rss() - memory.begin, "MB")


def main(words):
    parser = argparse.ArgumentParser(prog="scripts/fuzz")
    parser.add_argument("root")
    parser.add_argument("build_dir")
    parser.add_argument("--minutes", type=float, default=5.0)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args(words)
    figures = Figures()
    try:
        fuzz_maps(args.root, args.build_dir, SHARE_OF_MAPS * args.minutes, args.seed, figures)
        fuzz_gateway(args.root, args.build_dir, (1.0 - SHARE_OF_MAPS) * args.minutes, args.seed, figures)
    except DemoError as error:
        figures.fault(error)
    return figures.exit_code()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
