"""Readers of a file of each kind that Gazelle reads, and the kinds of files.

Readers return nothing; they raise what Gazelle raises.
"""

from __future__ import annotations

import contextlib
import functools
import json
import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import gazelle
import gazelle_ros
from gazelle import formats
from gazelle.formats.lint import lint
from gazelle.stage.format import is_stage
from gazelle_ros.base.text_files import read_text

ARM = "fetch"
"""The bundled robot that parameters of arms are read for."""

MESHED = """<sdf version='1.6'><world name='w'><model name='s'><static>1</static><link name='l'>
<collision name='c'><geometry><mesh><uri>{0}</uri></mesh></geometry></collision><visual name='v'><geometry>
<mesh><uri>{0}</uri></mesh></geometry></visual></link></model><model name='m'><pose>9 0 9 0 0 0</pose>
<link name='l'><collision name='c'><geometry><mesh><uri>{0}</uri></mesh></geometry></collision></link>
</model></world></sdf>"""
PAINTED = """<sdf version='1.6'><world name='w'><model name='m'><static>1</static><link name='l'>
<visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material><script><uri>{0}</uri>
<name>{1}</name></script></material></visual></link></model></world></sdf>"""
HILLS = """<sdf version='1.6'><world name='w'><model name='m'><static>1</static><link name='l'>
<collision name='c'><geometry><heightmap><uri>{0}</uri><size>9 9 2</size></heightmap></geometry></collision>
</link></model></world></sdf>"""
MAPPED = "image: {0}\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"


@dataclass(frozen=True)
class Seed:
    """A good file.

    Attributes:
        file: Where it is.
        family: Of `structured_mutations.FAMILIES`.
        reader: Of `READERS`.
    """

    file: Path
    family: str
    reader: str


def simulated(world: gazelle.description.World) -> None:
    """Run a step, and draw a picture."""
    from gazelle.sensors import View, look_at

    if not any(placed.model.links for model in world.models for placed in model.walk()):
        return
    with gazelle.Simulation(world) as sim:
        sim.step(1)
        sim.render(View(look_at((3.0, 3.0, 3.0), (0.0, 0.0, 0.0)), 8, 8))


def description(path: Path) -> None:
    """Check, load, lint, write, run."""
    world = formats.load(path)
    lint(world)
    formats.to_string(world, "sdf")
    simulated(world)


def robot(path: Path) -> None:
    """Read a robot like `description`, and plan."""
    from gazelle.kinematics import RobotModel

    description(path)
    model = formats.load_model(path)
    formats.to_string(model, "urdf")
    RobotModel(model)


def stage(path: Path) -> None:
    """Run a step of Stage's world."""
    from gazelle.stage import StageSimulation

    formats.check(path)
    with StageSimulation(path) as sim:
        sim.step(1)


def stage_part(path: Path) -> None:
    """Read a file that a world includes."""
    world = path.with_name("mutated_including.world")
    world.write_text(f'include "{path.name}"\nfloorplan model()\n')
    stage(world)


def occupancy(path: Path) -> None:
    """Read a map, and its world."""
    formats.load_map(path)
    simulated(formats.load(path))


def map_picture(path: Path) -> None:
    """Read the picture of a map."""
    about = path.with_name("mutated_about.yaml")
    about.write_text(MAPPED.format(path.name))
    occupancy(about)


def _world_around(path: Path, text: str) -> None:
    world = path.with_name("mutated_around.world")
    world.write_text(text)
    description(world)


def mesh(path: Path) -> None:
    """Read a body that moves and one that does not."""
    _world_around(path, MESHED.format(path.name))


def texture(path: Path) -> None:
    """Read a picture as elevations and as colour."""
    _world_around(path, HILLS.format(path.name))


def material(path: Path) -> None:
    """Read a script of materials."""
    found = re.search(rb"^material\s+(\w+)", path.read_bytes(), re.MULTILINE)
    name = found[1].decode("ascii", "replace") if found else "a"
    _world_around(path, PAINTED.format(path.name, name))


def model_folder(path: Path) -> None:
    """Read the manifest of a model."""
    description(path.parent)


def semantics(path: Path) -> None:
    """Read an SRDF, with its robot."""
    from gazelle.kinematics import RobotModel

    formats.check(path, urdf=ARM)
    RobotModel(formats.load_model(ARM), formats.load_srdf(path))


def launch(path: Path) -> None:
    """Read a launch file; nothing is started."""
    from gazelle_ros.launch import Packages, describing, load_launch

    packages = Packages()
    plan = load_launch(path)
    describing.summary(plan)
    describing.arguments(plan)
    describing.parameters(plan, packages)
    for node in plan.nodes:
        with contextlib.suppress(gazelle.Error):  # most packages are not there
            describing.command(node, packages, "http://localhost:1")


