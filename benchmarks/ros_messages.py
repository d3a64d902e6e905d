"""Microseconds to serialise and to deserialise messages: Gazelle's, genpy's and rosbags' classes.

genpy is measured where it can be imported (Debian: python3-genpy and python3-*-msgs), rosbags where
it is installed. The bytes of all are compared first. Each figure is the best of several rounds, and
the rounds of the three take turns, so that load hits all alike.
"""

from __future__ import annotations

import argparse
import importlib
import io
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from gazelle_ros.messages import load_message

_DEBIAN = Path("/usr/lib/python3/dist-packages")
_JOINTS = [f"joint_{index}" for index in range(12)]
_PIXELS = bytes(range(256)) * 3600
_RANGES = np.linspace(0.1, 9.0, 720).astype(np.float32)


def main(argv: list[str] | None = None) -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(prog="gazelle bench ros_messages", description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--seconds", type=float, default=0.02, help="length of a round")
    options = parser.parse_args(argv)
    print(f"{'us a message':26}{'bytes':>8} {'gazelle':>9}{'genpy':>9}{'rosbags':>9}{'numpy':>9}")
    for name, fill in CASES.items():
        show(name, fill, options)


def show(name: str, fill: Callable[[Callable[[str], Any]], Any], options: Any) -> None:
    """Measure one case, and print a line for each direction."""
    message = fill(load_message)
    type_ = message._type
    data = dumps(message)
    made = type(message)
    writers = {"gazelle": lambda: dumps(message)}
    readers: dict[str, Callable[[], Any]] = {
        "gazelle": lambda: made().deserialize(data),
        "numpy": lambda: made().deserialize(data, numpy=True),
    }
    theirs = genpy_message(fill)
    if theirs is not None:
        if dumps(theirs) != data:
            raise SystemExit(f"{name}: genpy's bytes differ")
        other = type(theirs)
        writers["genpy"] = lambda: dumps(theirs)
        readers["genpy"] = lambda: other().deserialize(data)
    store = rosbags_store(type_)
    if store is not None:
        full = type_.replace("/", "/msg/")
        value = store.deserialize_ros1(data, full)
        if bytes(store.serialize_ros1(value, full)) != data:
            raise SystemExit(f"{name}: rosbags' bytes differ")
        writers["rosbags"] = lambda: store.serialize_ros1(value, full)
        readers["rosbags"] = lambda: store.deserialize_ros1(data, full)
    for label, functions in (("serialise", writers), ("deserialise", readers)):
        best = measure(functions, options.rounds, options.seconds)
        cells = "".join(
            f"{best[who] * 1e6:9.2f}" if who in best else f"{'-':>9}"
            for who in ("gazelle", "genpy", "rosbags", "numpy")
        )
        print(f"{name:14} {label:11}{len(data):8} {cells}")


def measure(
    functions: dict[str, Callable[[], Any]], rounds: int, seconds: float
) -> dict[str, float]:
    """Return best seconds a call of each function, in turns."""
    best = dict.fromkeys(functions, float("inf"))
    counts = {}
    for who, function in functions.items():
        begin = time.perf_counter()
        for _ in range(5):
            function()
        counts[who] = max(5, int(seconds / max(1e-7, (time.perf_counter() - begin) / 5)))
    for _ in range(rounds):
        for who, function in functions.items():
            repeats = range(counts[who])
            begin = time.perf_counter()
            for _ in repeats:
                function()
            best[who] = min(best[who], (time.perf_counter() - begin) / counts[who])
    return best


def dumps(message: Any) -> bytes:
    """Return the bytes of a message of Gazelle's or genpy's."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def genpy_message(fill: Callable[[Callable[[str], Any]], Any]) -> Any:
    """Return the same message of genpy's classes; None where they are not installed."""
    if _DEBIAN.is_dir() and str(_DEBIAN) not in sys.path:
        sys.path.append(str(_DEBIAN))

    def load(type_: str) -> Any:
        package, _, name = type_.partition("/")
        module: ModuleType = importlib.import_module(f"{package}.msg")
        return getattr(module, name)

    try:
        return fill(load)
    except ImportError:
        return None


def rosbags_store(type_: str) -> Any:
    """Return rosbags' type store with this type in it; None where rosbags is not installed."""
    try:
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    except ImportError:
        return None
    store = get_typestore(Stores.ROS1_NOETIC)
    full = type_.replace("/", "/msg/")
    if full not in store.types:
        text = load_message(type_)._full_text
        store.register(get_types_from_msg(text, full))
    return store


def _stamp(message: Any) -> Any:
    message.header.seq, message.header.frame_id = 7, "base_link"
    message.header.stamp.secs, message.header.stamp.nsecs = 1234, 5678
    return message


def _twist(load: Callable[[str], Any]) -> Any:
    message = load("geometry_msgs/Twist")()
    message.linear.x, message.angular.z = 0.5, -1.0
    return message


def _scan(load: Callable[[str], Any]) -> Any:
    return _stamp(load("sensor_msgs/LaserScan")(angle_max=3.0, ranges=_RANGES.tolist()))


def _image(load: Callable[[str], Any]) -> Any:
    image = load("sensor_msgs/Image")(height=480, width=640, encoding="rgb8", data=_PIXELS)
    return _stamp(image)


def _joints(load: Callable[[str], Any]) -> Any:
    ones = [1.0] * 12
    joints = load("sensor_msgs/JointState")
    return _stamp(joints(name=_JOINTS, position=ones, velocity=ones, effort=ones))


def _frames(load: Callable[[str], Any]) -> Any:
    frames = [_stamp(load("geometry_msgs/TransformStamped")()) for _ in range(10)]
    for index, frame in enumerate(frames):
        frame.child_frame_id = f"link_{index}"
    return load("tf2_msgs/TFMessage")(transforms=frames)


CASES: dict[str, Callable[[Callable[[str], Any]], Any]] = {
    "String(20)": lambda load: load("std_msgs/String")(data="x" * 20),
    "Twist": _twist,
    "Odometry": lambda load: _stamp(load("nav_msgs/Odometry")()),
    "JointState(12)": _joints,
    "TFMessage(10)": _frames,
    "LaserScan(720)": _scan,
    "Image 640x480": _image,
}

if __name__ == "__main__":
    main()
