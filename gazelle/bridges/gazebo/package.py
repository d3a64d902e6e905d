"""The package ``gazebo_ros`` where it is not installed: its nodes and launch files."""

from __future__ import annotations

from gazelle import assets
from gazelle.ros.builtin.registry import BuiltinPackage

_SERVER = "gazelle.bridges.gazebo.server:main"

GAZEBO_ROS = BuiltinPackage(
    "gazebo_ros",
    {
        "gzserver": _SERVER,
        "gazebo": _SERVER,
        "debug": _SERVER,
        "perf": _SERVER,
        "gz": "gazelle.clients.gz:main",
        "gzclient": "gazelle.bridges.gazebo.window:main",
        "spawn_model": "gazelle.clients.spawn_model:main",
    },
    folder=assets.root() / "gazebo_ros",
    # Scripts end the simulator by "killall gzserver", however it was started.
    process_names=dict.fromkeys(("gazebo", "debug", "perf"), "gzserver"),
)