def manifest(path: Path) -> None:
    """Read a package's manifest, with all of its readers."""
    from gazelle.formats.packages import exported_model_paths
    from gazelle_ros.base.package_folders import package_name
    from gazelle_ros.compat.rospkg import InvalidManifest
    from gazelle_ros.compat.rospkg.manifest import parse_manifest_file

    package_name(path.parent)
    list(exported_model_paths(path.parent))
    formats.Resolver([path.parent]).find("model://no_such")
    with contextlib.suppress(InvalidManifest):  # rospkg's own
        parse_manifest_file(str(path.parent)).get_export("gazebo_ros", "plugin_path")


@functools.cache
def _graph() -> tuple[gazelle_ros.Master, gazelle_ros.Node]:
    from gazelle_ros import Master, Node

    master = Master(port=0)
    return master, Node("reader", master_uri=master.uri)


def rosparam(path: Path) -> None:
    """Read a file as ``rosparam load`` does."""
    from gazelle_ros.tools import params
    from gazelle_ros.tools.graph import GraphInspector

    with GraphInspector("reader", _graph()[0].uri) as graph:
        params.load_parameters(graph, str(path), "/given")


def controllers(path: Path) -> None:
    """Read controllers, of a robot."""
    from gazelle.control.checking import check_controllers, is_controllers

    rosparam(path)
    is_controllers(path)
    check_controllers(path, ARM)


def joint_limits(path: Path) -> None:
    """Read limits of an arm's joints, and MoveIt's other parameters."""
    from gazelle.bridges.moveit.description import margins_of_parameters, robot_of_parameters
    from gazelle_ros.launch.values import load_yaml

    _, node = _graph()
    node.set_param("/robot_description", formats.to_string(formats.load_model(ARM), "urdf"))
    node.set_param("/robot_description_semantic", "<robot name='fetch'/>")
    node.set_param("/robot_description_planning", load_yaml(read_text(path)))
    margins_of_parameters(node, robot_of_parameters(node))


def navigation(path: Path) -> None:
    """Read parameters of navigation."""
    from gazelle.navigation.move_base import navigation_stack
    from gazelle.navigation.usual_parameters import USUAL, merged
    from gazelle_ros.launch.values import load_yaml

    navigation_stack(merged(USUAL, load_yaml(read_text(path))))


def bag(path: Path) -> None:
    """Describe, read and check a bag."""
    from gazelle_ros.bags import Bag
    from gazelle_ros.bags.info import describe
    from gazelle_ros.bags.operations import check, fix_bag

    check(str(path))
    fix_bag(str(path), str(path.with_name("mutated_fixed.bag")), force=True)
    with Bag(str(path)) as opened:
        describe(opened)
        for _ in opened.read_messages():
            pass


def recording(path: Path) -> None:
    """Do a recorded run again."""
    from gazelle.simulation import Replay

    with Replay(path) as replay:
        replay.run()


def policy(path: Path) -> None:
    """Read a policy and its contract."""
    from gazelle.training.actor import load_actor
    from gazelle.training.policy_files import load_policy

    file, contract = load_policy(path.with_suffix(".npz"))
    actor = load_actor(file)
    actor.act(np.zeros((1, actor.inputs), np.float32), np.random.default_rng(0))
    contract.to_dict()


def run(path: Path) -> None:
    """Read the folder of a training: open, evaluate, resume."""
    from gazelle.training import evaluate, resume
    from gazelle.viewer.plots import plot_trainings

    evaluate(path.parent, episodes=1)
    plot_trainings([path.parent], path.parent / "plot.png")
    resume(path.parent, steps=1024)


def checkpoint(path: Path) -> None:
    """Read the newest checkpoint of a run."""
    from gazelle.training import resume

    resume(path.parent.parent.parent, steps=1024)


def sweep(path: Path) -> None:
    """Read the plan of a sweep."""
    from gazelle.training.sweep_plan import SweepPlan

    SweepPlan.read(path)


READERS: dict[str, Callable[[Path], None]] = {
    each.__name__: each
    for each in (
        *(description, robot, stage, stage_part, occupancy, map_picture, mesh, texture, material),
        *(model_folder, semantics, launch, rosparam, controllers, joint_limits, navigation, bag),
        *(manifest, recording, policy, run, checkpoint, sweep),
    )
}

_BY_SUFFIX = {
    **dict.fromkeys((".sdf", ".world", ".gazebo"), ("xml", "description")),
    ".urdf": ("xml", "robot"),
    ".xacro": ("xml", "robot"),
    ".inc": ("words", "stage_part"),
    ".launch": ("xml", "launch"),
    ".srdf": ("xml", "semantics"),
    ".dae": ("xml", "mesh"),
    ".stl": ("bytes", "mesh"),
    ".obj": ("words", "mesh"),
    ".pgm": ("bytes", "map_picture"),
    ".material": ("words", "material"),
    **dict.fromkeys((".png", ".jpg", ".tga", ".bmp"), ("bytes", "texture")),
}
_BY_NAME = {"model.config": "model_folder", "package.xml": "manifest"}
_YAML = {
    "joint_limits": "joint_limits",
    "control": "controllers",
    "joint": "controllers",
    "costmap": "navigation",
    "planner": "navigation",
    "move_base": "navigation",
}
_LARGEST = 200_000


