"""Readers of files of ROS graphs and of learning, and all readers by name.

Readers return nothing; they raise what Gazelle raises.
"""

from __future__ import annotations

import contextlib
import functools
import io
from collections.abc import Callable, Iterator
from pathlib import Path

import mutated_readers
import numpy as np
from mutated_readers import ARM

import gazelle
import gazelle_ros
from gazelle import formats
from gazelle_ros.base.text_files import read_text


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


def definition(path: Path) -> None:
    """Make the classes of a message, a service or an action."""
    from gazelle_ros.messages.library import PackageDefinitions, bundled
    from gazelle_ros.messages.registry import Registry
    from gazelle_ros.messages.search import read_definitions

    def find(package: str) -> Iterator[PackageDefinitions]:
        if package == "mutated":
            yield read_definitions(path.parent.parent)
        elif (known := bundled(package)) is not None:
            yield known

    registry, name = Registry(find), f"mutated/{path.stem}"
    if path.suffix == ".srv":
        registry.service(name)
        return
    for part in ("Action", "ActionGoal") if path.suffix == ".action" else ("",):
        data = io.BytesIO()
        message = registry.message(name + part)()
        message.serialize(data)
        message.deserialize(data.getvalue())


def octomap(path: Path) -> None:
    """Read a file of OctoMap, and the trees that are sent of it."""
    from gazelle_ros.builtin.octomap.codec import binary_tree, full_tree
    from gazelle_ros.builtin.octomap.reader import read_octomap

    found = read_octomap(path)
    trees = binary_tree(found.codes, found.values >= 0.0), full_tree(found.codes, found.values)
    for data, binary in zip(trees, (True, False), strict=True):
        formats.Octree(found.resolution, data, binary).cuboids()


def python_setup(path: Path) -> None:
    """Read where a package has its Python code."""
    from gazelle_ros.compat.setup_files import python_code

    python_code(path.parent)


def driven_bag(path: Path) -> None:
    """Plot paths, a series and the map of a bag; read it like any other."""
    from gazelle.viewer.bag_plots import bag_map, bag_paths, bag_series

    for look in (bag_map, bag_paths, lambda file: bag_series(file, ["/odom/twist/twist/linear/x"])):
        with contextlib.suppress(gazelle.Error):
            look(path)
    bag(path)


def run_archive(path: Path) -> None:
    """Unpack a run that was exported, list it, evaluate it."""
    from gazelle.training import evaluate, list_runs, unpack_run

    unpacked = unpack_run(path, path.parent / "unpacked")
    list_runs(path.parent / "unpacked")
    evaluate(unpacked.folder, episodes=1)


def table(path: Path) -> None:
    """Plot a table."""
    from gazelle.viewer.plots import plot_table

    plot_table(path, [], path.with_name("mutated_plot.png"))


_DESCRIPTIONS = (
    *("description", "robot", "stage", "stage_part", "occupancy", "map_picture", "mesh"),
    *("texture", "material", "model_folder", "semantics"),
)
READERS: dict[str, Callable[[Path], None]] = {
    **{name: getattr(mutated_readers, name) for name in _DESCRIPTIONS},
    **{
        each.__name__: each
        for each in (
            *(launch, rosparam, controllers, joint_limits, navigation, bag, driven_bag, manifest),
            *(definition, octomap, python_setup, recording, policy, run, run_archive, checkpoint),
            *(sweep, table),
        )
    },
}
