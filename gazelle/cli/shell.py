"""Open a shell with Gazelle's roscore, rostopic, rosrun, roslaunch and others.

  gazelle shell
  gazelle shell -c 'rostopic list'

The others are rosbag, rosnode, rosparam, rosservice, rosmsg, rospack, xacro,
gzserver, and a python that can import rospy. Leave the shell with 'exit' or
Ctrl-D; nothing outside it is changed.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import os
import shlex
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from gazelle.cli.completion import script_for
from gazelle.errors import Error
from gazelle_ros.base.child_processes import become, child_process
from gazelle_ros.base.writing import write_text

_RC = """{user}
PATH={path}
export PATH
{completion}
PS1="(gazelle) $PS1"
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "-c", dest="command", metavar="COMMAND", help="run this command in the shell, then exit"
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle_ros.builtin.on_path import offer

    env = dict(os.environ)
    if offer(env) is None:
        raise Error(
            "the commands of ROS cannot be put on PATH here",
            hint="set XDG_CACHE_HOME to a folder that you may write to; on Windows there is none",
        )
    env["GAZELLE_SHELL"] = "1"
    shell = env.get("SHELL") or "/bin/sh"
    if args.command is not None:
        return become([shell, "-c", args.command], env)
    with tempfile.TemporaryDirectory(prefix="gazelle-shell-") as folder:
        command = _interactive(shell, env, Path(folder))
        sys.stdout.write(
            "roscore, rostopic, rosrun, roslaunch ... are Gazelle's; leave with 'exit'\n"
        )
        sys.stdout.flush()
        with child_process(command, env=env) as process:
            return process.wait()


def _interactive(shell: str, env: dict[str, str], folder: Path) -> list[str]:
    """Return the command line of a shell that reads the user's settings first, then ours."""
    name = Path(shell).name
    if name == "bash":
        _write(folder / "rc", name, "[ -f ~/.bashrc ] && . ~/.bashrc", env)
        return [shell, "--rcfile", str(folder / "rc"), "-i"]
    if name == "zsh":
        home = shlex.quote(env.get("ZDOTDIR") or str(Path.home()))
        _write(
            folder / ".zshrc", name, f"ZDOTDIR={home}\n[ -f {home}/.zshrc ] && . {home}/.zshrc", env
        )
        env["ZDOTDIR"] = str(folder)
        return [shell, "-i"]
    return [shell]


def _write(file: Path, name: str, user: str, env: Mapping[str, str]) -> None:
    path = f"{shlex.quote(env['PATH'].partition(os.pathsep)[0])}{os.pathsep}$PATH"
    text = _RC.format(user=user, path=path, completion=script_for(name))
    write_text(file, text)
