# SPDX-License-Identifier: Apache-2.0
"""The main job, end to end: a simulated vehicle drives across a map by a lane-follow command, seen in rviz.

Starts a ROS master of its own on a free port, the command component, a simulated vehicle and rviz (on an invisible
display where there is none), sends the command, prints progress until it has FINISHED, and leaves a picture of rviz.
"""
import argparse
import os
import shlex
import signal
import sys

import owned_processes
from demo_stack import DemoError, Stack

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
DEMO_MAP = os.path.join(ROOT, "maps/demo_town/base_map.bin")  # around (0, 0): needs no origin
RVIZ_CONFIG = os.path.join(ROOT, "rviz/external_command.rviz")
DEMO_ROUTE = ([90.0, 195.0, 0.0], [510.0, 205.0])  # from west to east: a lane change, a roundabout, bends


def numbers(count, what):
    """A reader of `count` numbers with commas between them, for argparse."""
    def read(text):
        values = [float(word) for word in text.split(",")]
        if len(values) != count:
            raise argparse.ArgumentTypeError(f"{text!r} must be {what}")
        return values
    read.__name__ = what  # argparse names it where a word is no number
    return read


def join_coordinates(words):
    """`--to -1,2` as `--to=-1,2`: argparse takes a word that begins with a minus for an option."""
    joined = []
    for word in words:
        if joined and joined[-1] in ("--from", "--to"):
            joined[-1] += "=" + word
        else:
            joined.append(word)
    return joined


def parse_arguments(words):
    parser = argparse.ArgumentParser(prog="scripts/demo", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_dir", type=os.path.abspath, help=argparse.SUPPRESS)
    parser.add_argument("--map", type=os.path.abspath, default=DEMO_MAP,
                        help="Apollo's base_map or sim_map, .bin or .txt; default: the demo map")
    parser.add_argument("--from", dest="start", type=numbers(3, "X,Y,HEADING"), metavar="X,Y,HEADING",
                        help="where the vehicle stands [m, m, rad], in the map file's coordinates")
    parser.add_argument("--to", dest="goal", type=numbers(2, "X,Y"), metavar="X,Y", help="where it drives to [m]; "
                        "without --from and --to, a long route of the map")
    parser.add_argument("--speed-up", type=float, default=4.0, metavar="N", help="simulated seconds per second; 4")
    parser.add_argument("--picture", type=os.path.abspath, metavar="FILE",
                        help="where the picture of rviz goes; default: demo.png in the build folder")
    parser.add_argument("--no-rviz", action="store_true", help="no rviz, no picture")
    parser.add_argument("--tour", action="store_true", help="instead of one drive, every example of README.md, one after "
                        "the other, some minutes; rviz goes with the vehicle, a picture of each motion is left")
    parser.add_argument("--keep", action="store_true", help="leave everything running, and tell how to speak to it")
    parser.add_argument("--stop", action="store_true", help="end what --keep left running, and nothing else")
    parser.add_argument("--check", action="store_true", help=argparse.SUPPRESS)  # only the words
    args = parser.parse_args(join_coordinates(words))
    if (args.start is None) != (args.goal is None):
        parser.error("--from and --to go together")
    if not args.speed_up > 0.0:
        parser.error(f"--speed-up is {args.speed_up}; it must be above 0")
    if not args.stop and not os.path.isfile(args.map):
        parser.error(f"there is no map file {args.map}")
    if args.tour and (args.map != DEMO_MAP or args.start):
        parser.error("--tour drives on the demo map, from where its examples begin; leave out --map, --from and --to")
    if args.map == DEMO_MAP and not args.start:
        args.start, args.goal = DEMO_ROUTE
    args.picture = args.picture or os.path.join(args.build_dir, "demo.png")
    return args


def kept_file(build_dir):
    return os.path.join(build_dir, "demo_kept")


def stop_kept(build_dir):
    try:
        with open(kept_file(build_dir), encoding="utf-8") as file:
            marks = file.read().split()
    except FileNotFoundError:
        marks = []
    for mark in marks:
        owned_processes.end_all(mark)
    if marks:
        os.remove(kept_file(build_dir))
    print(f"ended {len(marks)} demo(s) that --keep had left running")


def keep(stack, build_dir, drive):
    with open(kept_file(build_dir), "a", encoding="utf-8") as file:
        file.write(stack.mark + "\n")
    back = f"x: {drive.start.x:.1f}, y: {drive.start.y:.1f}"
    print(f"""
Everything is left running. To speak to it:
  export ROS_MASTER_URI={stack.master_uri} ROS_HOSTNAME=localhost
  source {shlex.quote(build_dir + "/devel/setup.bash")}
  rosservice list /apollo/external_command
  rosservice call /apollo/external_command/lane_follow "command: {{end_pose: {{{back}}}}}"   # back to the start
README.md has an example of each service. To end it: scripts/demo --stop""")


def run(args, stack):
    """Returns whether all commands have FINISHED, with a picture where one was wanted."""
    stack.launch("demo.launch", map=args.map, map_origin="none" if args.map == DEMO_MAP else "auto",
                 real_time_factor=args.speed_up, rviz="false")
    print(f"ROS master: export ROS_MASTER_URI={stack.master_uri}", flush=True)
    from demo_drive import Drive  # rospy reads ROS_MASTER_URI when it is first imported

    drive = Drive(stack)
    drive.connect()
    succeeded = go_on_tour(args, stack, drive) if args.tour else go_once(args, stack, drive)
    if args.keep:
        keep(stack, args.build_dir, drive)
    return succeeded


def go_once(args, stack, drive):
    start, goal = drive.choose(args.start, args.goal)
    drive.place(start)
    camera = None
    if not args.no_rviz:
        from demo_camera import Camera
        camera = Camera(stack, args.picture)
        camera.open(RVIZ_CONFIG, drive.extent, drive.length)
    finished = drive.go(goal, camera)
    if camera:
        print(f"picture: {args.picture}" if camera.has_picture else f"no picture: {camera.problem}")
    return finished and (camera is None or camera.has_picture)


def go_on_tour(args, stack, drive):
    from demo_tour import Tour, Walk, read_examples
    drive.place(drive.in_map(args.start))
    walk = None
    if not args.no_rviz:
        from demo_camera import Camera
        camera = Camera(stack, args.picture)
        camera.follow(RVIZ_CONFIG)
        walk = Walk(camera, args.build_dir)
    return Tour(stack, drive.command_status, walk).go(read_examples(os.path.join(ROOT, "README.md")))


def main():
    args = parse_arguments(sys.argv[1:])
    if args.stop:
        stop_kept(args.build_dir)
        return 0
    if args.check:
        return 0
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it in background jobs, for children too
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: sys.exit(143))
    stack = Stack(args.build_dir)
    is_kept = False
    try:
        succeeded = run(args, stack)
        is_kept = args.keep
        return 0 if succeeded else 1
    except DemoError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    finally:
        if not is_kept:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second Ctrl-C must not leave anything behind
            stack.end()


if __name__ == "__main__":
    sys.exit(main())
