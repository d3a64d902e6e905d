"""A Gazebo on a ROS 1 graph, Gazelle's or a real one: steer it, fill it, ask it."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from gazelle.clients.calls import Caller
from gazelle.clients.descriptions import find_file, read_urdf
from gazelle.clients.errors import ClientError
from gazelle.clients.poses import ModelState, pose_message, read_state, twist_message
from gazelle.clients.states import LiveStates
from gazelle.ros import Duration, Node, Time, WallClock, load_message

Vector = tuple[float, float, float]
_FOREVER = Duration(-1, 0)


@dataclass(frozen=True, slots=True)
class PhysicsSettings:
    """How the physics of a world runs.

    Attributes:
        time_step: Between two steps [s].
        max_update_rate: Steps a second of wall time to aim at [Hz]; 0 for as many as possible.
        gravity: [m/s²].
        paused: Whether time stands still.
        ode: ODE's settings, a ``gazebo_msgs/ODEPhysics``.
    """

    time_step: float
    max_update_rate: float
    gravity: Vector
    paused: bool
    ode: Any


class Gazebo:
    """Calls the services of ``gazebo_ros``; also a context manager.

    Args:
        node: Calls; a node of its own is made if None.
        namespace: Where the services are.
        master_uri: For its own node; by default ``ROS_MASTER_URI``.
        timeout: For services to be there and for answers [s of wall time].
        retries: How often calls that break off are made again.

    Raises:
        MasterUnreachableError: There is no master.
    """

    def __init__(
        self,
        node: Node | None = None,
        *,
        namespace: str = "/gazebo",
        master_uri: str | None = None,
        timeout: float = 30.0,
        retries: int = 2,
    ) -> None:
        self._owned = node is None
        self.node = node or Node(
            "gazebo_client", master_uri=master_uri, anonymous=True, clock=WallClock()
        )
        self._caller = Caller(self.node, namespace, timeout, retries)

    # -- time --------------------------------------------------------------------------------

    def pause(self) -> None:
        """Let time stand still."""
        self._caller.call("pause_physics", "std_srvs/Empty")

    def unpause(self) -> None:
        """Let time go on."""
        self._caller.call("unpause_physics", "std_srvs/Empty")

    def reset_simulation(self) -> None:
        """Put everything back, time too."""
        self._caller.call("reset_simulation", "std_srvs/Empty")

    def reset_world(self) -> None:
        """Put the models back; time goes on."""
        self._caller.call("reset_world", "std_srvs/Empty")

    def step(self, steps: int = 1) -> float:
        """Make steps of a paused world; Gazelle only. Returns the time then [s].

        Raises:
            ClientError: The world is not paused, or this is no Gazelle.
        """
        answer = self._caller.demand("/gazelle/step", "gazelle_msgs/Step", steps=steps)
        return float(answer.time.to_sec())

    @property
    def time(self) -> float:
        """The simulated time [s]."""
        return float(self._world().sim_time)

    @property
    def models(self) -> list[str]:
        """The names of all models."""
        return list(self._world().model_names)

    def _world(self) -> Any:
        return self._caller.demand("get_world_properties", "gazebo_msgs/GetWorldProperties")

    # -- physics -----------------------------------------------------------------------------

    @property
    def physics(self) -> PhysicsSettings:
        """How the physics runs."""
        found = self._caller.demand("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
        gravity = (found.gravity.x, found.gravity.y, found.gravity.z)
        return PhysicsSettings(
            found.time_step, found.max_update_rate, gravity, found.pause, found.ode_config
        )

    def set_physics(
        self,
        *,
        time_step: float | None = None,
        max_update_rate: float | None = None,
        gravity: Vector | None = None,
        **ode: Any,
    ) -> None:
        """Change how the physics runs; what is None stays.

        Args:
            time_step: [s].
            max_update_rate: [Hz]; 0 for as fast as possible.
            gravity: [m/s²].
            ode: Fields of ``gazebo_msgs/ODEPhysics``, such as ``sor_pgs_iters=100``.

        Raises:
            ClientError: There is no such field, or Gazebo refuses.
        """
        now = self.physics
        for name, value in ode.items():
            if name not in now.ode.__slots__:
                raise ClientError(f"ODEPhysics has no field '{name}'")
            setattr(now.ode, name, value)
        x, y, z = gravity or now.gravity
        self._caller.demand(
            "set_physics_properties",
            "gazebo_msgs/SetPhysicsProperties",
            time_step=now.time_step if time_step is None else time_step,
            max_update_rate=now.max_update_rate if max_update_rate is None else max_update_rate,
            gravity=vector(x, y, z),
            ode_config=now.ode,
        )

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds a wall second to aim at; 0 for as many as possible."""
        now = self.physics
        return now.max_update_rate * now.time_step

    @real_time_factor.setter
    def real_time_factor(self, value: float) -> None:
        self.set_physics(max_update_rate=value / self.physics.time_step)

    @property
    def time_step(self) -> float:
        """Between two steps of the physics [s]."""
        return self.physics.time_step

    @time_step.setter
    def time_step(self, value: float) -> None:
        self.set_physics(time_step=value)

    @property
    def gravity(self) -> Vector:
        """[m/s²]."""
        return self.physics.gravity

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        self.set_physics(gravity=value)

    def set_default_physics(self) -> None:
        """What an empty world of Gazebo begins with: 1 ms steps in real time, 9.8 m/s² down."""
        self.set_physics(
            time_step=0.001,
            max_update_rate=1000.0,
            gravity=(0.0, 0.0, -9.8),
            auto_disable_bodies=False,
            sor_pgs_precon_iters=0,
            sor_pgs_iters=50,
            sor_pgs_w=1.3,
            cfm=0.0,
            erp=0.2,
            contact_surface_layer=0.001,
            contact_max_correcting_vel=100.0,
            max_contacts=20,
        )

    # -- models ------------------------------------------------------------------------------

    def spawn_urdf(self, name: str, text: str, **where: Any) -> None:
        """Put a robot there; see ``spawn_sdf`` for where.

        Args:
            name: Of the model.
            text: URDF.
            where: As for ``spawn_sdf``.

        Raises:
            ClientError: It cannot be spawned.
        """
        self._spawn("spawn_urdf_model", name, text, **where)

    def spawn_urdf_file(
        self,
        name: str,
        path: str | Path,
        *,
        package: str | None = None,
        xacro_args: Mapping[str, str] | None = None,
        **where: Any,
    ) -> None:
        """Put a robot of a URDF or xacro file there; see ``read_urdf`` and ``spawn_sdf``."""
        self.spawn_urdf(name, read_urdf(path, package=package, xacro_args=xacro_args), **where)

    def spawn_urdf_parameter(
        self, name: str, parameter: str = "robot_description", **where: Any
    ) -> None:
        """Put a robot there whose URDF a parameter holds; see ``spawn_sdf`` for where.

        Raises:
            ClientError: The parameter holds no text, or the robot cannot be spawned.
        """
        text = self.node.get_param(parameter, None)
        if not isinstance(text, str):
            raise ClientError(f"the parameter '{parameter}' holds no description")
        self.spawn_urdf(name, text, **where)

    def spawn_sdf(self, name: str, text: str, **where: Any) -> None:
        """Put a model or a light there.

        Args:
            name: Of the model.
            text: SDF.
            where: ``position`` [m] and ``rpy`` [rad], three numbers each; ``frame``, the
                model or link they are seen from; ``namespace`` of its topics.

        Raises:
            ClientError: It cannot be spawned.
        """
        self._spawn("spawn_sdf_model", name, text, **where)

    def spawn_sdf_file(
        self, name: str, path: str | Path, *, package: str | None = None, **where: Any
    ) -> None:
        """Put a model of an SDF file there; see ``spawn_sdf``."""
        self.spawn_sdf(name, find_file(path, package).read_text(encoding="utf-8"), **where)

    def _spawn(
        self,
        service: str,
        name: str,
        text: str,
        *,
        position: Vector = (0.0, 0.0, 0.0),
        rpy: Vector = (0.0, 0.0, 0.0),
        frame: str = "world",
        namespace: str = "/",
    ) -> None:
        self._caller.demand(
            service,
            "gazebo_msgs/SpawnModel",
            model_name=name,
            model_xml=text,
            robot_namespace=namespace,
            initial_pose=pose_message(position, rpy),
            reference_frame=frame,
        )

    def delete(self, name: str) -> None:
        """Take a model away.

        Raises:
            ClientError: There is none of that name.
        """
        self._caller.demand("delete_model", "gazebo_msgs/DeleteModel", model_name=name)

    def model_state(self, name: str, frame: str = "world") -> ModelState:
        """Where a model is and how it moves, seen from a frame.

        Raises:
            ClientError: There is no such model or frame.
        """
        answer = self._caller.demand(
            "get_model_state",
            "gazebo_msgs/GetModelState",
            model_name=name,
            relative_entity_name=frame,
        )
        return read_state(answer.pose, answer.twist)

    def set_model_state(
        self,
        name: str,
        position: Vector,
        rpy: Vector = (0.0, 0.0, 0.0),
        linear: Vector = (0.0, 0.0, 0.0),
        angular: Vector = (0.0, 0.0, 0.0),
        frame: str = "world",
    ) -> None:
        """Put a model somewhere with a velocity, seen from a frame [m, rad, m/s, rad/s].

        Raises:
            ClientError: There is no such model or frame.
        """
        state: Any = load_message("gazebo_msgs/ModelState")()
        state.model_name, state.reference_frame = name, frame
        state.pose, state.twist = pose_message(position, rpy), twist_message(linear, angular)
        self._caller.demand("set_model_state", "gazebo_msgs/SetModelState", model_state=state)

    def set_joints(self, name: str, positions: Mapping[str, float]) -> None:
        """Put joints of a model somewhere [m or rad].

        Raises:
            ClientError: There is no such model.
        """
        self._caller.demand(
            "set_model_configuration",
            "gazebo_msgs/SetModelConfiguration",
            model_name=name,
            joint_names=list(positions),
            joint_positions=list(positions.values()),
        )

    # -- forces ------------------------------------------------------------------------------

    def apply_wrench(
        self,
        link: str,
        force: Vector = (0.0, 0.0, 0.0),
        torque: Vector = (0.0, 0.0, 0.0),
        *,
        duration: float | None = None,
        frame: str = "",
    ) -> None:
        """Push a link, ``model::link``, for some seconds, for ever if None [N, N m].

        Raises:
            ClientError: There is no such link or frame.
        """
        wrench: Any = load_message("geometry_msgs/Wrench")()
        wrench.force, wrench.torque = vector(*force), vector(*torque)
        self._caller.demand(
            "apply_body_wrench",
            "gazebo_msgs/ApplyBodyWrench",
            body_name=link,
            reference_frame=frame,
            wrench=wrench,
            start_time=Time(),
            duration=_FOREVER if duration is None else Duration.from_sec(duration),
        )

    def clear_wrenches(self, link: str) -> None:
        """End all wrenches on a link."""
        self._caller.call("clear_body_wrenches", "gazebo_msgs/BodyRequest", body_name=link)

    def apply_effort(self, joint: str, effort: float, *, duration: float | None = None) -> None:
        """Let an effort act on a joint for some seconds, for ever if None [N or N m].

        Raises:
            ClientError: There is no such joint.
        """
        self._caller.demand(
            "apply_joint_effort",
            "gazebo_msgs/ApplyJointEffort",
            joint_name=joint,
            effort=effort,
            start_time=Time(),
            duration=_FOREVER if duration is None else Duration.from_sec(duration),
        )

    def clear_efforts(self, joint: str) -> None:
        """End all efforts on a joint."""
        self._caller.call("clear_joint_forces", "gazebo_msgs/JointRequest", joint_name=joint)

    # -- watching ----------------------------------------------------------------------------

    def watch_models(self) -> LiveStates:
        """A table of all models that is kept up to date; close it when done."""
        return LiveStates(self.node, f"{self._caller.namespace}/model_states", "ModelStates")

    def watch_links(self) -> LiveStates:
        """A table of all links that is kept up to date; close it when done."""
        return LiveStates(self.node, f"{self._caller.namespace}/link_states", "LinkStates")

    def wait_for_model(self, name: str, timeout: float = 10.0) -> None:
        """Wait until a model is there.

        Raises:
            ClientError: It does not come within ``timeout`` [s of wall time].
        """
        deadline = time.monotonic() + timeout
        while name not in self.models:
            if time.monotonic() > deadline:
                raise ClientError(f"the model '{name}' is not there after {timeout:g} s")
            time.sleep(0.05)

    # -- the end -----------------------------------------------------------------------------

    def close(self) -> None:
        """Close the connections, and the node if it is this client's own."""
        self._caller.close()
        if self._owned:
            self.node.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def vector(x: float, y: float, z: float) -> Any:
    """A ``geometry_msgs/Vector3``."""
    return load_message("geometry_msgs/Vector3")(x, y, z)
