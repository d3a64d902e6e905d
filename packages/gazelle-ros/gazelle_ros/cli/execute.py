"""Run a Python script written for ROS 1, with no ROS installed.

  gazelle exec talker.py
  gazelle exec talker.py chatter:=/robot/chatter _rate:=5 __name:=robot_talker
  gazelle exec --sim-sleep train.py
  gazelle exec my_package talker.py

rospy, tf, actionlib, std_msgs.msg and others are Gazelle's own modules; an
installed ROS is not used. Messages and Python code of packages on
ROS_PACKAGE_PATH can be imported. Instead of a script, give a package and a
program in it, as with rosrun, or a ROS command: 'gazelle exec rostopic list'.
"""  # this is the text of --help

from __future__ import annotations

import argparse


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "--sim-sleep",
        action="store_true",
        help="let the script's time.sleep wait for simulated time when /use_sim_time is set",
    )
    parser.add_argument("script", metavar="SCRIPT", help="the script, or a package")
    parser.add_argument(
        "arguments",
        metavar="ARGS",
        nargs=argparse.REMAINDER,
        help="its arguments and remappings; after a package, the program first",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle_ros.compat.script import run_named, runs_tool

    if runs_tool(args.script, args.arguments):
        from gazelle_ros.cli.main import inherited, main

        return main([args.script, *args.arguments], inherited())
    return run_named(args.script, args.arguments, sim_sleep=args.sim_sleep, debug=args.debug)
