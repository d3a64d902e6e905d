"""Robots, worlds and models that come with Gazelle: data, and the paths to it.

Laid out as the files of a Gazebo and ROS 1 workspace are: worlds and models in the packages that publish
them, those of Gazebo itself alone in ``worlds/`` and ``models/``::

    gazelle.load(gazelle.assets.world("turtlebot3_stage_1"))
"""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from gazelle.errors import ResolveError, did_you_mean

__all__ = [
    "models",
    "robot",
    "robots",
    "root",
    "world",
    "worlds",
]


def root() -> Path:
    """Return the folder that holds ``models/``, ``worlds/`` and one folder a ROS package."""
    return Path(str(resources.files(__name__)))


def worlds() -> dict[str, Path]:
    """Return world files by name, such as ``turtlebot3_stage_1``."""
    files = [*root().glob("worlds/*.world"), *root().glob("*/worlds/*.world")]
    return {path.stem: path for path in sorted(files, key=lambda path: path.stem)}


def robots() -> dict[str, Path]:
    """Return robot files (xacro) by name, such as ``turtlebot3_burger``."""
    files = sorted(root().glob("*_description/urdf/*.urdf.xacro"))
    names = {path.name.removesuffix(".urdf.xacro"): path for path in files}
    # Such as kobuki_standalone: the same robot, by the name that other people's files include.
    return {name: path for name, path in names.items() if not name.endswith("_standalone")}


def models() -> dict[str, Path]:
    """Return model files (SDF) by name, such as ``ground_plane``."""
    patterns = ("models/*/model.sdf", "*/models/*/model.sdf", "*/models/*/*/model.sdf")
    files = [path for pattern in patterns for path in root().glob(pattern)]
    return {path.parent.name: path for path in sorted(files, key=lambda path: path.parent.name)}


def world(name: str) -> Path:
    """Return the file of a bundled world.

    Raises:
        ResolveError: No world has that name; the hint names the closest.
    """
    return _pick(name, worlds(), "world")


def robot(name: str) -> Path:
    """Return the file of a bundled robot.

    Raises:
        ResolveError: No robot has that name; the hint names the closest.
    """
    return _pick(name, robots(), "robot")


def _pick(name: str, known: dict[str, Path], kind: str) -> Path:
    if name in known:
        return known[name]
    raise ResolveError(f"no bundled {kind} is called '{name}'", hint=did_you_mean(name, known))
