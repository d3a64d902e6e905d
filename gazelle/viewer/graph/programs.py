"""The programs of rviz and rqt: each opens the page of the graph, with its panel."""

from __future__ import annotations

import itertools
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import yaml

from gazelle.errors import Error
from gazelle.viewer.graph.view import GraphView
from gazelle_ros.base import bounded_yaml
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.path_texts import existing_file
from gazelle_ros.builtin.arguments import parse_arguments

_PANELS = {
    "rqt_bag": "Bag player",
    "rqt_console": "Console",
    "rqt_controller_manager": "Controller manager",
    "rqt_graph": "Node graph",
    "rqt_image_view": "Image view",
    "rqt_joint_trajectory_controller": "Joint trajectory",
    "rqt_logger_level": "Logger levels",
    "rqt_plot": "Plot",
    "rqt_publisher": "Publisher",
    "rqt_reconfigure": "Reconfigure",
    "rqt_robot_steering": "Robot steering",
    "rqt_service_caller": "Service caller",
    "rqt_tf_tree": "tf tree",
    "rqt_topic": "Topic monitor",
}
_LOOK_S = 0.2
_FRAME_OPTIONS = frozenset(["-f", "--fixed-frame"])
_FILE_OPTIONS = frozenset(["-d", "--display-config"])

WINDOWS = {
    "rviz": {"rviz": f"{__name__}:rviz"},
    "rqt_gui": {"rqt_gui": f"{__name__}:rqt_gui"},
    **{package: {package: f"{__name__}:{package}"} for package in _PANELS},
}
"""Programs by package."""


def rviz(arguments: Sequence[str]) -> int:
    """Open the page, with the fixed frame of the command line or of its file; the exit code is 0.

    Raises:
        Error: The file cannot be read.
    """
    frame = None
    for option, value in itertools.pairwise(arguments):
        if option in _FRAME_OPTIONS:
            frame = value
        elif option in _FILE_OPTIONS and frame is None:
            frame = fixed_frame_of(existing_file(value))
    return _open("", arguments, frame)


def rqt_gui(arguments: Sequence[str]) -> int:
    """Open the page, with the panel that ``--standalone`` names; the exit code is 0."""
    chosen = "".join(
        value for option, value in itertools.pairwise(arguments) if option in {"-s", "--standalone"}
    )
    package = chosen.partition("/")[0].partition(".")[0]
    return _open(_PANELS.get(package, ""), ())


def fixed_frame_of(file: Path) -> str | None:
    """Return the fixed frame of a configuration of RViz; None where it has none.

    Raises:
        Error: It is not valid YAML.
    """
    try:
        found = bounded_yaml.safe_load(file.read_text(encoding="utf-8", errors="replace"))
    except yaml.YAMLError as error:
        raise Error(f"{file} is not a configuration of RViz: {error}") from error
    for key in ("Visualization Manager", "Global Options", "Fixed Frame"):
        found = found.get(key) if isinstance(found, dict) else None
    return found if isinstance(found, str) else None


def __getattr__(name: str) -> Callable[[Sequence[str]], int]:
    """Return the function of a program of rqt."""
    if name in _PANELS:
        return partial(_open, _PANELS[name])
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


def _open(title: str, arguments: Sequence[str], frame: str | None = None) -> int:
    """Serve the page until it is ended."""
    found = parse_arguments(arguments, "gazelle_view")
    master: Any = found.options.get("master_uri")
    with stopping() as stop, GraphView(master, frame=frame) as view:
        if title:
            view.open_panel(title, found.plain)
        sys.stderr.write(f"view {view.url}\n")
        while not stop.is_set() and not view.ended:
            stop.wait(_LOOK_S)
    return 0
