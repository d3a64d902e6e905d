"""Good values for parameters of the public API, by name, class or word of their annotations."""

from __future__ import annotations

import contextlib
import enum
import functools
import importlib
import inspect
import re
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import arms
import gymnasium as gym
import numpy as np
import scenes
import wrong_calls

import gazelle
import gazelle.builders
import gazelle_ros as ros
from gazelle import Error, Simulation, clients, envs, planning, stage
from gazelle.control import EFFORT, JointCommandInterface, JointStateInterface
from gazelle.description import Box, OccupancyMap, Pose
from gazelle.engines import planar
from gazelle.engines.tracer import make_tracer
from gazelle.formats import Octree
from gazelle.geometry import triangles
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.planar_part import PlanarPart
from gazelle.navigation import costmap, planners
from gazelle.navigation.estimation import ExtendedPrediction
from gazelle.sensors import View, look_at
from gazelle.streams import Stream
from gazelle.training import Actor, deploy
from gazelle_ros import bags
from gazelle_ros import tf as frames
from gazelle_ros.msgs import move_base_msgs, std_msgs, std_srvs, tf2_msgs

TEXT = std_msgs.msg.String
STAGE = """
define lidar ranger ( sensor ( range [0 5] fov 90 samples 9 ) )
define eyes camera ( resolution [8 6] )
define hand gripper ( size [.2 .3 .2] pose [.3 0 -.4 0] )
define arm actuator ( type "linear" max_speed 1 model ( size [.1 .1 .1] ) )
define skin bumper ( bcount 2 bpose[0] [.2 .1 .1 0] bpose[1] [.2 -.1 .1 0] blength .2 )
define robot position
( size [.4 .4 .4] lidar() eyes() hand() arm() skin() fiducial() blobfinder() )
robot ( name "r" ctrl "wander" )
robot ( name "s" pose [0 2 0 0] )
model ( name "puck" size [.1 .1 1] pose [1 0 0 0] color "red" gripper_return 1 fiducial_return 7 )
"""

PACKAGES = {
    name: f"gazelle.{name}"
    for name in (
        *(
            "assets",
            "bridges",
            "builders",
            "clients",
            "control",
            "description",
            "engines",
            "envs",
            "formats",
        ),
        *("kinematics", "navigation", "planning", "rendering", "sensors", "simulation"),
        *("stage", "training", "viewer"),
    )
} | {
    "gazelle": "gazelle",
    "actions": "gazelle_ros.actions",
    "launch": "gazelle_ros.launch",
    "messages": "gazelle_ros.messages",
    "robot": "gazelle_ros.robot",
    "bags": "gazelle_ros.bags",
    "frames": "gazelle_ros.tf",
    **{
        name: f"gazelle.navigation.{name}"
        for name in ("costmap", "estimation", "localization", "mapping", "planners")
    },
    "deploy": "gazelle.training.deploy",
    "move_base": "gazelle.navigation.move_base",
    "mujoco": "gazelle.engines.mujoco",
    "planar": "gazelle.engines.planar",
    "ros": "gazelle_ros",
}


def public(package: str) -> Iterator[tuple[str, Any]]:
    """Yield functions and classes that a package exports."""
    module = importlib.import_module(PACKAGES[package])
    for name in module.__all__:
        value = getattr(module, name)
        kind = isinstance(value, type) and issubclass(value, BaseException | enum.Enum)
        if callable(value) and not kind and not getattr(value, "_is_protocol", False):
            yield name, value


@functools.cache
def classes() -> dict[str, type]:
    """Return the public classes, by name."""
    found = {}
    for package in PACKAGES:
        found.update({name: each for name, each in public(package) if isinstance(each, type)})
    return found