def seeds(folder: Path) -> Iterator[Seed]:
    """Yield good files below a folder, none of them large."""
    for file in sorted(folder.rglob("*")):
        if not file.is_file() or file.is_symlink() or not 0 < file.stat().st_size <= _LARGEST:
            continue
        found = _kind(file)
        if found is not None:
            yield Seed(file, *found)


def _kind(file: Path) -> tuple[str, str] | None:
    suffix = file.suffix.lower()
    if file.name in _BY_NAME:
        return "xml", _BY_NAME[file.name]
    if suffix == ".world" and is_stage(file.read_bytes(), suffix):
        return "words", "stage"
    if file.name.endswith(".launch.xml"):
        return "xml", "launch"
    if suffix in (".yaml", ".yml"):
        if b"occupied_thresh" in file.read_bytes():
            return "yaml", "occupancy"
        return "yaml", next((r for word, r in _YAML.items() if word in file.name), "rosparam")
    return _BY_SUFFIX.get(suffix)


def make_seeds(folder: Path) -> Iterator[Seed]:
    """Write files that only Gazelle writes: a bag, a recording, a policy, a run, small meshes."""
    import mutations

    small = folder / "small"
    small.mkdir()
    mutations.prepare(small)
    for name, (content, _) in mutations.SEEDS.items():
        (small / name).write_bytes(mutations.as_bytes(content))
    yield from seeds(small)
    yield Seed(_bag(folder / "bag"), "bytes", "bag")
    for engine in ("mujoco", "planar"):
        yield Seed(_recording(folder / engine, engine), "json", "recording")
    yield from _map_pictures(folder / "pictures")
    yield from _run(folder / "run")
    plan = folder / "sweep" / "sweep.yaml"
    plan.parent.mkdir()
    plan.write_text(
        "trials: 2\nparameters:\n  gamma: {low: 0.9, high: 0.99}\n  lr: {choices: [1, 2]}\n"
    )
    yield Seed(plan, "yaml", "sweep")


def _bag(folder: Path) -> Path:
    from gazelle_ros import load_message
    from gazelle_ros.bags import Bag

    folder.mkdir()
    word, twist = load_message("std_msgs/String"), load_message("geometry_msgs/Twist")
    with Bag(str(folder / "a.bag"), "w", compression="bz2", chunk_threshold=512) as bag:
        for count in range(20):
            bag.write("/words", word(data=str(count)))
            bag.write("/cmd_vel", twist())
    return folder / "a.bag"


def _recording(folder: Path, engine: str) -> Path:
    folder.mkdir()
    file = folder / "run.jsonl"
    burger = formats.load_model("turtlebot3_burger")
    with gazelle.Simulation(burger, engine, nworld=2) as sim, sim.record(file):
        robot = sim.robots["turtlebot3_burger"]
        robot.inputs["cmd_vel"].send(linear=0.2, angular=0.1)
        sim.step(20)
        robot.set_pose((0.0, 1.0, 0.1))
        sim.spawn(burger, name="other", pose=gazelle.Pose(2.0, 0.0, 0.1))
        sim.step(3)
        next(iter(robot.links.values())).set_twist(
            (0.1, 0.0, 0.0), (0.0, 0.0, 0.1), worlds=np.array([1])
        )
        sim.delete("other")
        sim.reset([0])
        sim.step(3)
    return file


def _map_pictures(folder: Path) -> Iterator[Seed]:
    """Write the picture of a map in each format that maps have."""
    from PIL import Image

    folder.mkdir()
    rows = np.full((12, 16), 254, np.uint8)
    rows[:, 0], rows[3, 4:9] = 0, 205
    for suffix in ("png", "bmp", "jpg", "gif", "tif", "pgm"):
        file = folder / f"map.{suffix}"
        Image.fromarray(rows).save(file)
        yield Seed(file, "bytes", "map_picture")


def _run(folder: Path) -> Iterator[Seed]:
    from gazelle.training import PPOSettings, Recipe, train

    recipe = Recipe(
        steps=512,
        num_envs=8,
        net_arch=(16,),
        settings=PPOSettings(n_steps=16, batch_size=32, n_epochs=1),
    )
    trained = train("TurtleBot3Stage1", recipe=recipe, out=folder).run.folder
    yield Seed(trained / "config.json", "json", "run")
    yield Seed(trained / "progress.csv", "words", "run")
    for file in sorted(trained.glob("checkpoints/*/*")):
        family = {".npz": "archive", ".json": "json"}.get(file.suffix, "bytes")
        yield Seed(file, family, "checkpoint")
    alone = folder / "policy"
    alone.mkdir()
    shutil.copy(trained / "policy.npz", alone / "policy.npz")
    contract = json.loads((trained / "contract.json").read_text(encoding="utf-8"))
    (alone / "policy.json").write_text(json.dumps(contract))
    yield Seed(alone / "policy.npz", "archive", "policy")
    yield Seed(alone / "policy.json", "json", "policy")
