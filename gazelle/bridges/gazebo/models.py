"""The services on models: spawn, delete, state, configuration, properties."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np

from gazelle.bridges.conversions import (
    point,
    quaternion,
    set_pose,
    set_twist,
)
from gazelle.bridges.gazebo.answers import Answer, no, yes
from gazelle.bridges.gazebo.context import GazeboContext
from gazelle.bridges.gazebo.entities import State
from gazelle.bridges.gazebo.lights import LightServices
from gazelle.bridges.gazebo.spawning import (
    TAKEN,
    failure,
    is_urdf,
    read_entity,
)
from gazelle.description import Light, Model, Pose
from gazelle.errors import EngineError, Error
from gazelle.simulation import Robot
from gazelle_ros.errors import ServiceError
from gazelle_ros.msgs import gazebo_msgs, geometry_msgs

_NO_FRAME = "reference reference_frame not found, did you forget to scope the link by model name?"


class ModelServices:
    """Services of ``/gazebo`` about models."""

    def __init__(self, context: GazeboContext, lights: LightServices) -> None:
        self._context = context
        self._lights = lights
        self._entities = context.entities
        self._simulation = context.simulation
        self._calls: Counter[str] = Counter()

    def spawn_urdf(self, request: gazebo_msgs.srv.SpawnModelRequest) -> Answer:
        """Answer ``spawn_urdf_model``.

        Raises:
            ServiceError: The text is not a URDF; the call fails, as Gazebo's does.
        """
        if not is_urdf(request.model_xml):
            raise ServiceError("SpawnModel: Failure - entity format is invalid.")
        return self.spawn(request)

    def spawn(self, request: gazebo_msgs.srv.SpawnModelRequest) -> Answer:
        """Answer ``spawn_sdf_model``: a model, or a light, from SDF or URDF.

        The text is read beside the running simulation; only what follows waits for its turn.
        """
        found = read_entity(request.model_xml, request.model_name)
        with self._simulation.lock:
            return self._put(found, request)

    def _put(
        self, found: Model | Light | str, request: gazebo_msgs.srv.SpawnModelRequest
    ) -> Answer:
        """Spawn the models and lights of a description; frames come first, as in Gazebo."""
        pose = self._pose(request)
        if pose is None:
            return no(f"SpawnModel: {_NO_FRAME}")
        if isinstance(found, str):
            return no(found)
        if isinstance(found, Light):
            return self._spawn_light(replace(found, pose=pose * found.pose))
        return self._spawn(found, pose, request)

    def _pose(self, request: gazebo_msgs.srv.SpawnModelRequest) -> Pose | None:
        """Return the pose that a request gives its model; None if there is no such frame."""
        frame = self._entities.frame(request.reference_frame)
        if frame is None:
            return None
        place = read_pose(request.initial_pose).placed_in(frame)
        x, y, z = place.position.tolist()
        qx, qy, qz, qw = place.quaternion.tolist()
        return Pose.from_quaternion((x, y, z), (qx, qy, qz, qw))

    def _spawn_light(self, light: Light) -> Answer:
        if not self._lights.add(light):
            return no(TAKEN)
        return yes("SpawnModel: Successfully spawned entity")

    def _spawn(
        self, model: Model, pose: Pose, request: gazebo_msgs.srv.SpawnModelRequest
    ) -> Answer:
        if model.name in self._simulation.robots:
            return no(TAKEN)
        # What scripts send by default means the simulator's own namespace.
        own = self._simulation.ports.namespace if request.robot_namespace == "/" else ""
        try:
            namespace = own or request.robot_namespace
            self._simulation.spawn(model, pose=pose, namespace=namespace)
        except Error as error:
            return no(failure(error))
        return yes("SpawnModel: Successfully spawned entity")

    def delete(self, request: gazebo_msgs.srv.DeleteModelRequest) -> Answer:
        """Answer ``delete_model``."""
        if request.model_name not in self._simulation.robots:
            return no("DeleteModel: model does not exist")
        self._simulation.delete(request.model_name)
        self._calls.pop(request.model_name, None)
        return yes("DeleteModel: successfully deleted model")

    def get_properties(self, request: gazebo_msgs.srv.GetModelPropertiesRequest) -> Answer:
        """Answer ``get_model_properties``."""
        robot = self._entities.model(request.model_name)
        if robot is None:
            return no("GetModelProperties: model does not exist")
        model = robot.description
        return {
            "body_names": [link.name for link in model.links],
            "geom_names": [each.name for link in model.links for each in link.collisions],
            "joint_names": [joint.name for joint in model.joints],
            "child_model_names": [child.name for child in model.models],
            "is_static": model.static,
            **yes("GetModelProperties: got properties"),
        }

    def get_state(self, request: gazebo_msgs.srv.GetModelStateRequest) -> Answer:
        """Answer ``get_model_state``."""
        robot = self._entities.model(request.model_name)
        if robot is None:
            return no("GetModelState: model does not exist")
        response = self._context.response("GetModelState")
        self._calls[request.model_name] += 1
        response.header.seq = self._calls[request.model_name]
        response.header.stamp = self._context.now()
        response.header.frame_id = request.relative_entity_name
        frame = self._entities.frame(request.relative_entity_name)
        if frame is None:
            response.status_message = (
                "GetModelState: reference relative_entity_name not found, did you forget to scope "
                "the body by model name?"
            )
            return response
        seen = self._entities.state(robot).seen_from(frame)
        set_pose(response.pose, seen.position, seen.quaternion)
        set_twist(response.twist, seen.linear, seen.angular)
        response.success = True
        response.status_message = "GetModelState: got properties"
        return response

    def set_state(self, request: gazebo_msgs.srv.SetModelStateRequest) -> Answer:
        """Answer ``set_model_state``."""
        return self.set_state_of(request.model_state)

    def set_state_of(self, target: gazebo_msgs.msg.ModelState) -> Answer:
        """Apply a ``gazebo_msgs/ModelState`` of the service or the topic."""
        robot = self._entities.model(target.model_name)
        if robot is None:
            return no("SetModelState: model does not exist")
        frame = self._entities.frame(target.reference_frame)
        if frame is None:
            return no("SetModelState: specified reference frame entity does not exist")
        missed = self._place(robot, read_state(target).placed_in(frame))
        return yes(f"SetModelState: set model state done{', but ' if missed else ''}{missed}")

    def _place(self, robot: Robot, state: State) -> str:
        """Set the pose of a model; returns a text if a joint holds it elsewhere.

        Gazebo calls that done, and its joint moves the model back.
        """
        engine, worlds, missed = self._simulation.engine, self._entities.worlds, ""
        try:
            engine.models[robot.name].set_placement(state.position, state.quaternion, worlds)
        except EngineError as error:
            missed = error.message
        if robot.links and not robot.description.static:
            engine.models[robot.name].set_motion(state.linear, state.angular, worlds)
        return missed

    def set_configuration(self, request: gazebo_msgs.srv.SetModelConfigurationRequest) -> Answer:
        """Answer ``set_model_configuration``: set joint positions, and keep velocities."""
        robot = self._entities.model(request.model_name)
        if robot is None:
            return no("SetModelConfiguration: model does not exist")
        names, positions = request.joint_names, request.joint_positions
        if len(names) != len(positions):
            return no("SetModelConfiguration: joint name and position list have different lengths")
        for name, position in zip(names, positions, strict=True):
            found = robot.joints.get(name)
            if found is not None:  # Gazebo passes over names that it does not know
                self._turn(found.name, position)
        return yes("SetModelConfiguration: success")

    def _turn(self, joint: str, position: float) -> None:
        """Set the position of a joint's first axis; a ball has none."""
        engine, worlds = self._simulation.engine, self._entities.worlds
        positions = engine.joints[joint].position(worlds)
        if positions.shape[1] == engine.joints[joint].velocity(worlds).shape[1]:
            positions[:, 0] = position
            engine.joints[joint].set_position(positions, worlds)


def read_pose(pose: geometry_msgs.msg.Pose) -> State:
    """Convert a ``geometry_msgs/Pose``, at rest."""
    place = np.array(point(pose.position)), np.array(quaternion(pose.orientation))
    return State(*place, np.zeros(3), np.zeros(3))


def read_state(state: gazebo_msgs.msg.ModelState | gazebo_msgs.msg.LinkState) -> State:
    """Convert pose and twist of a ``ModelState`` or ``LinkState``."""
    linear, angular = np.array(point(state.twist.linear)), np.array(point(state.twist.angular))
    return replace(read_pose(state.pose), linear=linear, angular=angular)