class Samples:
    """Good values for what a package exports; the call is what ``wrong_calls.calls`` takes."""

    def __init__(self, package: str = "") -> None:
        self.package = package
        self.called = ""
        self.stack = contextlib.ExitStack()
        self._making: list[type] = []
        self._nodes = 0

    def __call__(self, name: str, annotation: str) -> Any:
        if name in BY_NAME and ("str" in annotation or annotation in ("", "Any") or name == "spec"):
            return BY_NAME[name](self)
        plain = annotation.replace("'", "")
        if plain.startswith("Sequence[tuple[float, float]]"):
            return [(0.0, 1.0), (2.0, 1.0)]
        if "gym." in plain:
            box = gym.spaces.Box(-1.0, 1.0, (2,))
            return gym.spaces.Dict({"a": box}) if "Dict" in plain else box
        if re.search(r"(Iterable|Sequence|tuple)\[tuple\[(Shape|Geometry)", plain):
            return ((Box((1.0, 1.0, 1.0)), Pose()),)
        if plain.startswith("Sequence[tuple[Sensor"):
            return []
        listed = re.match(r"(Sequence|Iterable|list|tuple)\[\(?(\w+)", plain)
        if listed and (listed[2] in TABLE or listed[2] in classes()):
            return (self(name, listed[2]),)
        for word in re.findall(r"\w+", plain):
            if word in TABLE:
                return TABLE[word](self)
            if word in classes() and (word != "Path" or name == "route"):
                return self.instance(classes()[word])
        found = (value for word, value in BY_WORD.items() if word in plain)
        return next(found, 1)

    def instance(self, kind: type) -> Any:
        """Return an instance of a public class, made of good values; None if none can be made."""
        try:
            return self._made(kind)
        except Exception as error:  # noqa: BLE001  # the sample is wrong: others are not concerned
            print(f"no sample of {kind.__name__}: {error!r:.150}")
            return None

    def _made(self, kind: type) -> Any:
        if kind.__name__ in TABLE:
            return TABLE[kind.__name__](self)
        if kind in self._making or inspect.isabstract(kind):
            return None
        self._making.append(kind)
        try:
            parameters = inspect.signature(kind).parameters.values()
            positional, named = [], {}
            for each in parameters:
                if each.default is each.empty and each.kind not in (
                    each.VAR_KEYWORD,
                    each.VAR_POSITIONAL,
                ):
                    value = self(each.name, wrong_calls.annotation_of(each))
                    if each.kind is each.KEYWORD_ONLY:
                        named[each.name] = value
                    else:
                        positional.append(value)
            return kind(*positional, **named)
        finally:
            self._making.pop()

    @functools.cached_property
    def simulation(self) -> Simulation:
        """A burger and a box on the ground, in two worlds."""
        world = scenes.world(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(1, 1, 1)))
        return self.stack.enter_context(Simulation(world, nworld=2, threads=1))

    @functools.cached_property
    def group_plan(self) -> Any:
        """A plan of the arm."""
        return planning.Group(self.arm, "arm").plan({"wrist_flex_joint": 0.3})

    @functools.cached_property
    def task(self) -> Any:
        """A task of two worlds."""
        return self._task("gazelle/CartPoleStayUp-v0")

    @functools.cached_property
    def goal_task(self) -> Any:
        """A task with goals, of two worlds."""
        return self._task("gazelle/FetchReach-v0")

    def _task(self, name: str) -> Any:
        env = gym.make_vec(name, 2, vectorization_mode="vector_entry_point")
        self.stack.callback(env.close)
        env.reset(seed=1)
        return env.unwrapped.task

    @functools.cached_property
    def node(self) -> Any:
        """A node of a graph of its own."""
        master = self.stack.enter_context(ros.Master(port=0))
        return self.stack.enter_context(ros.Node("sweeper", master_uri=master.uri))

    def new_node(self) -> Any:
        """Return another node of that graph, for what closes its node."""
        self._nodes += 1
        node = ros.Node(f"sweeper_{self._nodes}", master_uri=self.node.master_uri)
        return self.stack.enter_context(node)

    @functools.cached_property
    def deployed(self) -> Any:
        """A policy that may drive a robot."""
        made = deploy.DeployNode(self.new_node(), TABLE["Policy"](self), deploy.SafetyLimits())
        return self.stack.enter_context(made)

    @functools.cached_property
    def gazebo(self) -> Any:
        """A client of a world that is served, with a burger."""
        sim = self.stack.enter_context(Simulation("turtlebot3_stage_1", threads=1))
        sim.spawn("turtlebot3_burger", name="r1", namespace="/")
        server = self.stack.enter_context(gazelle.serve_ros(sim, self.node.master_uri))
        thread = threading.Thread(target=server.run)
        thread.start()
        self.stack.callback(thread.join)
        self.stack.callback(server.stop)
        return self.stack.enter_context(clients.Gazebo(self.node))

    @functools.cached_property
    def stage(self) -> stage.StageSimulation:
        """Stage's devices on a robot and things around it, in two worlds."""
        file = Path("devices.world")
        file.write_text(STAGE)
        return self.stack.enter_context(stage.StageSimulation(file, nworld=2, threads=1))

    @functools.cached_property
    def publisher(self) -> ros.Publisher:
        """A publisher of texts."""
        return self.node.advertise("chatter", TEXT)

    @functools.cached_property
    def subscriber(self) -> ros.Subscriber:
        """A subscriber of texts."""
        return self.node.subscribe("chatter", TEXT, lambda _message: None)

    @property
    def world(self) -> Any:
        """The description of a world."""
        if self.package == "stage":
            return self.stage.simulation.world
        return scenes.world(scenes.ground(), scenes.box())

    @functools.cached_property
    def bag(self) -> bags.Bag:
        """A bag with two messages, open for reading."""
        with bags.Bag("file.bag", "w") as bag:
            for seconds in (1, 2):
                bag.write("/chatter", TEXT(data="hello"), ros.Time(seconds, 0))
        return self.stack.enter_context(bags.Bag("file.bag"))

    @functools.cached_property
    def frames(self) -> frames.FrameTree:
        """A tree of two frames, both of which stay as they are."""
        tree = frames.FrameTree()
        tree.place("a", "b", 10**9, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0), static=True)
        return tree

    @property
    def burger(self) -> Any:
        """A robot with wheels and a lidar."""
        return self.simulation.robots["burger"]

    @functools.cached_property
    def commands(self) -> JointCommandInterface:
        """Commands to a joint in two worlds."""
        return JointCommandInterface(EFFORT, ["a"], JointStateInterface(["a"], 2))

    @functools.cached_property
    def arm(self) -> Any:
        """Robot of a running simulation with a group "arm"."""
        sim = self.stack.enter_context(Simulation("fetch", threads=1))
        return sim.robots["fetch"]


