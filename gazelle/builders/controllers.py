"""Files that a robot needs for ros_control: transmissions, the plugin, controllers, a launch file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal
from xml.sax.saxutils import quoteattr

import numpy as np
import yaml

from gazelle import formats
from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.builders import urdf_text
from gazelle.builders.errors import BuildError
from gazelle.builders.robots import add_plugin, add_transmissions
from gazelle.builders.sensors import plugin
from gazelle.description import Joint, Link, Model
from gazelle.kinematics.joint_graph import JointGraph
from gazelle.rotations import conjugate, rotate
from gazelle_ros.base.writing import write_text

Interface = Literal["effort", "position", "velocity"]
Kind = Literal["trajectory", "group", "joint"]

_PLUGIN = "libgazebo_ros_control.so"

# A joint swings back this fast [rad/s], neither over its target nor slower than need be.
_FREQUENCY = 20.0
_NO_LIMIT = 100.0  # What an integral may add where no effort limit says it [N or N m].
_LEAST = 1e-4  # Of an inertia, for gains that are not nothing [kg m²].


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class ControlFiles:
    """Texts for the control of a robot.

    Attributes:
        name: Of the robot.
        urdf: The robot with transmissions and ros_control's plugin.
        controllers: YAML for the parameter server.
        launch: Spawns the robot in an empty world and starts the controllers.
    """

    name: str
    urdf: str
    controllers: str
    launch: str

    def write(self, folder: str | Path) -> list[Path]:
        """Write ``urdf/NAME.urdf``, ``config/NAME_control.yaml`` and ``launch/NAME_control.launch``.

        Raises:
            BuildError: One of them is there already, and nothing is written, or the folder
                cannot be written.
        """
        texts = {
            Path(folder, "urdf", f"{self.name}.urdf"): self.urdf,
            Path(folder, "config", f"{self.name}_control.yaml"): self.controllers,
            Path(folder, "launch", f"{self.name}_control.launch"): self.launch,
        }
        try:
            for path in texts:
                if path.exists():
                    raise BuildError(f"{path} is there already", hint="name another folder")
            for path, text in texts.items():
                path.parent.mkdir(parents=True, exist_ok=True)
                write_text(path, text)
        except OSError as error:
            raise BuildError(f"the files cannot be written: {error.strerror}") from error
        return list(texts)


@checked(BuildError)
def control_files(
    robot: str,
    *,
    interface: Interface = "effort",
    kind: Kind = "trajectory",
    rate: float = 50.0,
) -> ControlFiles:
    """Return files that start a robot under ros_control, here and in Gazebo.

    Each moving joint that follows no other gets a transmission, if it has none. Gains are a first
    guess from the inertia that each joint moves in its initial pose: a critically damped swing
    of 20 rad/s, with an integral that may reach the effort limit.

    Args:
        robot: Text of a URDF.
        interface: Interface of joints without a transmission; that of the others is in it.
        kind: One ``trajectory`` controller for all joints, one ``group`` that takes an array of
            targets, or a controller for each ``joint``.
        rate: At which joint states are published [Hz].

    Raises:
        BuildError: Nothing in it moves, or it is xacro; expand that first.
        FormatError: It cannot be read.
    """
    if urdf_text.is_xacro(robot):
        raise BuildError("the joints of a xacro file are known only after it is expanded")
    name = urdf_text.root_of(robot).attributes.get("name", "robot")
    text = add_transmissions(
        robot, interface=f"hardware_interface/{interface.title()}JointInterface"
    )
    model = formats.load_model_string(text)
    if not any(_PLUGIN in each.filename for each in model.plugins):
        text = add_plugin(text, plugin("gazebo_ros_control", _PLUGIN))
    groups = _groups(model)
    if not groups:
        raise BuildError(f"nothing in '{name}' moves", hint="a joint must not be fixed")
    made = {
        "joint_state_controller": {
            "type": "joint_state_controller/JointStateController", "publish_rate": float(rate)
        }
    }  # fmt: skip
    for word, joints in groups.items():
        made |= _controllers(model, word, joints, kind, alone=len(groups) == 1)
    head = (
        "# The gains are a first guess; tune them, also while they act, by dynamic_reconfigure.\n"
    )
    controllers = head + yaml.safe_dump(made, sort_keys=False, default_flow_style=None)
    return ControlFiles(name, text, controllers, _launch(name, list(made)))


def _groups(model: Model) -> dict[str, list[str]]:
    """Return joints by the word of their command interface."""
    groups: dict[str, list[str]] = {}
    for each in model.transmissions:
        for joint, interfaces in each.joints[:1]:
            word = interfaces[0].split("/")[-1].removesuffix("JointInterface").lower()
            groups.setdefault(word, []).append(joint)
    return groups


def _controllers(
    model: Model, word: str, joints: list[str], kind: Kind, *, alone: bool
) -> dict[str, dict[str, Any]]:
    """Return controllers of joints that are commanded through one interface."""
    prefix = "" if alone else f"{word}_"
    gains = {joint: _gains(model, joint) for joint in joints} if word == "effort" else {}
    if kind == "trajectory":
        parameters: dict[str, Any] = {
            "type": f"{word}_controllers/JointTrajectoryController", "joints": joints
        }  # fmt: skip
        if word == "velocity":
            gains = {joint: {"p": _FREQUENCY} for joint in joints}
        parameters |= {"gains": gains} if gains else {}
        return {f"{prefix}trajectory_controller": parameters}
    what = "Velocity" if word == "velocity" else "Position"
    if kind == "group":
        parameters = {"type": f"{word}_controllers/JointGroup{what}Controller", "joints": joints}
        parameters |= {joint: {"pid": each} for joint, each in gains.items()}
        return {f"{prefix}group_controller": parameters}
    return {
        f"{joint}_controller": {
            "type": f"{word}_controllers/Joint{what}Controller", "joint": joint,
            **({"pid": gains[joint]} if gains else {}),
        }
        for joint in joints
    }  # fmt: skip


def _gains(model: Model, name: str) -> dict[str, float]:
    """Return the PID gains of a joint.

    For a moved inertia I they are p = I w², d = 2 I w, i = p / s, rounded to three digits.
    """
    joint = next(each for each in model.joints if each.name == name)
    inertia = max(_LEAST, _moved_inertia(model, joint))
    limit = joint.axes[0].effort
    p, d = inertia * _FREQUENCY**2, 2.0 * inertia * _FREQUENCY
    most = limit if math.isfinite(limit) else _NO_LIMIT
    return {k: float(f"{v:.3g}") for k, v in (("p", p), ("i", p), ("d", d), ("i_clamp", most))}


def _moved_inertia(model: Model, joint: Joint) -> float:
    """Return the inertia that a joint moves, about its axis, in the initial pose [kg m² or kg]."""
    links = {link.name: link for link in model.links}
    child = links[joint.child]
    placed = child.pose * joint.pose
    axis = rotate(np.array(placed.quaternion), np.array(joint.axes[0].xyz))
    beyond = JointGraph(model.joints).outwards(joint.child)
    moved = [links[each] for each in (joint.child, *(j.child for j in beyond)) if each in links]
    if joint.type == "prismatic":
        return sum(link.inertial.mass for link in moved if link.inertial is not None)
    return sum(_about(link, np.array(placed.position), axis) for link in moved)


def _about(link: Link, point: Floats, axis: Floats) -> float:
    """Return inertia of a link about an axis [kg m²], by Steiner's theorem."""
    inertial = link.inertial
    if inertial is None:
        return 0.0
    centre = link.pose * inertial.pose
    inner = rotate(conjugate(np.array(centre.quaternion)), axis)
    arm = np.cross(axis, np.array(centre.position) - point)
    return float(inner @ inertial.inertia.matrix() @ inner + inertial.mass * (arm @ arm))


def _launch(name: str, controllers: list[str]) -> str:
    urdf, config = f"$(dirname)/../urdf/{name}.urdf", f"$(dirname)/../config/{name}_control.yaml"
    spawn = f"-urdf -model {name} -param robot_description"
    return f"""<?xml version="1.0"?>
<launch>
  <arg name="paused" default="false"/>
  <arg name="gui" default="true"/>

  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="paused" value="$(arg paused)"/>
    <arg name="gui" value="$(arg gui)"/>
  </include>
  <param name="robot_description" textfile={quoteattr(urdf)}/>
  <rosparam command="load" file={quoteattr(config)}/>
  <node pkg="gazebo_ros" type="spawn_model" name="spawn_urdf" args={quoteattr(spawn)}/>
  <node pkg="controller_manager" type="spawner" name="controller_spawner"
        args={quoteattr(" ".join(controllers))}/>
  <node pkg="robot_state_publisher" type="robot_state_publisher" name="robot_state_publisher"/>
</launch>
"""
