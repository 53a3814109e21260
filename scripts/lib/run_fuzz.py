# SPDX-License-Identifier: Apache-2.0
"""What scripts/fuzz runs: run_fuzz.py ROOT BUILD_DIR [--minutes N] [--seed N]."""
import argparse
import glob
import os
import random
import subprocess
import sys
import threading
import time

from benchmark_programs import executable
from campaign import DemoError, Figures, Gateway, MemoryWatch
from run_soak import QUIET

MOST_MEMORY = 500.0  # beyond that at the beginning [MB]
LATEST_ANSWER = 5.0  # [s]
SHARE_OF_MAPS = 0.33
CLIENTS = 3
MOTION_SERVICES = ("free_space", "lane_follow", "path_follow", "precise_parking", "valet_parking", "zone_cover")


def fuzz_maps(root, build_dir, minutes, seed, figures):
    files = sorted(glob.glob(os.path.join(root, "test", "fuzz", "corpus", "*.txt")) +
                   glob.glob(os.path.join(root, "maps", "*", "base_map.bin")))
    result = subprocess.run([executable(build_dir, "map_fuzzer"), str(minutes), str(seed), *files],
                            stdout=subprocess.PIPE, universal_newlines=True, check=False)
    print(result.stdout, end="", flush=True)
    if result.returncode != 0:
        figures.fault("map_fuzzer ended with exit code %d" % result.returncode)


def fuzz_grids(seed, end, findings):
    """Obstacle grids whose sizes lie, of noise, and with walls one cell wide, until `end`; they are planned with."""
    import rospy
    from nav_msgs.msg import OccupancyGrid
    import fuzz_bytes
    from external_command.client import CommandClient, ServiceUnavailable
    chance = random.Random(seed)
    publisher = rospy.Publisher("/apollo/grid", OccupancyGrid, queue_size=1)
    client = CommandClient("apollo")
    numbers = [0.0, -1.0, 1e-9, 1e9, float("nan"), float("inf")]
    while time.monotonic() < end:
        grid = OccupancyGrid()
        grid.header.frame_id = chance.choice(["map", "map", "map", "", "nowhere"])
        grid.info.resolution = chance.choice([0.1, 0.2, 0.5] * 3 + numbers)
        grid.info.width, grid.info.height = chance.choice([(200, 200), (400, 300), (1, 1), (0, 0), (1000, 10)])
        grid.info.origin.position.x, grid.info.origin.position.y = 70.0, 170.0
        grid.info.origin.orientation.w = chance.choice([1.0, 1.0, 1.0, 0.0, float("nan")])
        cells = grid.info.width * grid.info.height
        filled = chance.choice([0.0, 0.001, 0.02, 0.5, 1.0])
        grid.data = [100 if chance.random() < filled else 0 for _ in range(cells)]
        for _ in range(chance.randrange(4)):  # walls
            row = chance.randrange(max(1, grid.info.height))
            for column in range(0, grid.info.width, chance.choice([1, 1, 2])):
                grid.data[row * grid.info.width + column] = 100
        if chance.random() < 0.2:
            grid.info.width = chance.choice([0, 1, 2 ** 32 - 1, 2 ** 16])
        publisher.publish(grid)
        service = chance.choice(["zone_cover", "free_space"])
        begin = time.monotonic()
        try:
            status = client.call(service, fuzz_bytes.example(service)).status
            findings.note(service + " with a grid", status.error_code, time.monotonic() - begin)
            if time.monotonic() - begin > LATEST_ANSWER:
                findings.add("%s answered late, with a grid" % service, status.message)
        except ServiceUnavailable as error:
            findings.add("%s gave no answer, with a grid" % service, error)


def fuzz_zone_files(seed, end, folder, findings):
    """Damages the files of zones, and resumes these, until `end`."""
    import fuzz_bytes
    from external_command.client import CommandClient, ServiceUnavailable
    chance = random.Random(seed)
    client = CommandClient("apollo")
    command = fuzz_bytes.example("zone_cover")
    while time.monotonic() < end:
        files = glob.glob(os.path.join(folder, "*.zone"))
        command.resume = bool(files)
        command.dry_run = False
        begin = time.monotonic()
        try:
            status = client.call("zone_cover", command).status
            findings.note("zone_cover with a zone file", status.error_code, time.monotonic() - begin)
        except ServiceUnavailable as error:
            findings.add("zone_cover gave no answer, with a zone file", error)
        for path in files:
            try:
                with open(path, "rb") as file:
                    content = file.read()
                with open(path, "wb") as file:
                    file.write(fuzz_bytes.damaged(content, chance))
            except OSError:
                pass  # it was replaced just now
        time.sleep(0.2)


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
        import fuzz_requests
        from actionlib_msgs.msg import GoalID
        from external_command import msg
        from geometry_msgs.msg import TransformStamped
        from nav_msgs.msg import OccupancyGrid
        from tf2_msgs.msg import TFMessage
        end = time.monotonic() + 60.0 * minutes
        findings = fuzz_requests.Findings()
        topics = {"/apollo/planning/command_status": msg.CommandStatus(message="a report"),
                  "/apollo/planning/state": msg.PlanningState(scenario="LANE_FOLLOW"),
                  "/apollo/canbus/chassis": msg.Chassis(vin="a vin"),
                  "/apollo/grid": OccupancyGrid(data=[0] * 100),
                  "/tf": TFMessage(transforms=[TransformStamped()])}
        for service in MOTION_SERVICES:
            topics["/apollo/external_command/%s/goal" % service] = fuzz_bytes.example_goal(service)
            topics["/apollo/external_command/%s/cancel" % service] = GoalID(id="a goal")
        requests = subprocess.Popen(
            [sys.executable, os.path.join(root, "scripts", "lib", "fuzz_requests.py"), "--seed", str(seed),
             "--duration", str(60.0 * minutes), "--threads", "4", "--stop-limit", "5"])
        jobs = [(fuzz_bytes.shoot_bytes, (seed + i, end, findings)) for i in range(CLIENTS)]
        jobs += [(fuzz_bytes.shake_hands_badly, (seed, end, findings)),
                 (fuzz_bytes.call_damaged, (seed, end, findings)),
                 (fuzz_bytes.publish_bytes, (seed, end, topics, findings)),
                 (fuzz_grids, (seed, end, findings)),
                 (fuzz_zone_files, (seed, end, gateway.folder, findings)),
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
        figures.show("slowest answer to them", max(findings.slowest.values()), "s", LATEST_ANSWER)
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
