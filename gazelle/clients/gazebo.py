"""A Gazebo on a ROS 1 graph, Gazelle's or a real one: steer it, fill it, ask it."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Unpack

from gazelle.argument_checks import checked
from gazelle.clients.calls import Caller
from gazelle.clients.descriptions import find_file, read_urdf
from gazelle.clients.errors import ClientError
from gazelle.clients.physics import PhysicsCalls, vector
from gazelle.clients.poses import (
    ModelState,
    SpawnOptions,
    Vector,
    pose_message,
    read_state,
    three,
    twist_message,
)
from gazelle.clients.states import LiveStates
from gazelle_ros import Duration, Node, Time, WallClock
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.base.text_files import read_text
from gazelle_ros.msgs import gazebo_msgs, geometry_msgs

_FOREVER = Duration(-1, 0)
# What Gazebo answers to a spawn or delete that was carried out already.
_TAKEN = "SpawnModel: Failure - entity already exists."
_GONE = "DeleteModel: model does not exist"


@checked(ClientError, after=True)
class Gazebo(PhysicsCalls, Closeable):
    """Calls the services of ``gazebo_ros``; also a context manager.

    Args:
        node: Calls; a node of its own is made if None.
        namespace: Namespace of the services.
        master_uri: For its own node; by default ``ROS_MASTER_URI``.
        timeout: For services to be there and for answers [s of wall time].
        retries: Number of retries of interrupted calls; steps and forces are never repeated,
            and models are neither spawned nor deleted twice.

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
        """Pause the simulation."""
        self._caller.call("pause_physics", "std_srvs/Empty")

    def unpause(self) -> None:
        """Unpause the simulation."""
        self._caller.call("unpause_physics", "std_srvs/Empty")

    def reset_simulation(self) -> None:
        """Reset everything, time too."""
        self._caller.call("reset_simulation", "std_srvs/Empty")

    def reset_world(self) -> None:
        """Reset the models; time continues."""
        self._caller.call("reset_world", "std_srvs/Empty")

    def step(self, steps: int = 1) -> float:
        """Advance a paused world by steps; Gazelle only. Returns the time then [s].

        Raises:
            ClientError: The world is not paused, or this is no Gazelle.
        """
        answer = self._caller.demand_once("/gazelle/step", "gazelle_msgs/Step", steps=steps)
        return float(answer.time.to_sec())

    @property
    def time(self) -> float:
        """The simulated time [s]."""
        return float(self._world().sim_time)

    @property
    def models(self) -> list[str]:
        """The names of all models."""
        return list(self._world().model_names)

    def _world(self) -> gazebo_msgs.srv.GetWorldPropertiesResponse:
        found: gazebo_msgs.srv.GetWorldPropertiesResponse = self._caller.demand(
            "get_world_properties", "gazebo_msgs/GetWorldProperties"
        )
        return found

    # -- models ------------------------------------------------------------------------------

    def spawn_urdf(self, name: str, text: str, **where: Unpack[SpawnOptions]) -> None:
        """Spawn a robot; see ``spawn_sdf`` for where.

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
        **where: Unpack[SpawnOptions],
    ) -> None:
        """Spawn a robot of a URDF or xacro file; see ``read_urdf`` and ``spawn_sdf``."""
        self.spawn_urdf(name, read_urdf(path, package=package, xacro_args=xacro_args), **where)

    def spawn_urdf_parameter(
        self, name: str, parameter: str = "robot_description", **where: Unpack[SpawnOptions]
    ) -> None:
        """Spawn a robot whose URDF a parameter holds; see ``spawn_sdf`` for where.

        Raises:
            ClientError: The parameter holds no text, or the robot cannot be spawned.
        """
        self.spawn_urdf(name, self._parameter(parameter), **where)

    def spawn_sdf(self, name: str, text: str, **where: Unpack[SpawnOptions]) -> None:
        """Spawn a model or a light.

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
        self,
        name: str,
        path: str | Path,
        *,
        package: str | None = None,
        **where: Unpack[SpawnOptions],
    ) -> None:
        """Spawn a model of an SDF file; see ``spawn_sdf``."""
        self.spawn_sdf(name, read_text(find_file(path, package)), **where)

    def spawn_sdf_parameter(self, name: str, parameter: str, **where: Unpack[SpawnOptions]) -> None:
        """Spawn a model whose SDF a parameter holds; see ``spawn_sdf`` for where.

        Raises:
            ClientError: The parameter holds no text, or the model cannot be spawned.
        """
        self.spawn_sdf(name, self._parameter(parameter), **where)

    def _parameter(self, name: str) -> str:
        text = self.node.get_param(name, None)
        if not isinstance(text, str):
            raise ClientError(f"the parameter '{name}' holds no description")
        return text

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
        known = name in self.models
        answer, repeated = self._caller.call_again(
            service,
            "gazebo_msgs/SpawnModel",
            model_name=name,
            model_xml=text,
            robot_namespace=namespace,
            initial_pose=pose_message(position, rpy),
            reference_frame=frame,
        )
        # An answer that got lost may have been a yes: then what is there now is ours.
        if repeated and not known and answer.status_message == _TAKEN:
            return
        self._caller.accept(service, answer)

    def delete(self, name: str) -> None:
        """Delete a model.

        Raises:
            ClientError: There is none of that name.
        """
        known = name in self.models
        answer, repeated = self._caller.call_again(
            "delete_model", "gazebo_msgs/DeleteModel", model_name=name
        )
        if not (repeated and known and answer.status_message == _GONE):
            self._caller.accept("delete_model", answer)

    def model_state(self, name: str, frame: str = "world") -> ModelState:
        """Return pose and velocity of a model, relative to a frame.

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
        """Set pose and velocity of a model, relative to a frame [m, rad, m/s, rad/s].

        Raises:
            ClientError: There is no such model or frame.
        """
        state = gazebo_msgs.msg.ModelState()
        state.model_name, state.reference_frame = name, frame
        state.pose, state.twist = pose_message(position, rpy), twist_message(linear, angular)
        self._caller.demand("set_model_state", "gazebo_msgs/SetModelState", model_state=state)

    def set_joints(self, name: str, positions: Mapping[str, float]) -> None:
        """Set joint positions of a model [m or rad].

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
        """Apply a wrench to a link, ``model::link``, for some seconds, for ever if None [N, N m].

        Raises:
            ClientError: There is no such link or frame.
        """
        wrench = geometry_msgs.msg.Wrench()
        wrench.force = vector(*three(force, "a force"))
        wrench.torque = vector(*three(torque, "a torque"))
        self._caller.demand_once(
            "apply_body_wrench",
            "gazebo_msgs/ApplyBodyWrench",
            body_name=link,
            reference_frame=frame,
            wrench=wrench,
            start_time=Time(),
            duration=_FOREVER if duration is None else Duration.from_sec(duration),
        )

    def clear_wrenches(self, link: str) -> None:
        """Remove all wrenches from a link."""
        self._caller.call("clear_body_wrenches", "gazebo_msgs/BodyRequest", body_name=link)

    def apply_effort(self, joint: str, effort: float, *, duration: float | None = None) -> None:
        """Apply an effort to a joint for some seconds, for ever if None [N or N m].

        Raises:
            ClientError: There is no such joint.
        """
        self._caller.demand_once(
            "apply_joint_effort",
            "gazebo_msgs/ApplyJointEffort",
            joint_name=joint,
            effort=effort,
            start_time=Time(),
            duration=_FOREVER if duration is None else Duration.from_sec(duration),
        )

    def clear_efforts(self, joint: str) -> None:
        """Remove all efforts from a joint."""
        self._caller.call("clear_joint_forces", "gazebo_msgs/JointRequest", joint_name=joint)

    # -- watching ----------------------------------------------------------------------------

    def watch_models(self) -> LiveStates:
        """Return a table of all models that is kept up to date; close it when done."""
        return LiveStates(self.node, f"{self._caller.namespace}/model_states", "ModelStates")

    def watch_links(self) -> LiveStates:
        """Return a table of all links that is kept up to date; close it when done."""
        return LiveStates(self.node, f"{self._caller.namespace}/link_states", "LinkStates")

    def wait_for_model(self, name: str, timeout: float = 10.0) -> None:
        """Wait until a model is there.

        Raises:
            ClientError: It does not come within ``timeout`` [s of wall time].
        """
        deadline = deadline_after(timeout)
        while name not in self.models:
            if time.monotonic() > deadline:
                raise ClientError(f"the model '{name}' did not appear within {timeout:g} s")
            time.sleep(0.05)

    # -- the end -----------------------------------------------------------------------------

    def close(self) -> None:
        """Close the connections, and the node if it is this client's own."""
        self._caller.close()
        if self._owned:
            self.node.close()