def policy() -> Actor:
    """Return a policy of two numbers and two actions, which may do anything."""
    numbers = np.ones(2, np.float32)
    return Actor(
        (np.eye(2, dtype=np.float32),), (numbers,), "tanh", "gaussian", numbers, -numbers, numbers
    )


def contract() -> envs.PolicyContract:
    """Return the contract of a policy that drives."""
    action = envs.ActionRule(
        kind="velocity", low=(0.0,), high=(1.0,), at_low=(0, 0), at_high=(1, 0)
    )
    return envs.PolicyContract(action=action, control_period=0.1)


def _set_event() -> threading.Event:
    event = threading.Event()
    event.set()
    return event


TABLE: dict[str, Callable[[Samples], Any]] = {
    "Simulation": lambda s: s.stage.simulation if s.called in IN_THE_PLANE else s.simulation,
    "Node": lambda s: s.node,
    "Gazebo": lambda s: s.gazebo,
    "Controllers": lambda s: clients.Controllers(s.node, timeout=0.1),
    "TrajectoryClient": lambda s: clients.TrajectoryClient(s.node, "a", timeout=0.1),
    "RobotHost": lambda s: s.simulation,
    "RunningState": lambda s: s.simulation,
    "PopulatedState": lambda s: s.simulation,
    "RecordedRun": lambda s: s.simulation,
    "Spawned": lambda s: s.burger,
    "SampledSensor": lambda s: next(iter(s.burger.sensors.values())),
    "SensorUnit": lambda s: next(iter(s.burger.sensors.values())),
    "LinkHandle": lambda s: next(iter(s.burger.links.values())),
    "JointHandle": lambda s: next(iter(s.burger.joints.values())),
    "WorldParameters": lambda s: s.simulation.parameters,
    "PhysicsProperties": lambda s: s.simulation.physics,
    "StateLock": lambda s: s.simulation.lock,
    "Robot": lambda s: s.burger if s.package in ("simulation", "stage", "gazelle") else s.arm,
    "BatchedTask": lambda s: s.task,
    "SimulationTask": lambda s: s.task,
    "GoalSimulationTask": lambda s: s.goal_task,
    "JointCommandInterface": lambda s: s.commands,
    "JointHandles": lambda s: s.commands.handles(["a"]),
    "JointStateInterface": lambda s: JointStateInterface(["a"], 2),
    "Tracer": lambda s: make_tracer(s.simulation.world),
    "OccupancyMap": lambda s: OccupancyMap(np.zeros((2, 3), np.int8), 0.1),
    "Picture": lambda s: np.zeros((4, 4, 3), np.uint8),
    "Bytes": lambda s: np.zeros(4, np.uint8),
    "UInts64": lambda s: np.zeros(2, np.uint64),
    "World": lambda s: s.world,
    "Model": lambda s: scenes.box("new"),
    "RobotModel": lambda s: arms.arm("fetch"),
    "JointModelGroup": lambda s: arms.arm_group("fetch")[1],
    "Engine": lambda s: s.simulation.engine,
    "Pose": lambda s: Pose(),
    "Error": lambda s: Error("wrong"),
    "Shape": lambda s: Box((1.0, 1.0, 1.0)),
    "Geometry": lambda s: Box((1.0, 1.0, 1.0)),
    "Region": lambda s: Box((1.0, 1.0, 1.0)),
    "Vector": lambda s: (0.0, 0.0, 1.0),
    "Goal": lambda s: dict.fromkeys(arms.arm_group("fetch")[1].names, 0.0),
    "View": lambda s: View(look_at((2.0, 2.0, 2.0), (0.0, 0.0, 0.0)), 4, 4),
    "Callable": lambda s: gazelle.builders.desk,
    "Serializer": lambda s: lambda call, *a: call(*a),
    "Generator": lambda s: np.random.default_rng(0),
    "Floats": lambda s: np.zeros(3),
    "Ints32": lambda s: np.array([[0, 1, 2]], np.int32),
    "MeshData": lambda s: MeshData(np.eye(3), TABLE["Ints32"](s)),
    "Bools": lambda s: np.ones(3, bool),
    "Indices": lambda s: np.arange(3),
    "Paint": lambda s: "grey",
    "Zone": lambda s: gazelle.builders.Disc(),
    "RobotT": lambda s: scenes.burger(),
    "Stream": lambda s: Stream(0, "test", 1),
    "Terrain": lambda s: gazelle.builders.terrain(np.eye(3)),
    "Point": lambda s: (0.0, 1.0),
    "Octree": lambda s: Octree(0.1, b""),
    "Actor": lambda s: policy(),
    "DeployNode": lambda s: s.deployed,
    "Event": lambda s: _set_event(),
    "Policy": lambda s: deploy.Policy(policy(), contract()),
    "TriangleMesh": lambda s: triangles.box((1.0, 1.0, 1.0)),
    "PlanningScene": lambda s: planning.PlanningScene(arms.arm("fetch")),
    "Group": lambda s: planning.Group(s.arm, "arm"),
    "MotionPlan": lambda s: s.group_plan.plan,
    "GroupPlan": lambda s: s.group_plan,
    "LaserScan": lambda s: None,
    "Bag": lambda s: s.bag,
    "FrameTree": lambda s: s.frames,
    "Master": lambda s: s.stack.enter_context(ros.Master(port=0)),
    "Handler": lambda s: lambda _request: {},
    "NodeBase": lambda s: s.node,
    "Publication": lambda s: s.node.publication(s.publisher.name),
    "Subscription": lambda s: s.node.subscription(s.subscriber.name),
    "TFMessage": lambda s: tf2_msgs.msg.TFMessage(),
    "Time": lambda s: ros.Time(1, 0),
    "Duration": lambda s: ros.Duration(1, 0),
    "TimeSource": lambda s: ros.WallClock(),
    "Publisher": lambda s: s.publisher,
    "Subscriber": lambda s: s.subscriber,
    "MasterProxy": lambda s: s.node.master,
    "StageSimulation": lambda s: s.stage,
    "StageFleet": lambda s: s.stage.stage_fleet,
    "StageBodies": lambda s: s.stage.stage_fleet,
    "StageRobot": lambda s: s.stage.robot("r"),
    "StageModel": lambda s: s.stage.robot("r").model,
    "StageWorld": lambda s: s.stage.description,
    "Ranger": lambda s: s.stage.robot("r").rangers[0],
    "PlanarEngine": lambda s: s.stage.stage_fleet.engine,
    "MujocoEngine": lambda s: s.simulation.engine,
    "PlanarPart": lambda s: PlanarPart.box(1.0, 1.0),
    "Body": lambda s: planar.Body((PlanarPart.box(0.1, 0.1),), drive=planar.Drive()),
    "Fleet": lambda s: planar.Fleet([TABLE["Body"](s)] * 2, nworld=2, threads=1),
    "Fan": lambda s: planar.Fan(0.0, 0.1, 3, 1.0),
    "Mount": lambda s: planar.Mount(0),
    "PrimitiveTable": lambda s: planar.primitives_of([PlanarPart.box(1.0, 1.0)]),
    "DriveVelocities": lambda s: None,
    "AngleNoiseScanner": lambda s: planar.AngleNoiseScanner(
        TABLE["Fleet"](s), TABLE["Fan"](s), [planar.Mount(0)], np.zeros(1)
    ),
    "Layer": lambda s: costmap.StaticLayer(),
    "Costmap": lambda s: costmap.Costmap([], costmap.footprint_of(), width=1.0, height=1.0),
    "JointTree": lambda s: {},
    "Values": lambda s: {},
    "GlobalPlannerPlugin": lambda s: planners.NavfnPlanner("a", TABLE["Costmap"](s), {}),
    "LocalPlannerPlugin": lambda s: planners.DwaPlanner("a", TABLE["Costmap"](s), {}, 0.1),
    "Prediction": lambda s: ExtendedPrediction(),
    "System": lambda s: planar.DriveVelocities(TABLE["Fleet"](s).bodies),
    "Clock": lambda s: s.stage.clock,
    "MountedActuator": lambda s: s.stage.robot("r").mounted_actuators[0],
    "Gripper": lambda s: s.stage.gripper("r"),
    "Actuator": lambda s: s.stage.actuator("r"),
    "MountedCamera": lambda s: stage.cameras_of(s.stage.robot("r"))[0],
    "Maker": lambda s: lambda _simulation, _wanted: [],
    "Pose2": lambda s: (0.0, 0.0, 0.0),
}
IN_THE_PLANE = {"TopView", "film_plan", "stage_of", "take_plan"}
PATHS = {
    **dict.fromkeys(("film", "film_plan", "write_film"), "film.gif"),
    "load_stage": "devices.world",
    **dict.fromkeys(("take_picture", "take_plan"), "picture.png"),
}
"""Of calls that take files of one kind only."""
BY_NAME: dict[str, Callable[[Samples], Any]] = {
    "group": lambda s: "arm",
    "link": lambda s: "gripper_link" if s.package == "planning" else "burger::base_footprint",
    "joint": lambda s: "wrist_flex_joint",
    "effector": lambda s: "gripper",
    "path": lambda s: PATHS.get(s.called, "file"),
    "child": lambda s: "b",
    "command": lambda s: "open",
    "f": lambda s: s.bag.filename,
    "handler": lambda s: lambda request: None,
    "master_uri": lambda s: s.node.master_uri,
    "message_class": lambda s: TEXT,
    "request": lambda s: std_srvs.srv.TriggerRequest(),
    "service_class": lambda s: std_srvs.srv.Trigger,
    "source": lambda s: "b",
    "spec": lambda s: move_base_msgs.msg.MoveBaseAction,
    "uri": lambda s: s.node.master_uri,
    "type_": lambda s: "std_msgs/String",
    "name": lambda s: "r" if s.package == "stage" else "a",
    "kind": lambda s: "ModelStates" if s.package == "clients" else "a",
}
BY_WORD = {
    "Vector3": (0.0, 0.0, 1.0),
    "Color": (0.0, 0.0, 0.0, 1.0),
    "Quaternion": (0.0, 0.0, 0.0, 1.0),
    "tuple[float, float, float]": (0.0, 0.0, 1.0),
    "tuple[float, float]": (0.0, 1.0),
    "tuple[int, int]": (4, 4),
    "ArrayLike": 1.0,
    "Sequence": [],
    "Names": ["a"],
    "Mapping": {},
    "Path": Path("file"),
    "str": "a",
    "float": 1.0,
    "bool": True,
}
