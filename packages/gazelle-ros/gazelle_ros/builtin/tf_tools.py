"""``tf_echo``, ``tf_monitor`` and ``view_frames`` of tf: look at the tree of frames."""

from __future__ import annotations

import math
import shutil
import subprocess
from collections.abc import Sequence
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.output import say_line
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.base.writing import write_text
from gazelle_ros.builtin.tf_delays import Delays
from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.rostime import Duration, Time
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.tf2_ros import Buffer, TransformException, TransformListener
from gazelle_ros.names import split_arguments
from gazelle_ros.tf.describe import as_dot
from gazelle_ros.transformations import euler_from_quaternion

_ECHO_USAGE = "tf_echo SOURCE_FRAME TARGET_FRAME [HZ]"
_PATIENCE_S = 1.0
_LISTEN_S = 5.0


def echo(arguments: Sequence[str]) -> int:
    """Print the transform from one frame to another again and again; returns the exit code.

    Raises:
        RosError: The command line is wrong.
    """
    words = split_arguments(arguments)[0]
    if len(words) not in {2, 3}:
        raise RosError("tf_echo takes two frames", hint=_ECHO_USAGE)
    period = 1.0 / positive("the rate", words[2], _ECHO_USAGE) if len(words) == 3 else 1.0
    _begin("tf_echo", arguments)
    buffer = Buffer()
    listener = TransformListener(buffer)
    _wait_for(buffer, words[0], words[1])
    while not process.shutdown.is_set():
        say_line(_described(buffer, words[0], words[1]))
        process.shutdown.wait(period)
    listener.unregister()
    return 0


def monitor(arguments: Sequence[str]) -> int:
    """Print how old frames are when they come, and how often; returns the exit code.

    With two frames only those on the way between them are watched.

    Raises:
        RosError: The command line is wrong.
    """
    words = split_arguments(arguments)[0]
    if len(words) not in {0, 2}:
        raise RosError("tf_monitor takes no frame or two", hint="tf_monitor [SOURCE TARGET]")
    _begin("tf_monitor", arguments)
    buffer = Buffer()
    listener = TransformListener(buffer)
    if words:
        say_line(f"waiting for a way between {words[0]} and {words[1]}")
        while not _connected(buffer, *words) and not process.shutdown.wait(0.1):
            pass
    delays = Delays(buffer, words)
    while not process.shutdown.wait(_PATIENCE_S):
        say_line(delays.report())
    delays.close()
    listener.unregister()
    return 0


def frames(arguments: Sequence[str]) -> int:
    """Draw the tree of frames as frames.gv and frames.pdf; returns the exit code.

    Raises:
        RosError: The command line is wrong, or graphviz fails.
    """
    if split_arguments(arguments)[0]:
        raise RosError("view_frames takes no arguments")
    _begin("view_frames", arguments)
    buffer = Buffer()
    listener = TransformListener(buffer)
    say_line(f"listening to /tf for {_LISTEN_S:g} s")
    if process.shutdown.wait(_LISTEN_S):
        return 0
    listener.unregister()
    write_text("frames.gv", as_dot(buffer.tree, rospy.get_rostime().to_nsec()))
    program = shutil.which("dot")
    if program is None:
        say_line("frames.gv is written; with 'dot' of graphviz there would be a frames.pdf, too")
        return 0
    done = subprocess.run(  # noqa: S603  # graphviz
        [program, "-Tpdf", "frames.gv", "-o", "frames.pdf"],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise RosError(f"dot failed: {done.stderr.strip()}", file="frames.gv")
    say_line("frames.gv and frames.pdf are written")
    return 0


def _begin(name: str, arguments: Sequence[str]) -> None:
    """Join the graph."""
    rospy.init_node(name, [name, *arguments], anonymous=True)


def _connected(buffer: Any, source: str, target: str) -> bool:
    return bool(buffer.can_transform(source, target, Time(0)))


def _wait_for(buffer: Any, source: str, target: str) -> None:
    """Wait for the first transforms in wall time, as the world's may stand still."""
    for _ in range(20):
        if _connected(buffer, source, target) or process.shutdown.wait(_PATIENCE_S / 20):
            return


def _described(buffer: Any, source: str, target: str) -> str:
    try:
        found = buffer.lookup_transform(source, target, Time(0), Duration(0))
    except TransformException as error:
        return (
            f"Failure at {rospy.get_time():.9f}\nException thrown:{error}\n"
            f"The current list of frames is:\n{buffer.all_frames_as_string()}"
        )
    place, turn = found.transform.translation, found.transform.rotation
    angles = euler_from_quaternion((turn.x, turn.y, turn.z, turn.w))
    return (
        f"At time {found.header.stamp.to_sec():.3f}\n"
        f"- Translation: {_row(place.x, place.y, place.z)}\n"
        f"- Rotation: in Quaternion {_row(turn.x, turn.y, turn.z, turn.w)}\n"
        f"            in RPY (radian) {_row(*angles)}\n"
        f"            in RPY (degree) {_row(*(math.degrees(each) for each in angles))}"
    )


def _row(*values: float) -> str:
    return "[" + ", ".join(f"{value:.3f}" for value in values) + "]"
