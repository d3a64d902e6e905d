"""Good files of each kind that Gazelle reads, to be broken."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import gazelle
from gazelle import formats
from gazelle.stage.format import is_stage


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
    **dict.fromkeys((".msg", ".srv", ".action"), ("words", "definition")),
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
    yield from _bags(folder / "bag")
    yield from _meshes(folder / "meshes")
    yield from _octomaps(folder / "octomap")
    yield from _packages(folder / "packages")
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


def _bags(folder: Path) -> Iterator[Seed]:
    """Write small bags: of words, and of a drive over a map, each in every compression."""
    from gazelle_ros import load_message
    from gazelle_ros.bags import Bag

    folder.mkdir()
    word, twist = load_message("std_msgs/String"), load_message("geometry_msgs/Twist")
    odometry, grid = load_message("nav_msgs/Odometry"), load_message("nav_msgs/OccupancyGrid")
    for compression in ("none", "bz2", "lz4"):
        for reader in ("bag", "driven_bag"):
            file = folder / f"{reader}-{compression}.bag"
            with Bag(str(file), "w", compression=compression, chunk_threshold=512) as bag:
                for count in range(20):
                    if reader == "bag":
                        bag.write("/words", word(data=str(count)))
                        bag.write("/cmd_vel", twist())
                    else:
                        bag.write("/odom", odometry(child_frame_id="base"))
                if reader == "driven_bag":
                    plan = grid(data=[0, 100, -1, 0])
                    plan.info.width = plan.info.height = 2
                    plan.info.resolution = 0.5
                    bag.write("/map", plan)
            yield Seed(file, "bytes", reader)


def _meshes(folder: Path) -> Iterator[Seed]:
    """Write a mesh in each format that no file of the repository has."""
    import trimesh

    folder.mkdir()
    torus = trimesh.creation.torus(0.3, 0.1, 8, 6)
    for suffix, family in MESH_FAMILIES.items():
        options = {"embed_buffers": True, "merge_buffers": True} if suffix == "gltf" else {}
        content = torus.export(file_type=suffix, **options)
        if isinstance(content, dict):
            content = content["model.gltf"]
        file = folder / f"torus.{suffix}"
        file.write_bytes(content.encode() if isinstance(content, str) else content)
        yield Seed(file, family, "mesh")
    plain = folder / "plain.ply"
    plain.write_bytes(torus.export(file_type="ply", encoding="ascii"))
    yield Seed(plain, "words", "mesh")


def _octomaps(folder: Path) -> Iterator[Seed]:
    """Write maps as OctoMap does."""
    from gazelle_ros.builtin.octomap.codec import binary_tree, full_tree

    folder.mkdir()
    codes = np.arange(40, dtype=np.int64) * 3 + (7 << 45)
    values = np.linspace(-2.0, 2.0, len(codes), dtype=np.float32)
    trees = {"bt": binary_tree(codes, values >= 0.0), "ot": full_tree(codes, values)}
    for suffix, data in trees.items():
        kind = "binary file" if suffix == "bt" else "file"
        head = f"# Octomap OcTree {kind}\nid OcTree\nsize {len(codes)}\nres 0.05\ndata\n"
        file = folder / f"map.{suffix}"
        file.write_bytes(head.encode() + data)
        yield Seed(file, "bytes", "octomap")


def _packages(folder: Path) -> Iterator[Seed]:
    """Write files of a catkin package that the corpus has few of."""
    for name, (content, family, reader) in PACKAGE_FILES.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(content)
        yield Seed(file, family, reader)


MESH_FAMILIES = {"off": "words", "ply": "bytes", "glb": "bytes", "gltf": "json", "3mf": "archive"}
PACKAGE_FILES = {
    "setup/setup.py": (
        (
            "from distutils.core import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\n"
            "where = {'': 'src'}\nnames = ['robot', 'robot.arm'] + ['tools']\n"
            "d = generate_distutils_setup(packages=names, package_dir=where, scripts=['bin/a'])\nsetup(**d)\n"
        ),
        "words",
        "python_setup",
    ),
    "action/Cook.action": (
        (
            "# goal\nuint8 RARE=1\nstring NAME = a # b\nstring[] dishes\nfloat64[3] size\n---\n"
            "geometry_msgs/PoseStamped place\ntime done\n---\nHeader header\nuint8[16] code\n"
        ),
        "words",
        "definition",
    ),
    "controllers/arm_controllers.yaml": (
        (
            "joint_state_controller: {type: joint_state_controller/JointStateController, publish_rate: 50}\n"
            "arm:\n  type: effort_controllers/JointTrajectoryController\n  joints: [shoulder_pan_joint]\n"
            "  gains: {shoulder_pan_joint: {p: 100, i: 1, d: 10, i_clamp: 1}}\n  constraints: {goal_time: 1}\n"
            "head:\n  type: position_controllers/JointPositionController\n  joint: head_pan_joint\n"
            "base:\n  type: diff_drive_controller/DiffDriveController\n  left_wheel: l_wheel_joint\n"
            "  right_wheel: r_wheel_joint\n  linear: {x: {has_velocity_limits: true, max_velocity: 1.0}}\n"
        ),
        "yaml",
        "controllers",
    ),
    "move_base/planner_params.yaml": (
        (
            "base_local_planner: teb_local_planner/TebLocalPlannerROS\ncontroller_frequency: 5.0\n"
            "recovery_behaviors: [{name: a, type: clear_costmap_recovery/ClearCostmapRecovery}]\n"
            "TebLocalPlannerROS: {max_vel_x: 0.4, footprint_model: {type: line, line_start: [0, 0], "
            "line_end: [0.4, 0.0]}, dt_ref: 0.3}\n"
            "local_costmap:\n  plugins: [{name: o, type: 'costmap_2d::ObstacleLayer'}]\n  width: 4.0\n"
            "  footprint: [[0.1, 0.1], [0.1, -0.1], [-0.1, 0.0]]\n  resolution: 0.05\n  rolling_window: true\n"
            "  o: {observation_sources: scan, scan: {data_type: LaserScan, topic: scan, marking: true}}\n"
            "global_costmap: {global_frame: map, inflation_radius: 0.5, cost_scaling_factor: 10}\n"
        ),
        "yaml",
        "navigation",
    ),
    "table/table.csv": (
        "time,speed,name\n0,1.5,a\n1,2.5,b\n2,nan,c\n3,-1e3,d\n",
        "words",
        "table",
    ),
}


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
    from gazelle.training import PPOSettings, Recipe, pack_run, train

    recipe = Recipe(
        steps=512,
        num_envs=8,
        net_arch=(16,),
        settings=PPOSettings(n_steps=16, batch_size=32, n_epochs=1),
    )
    (folder / "archive").mkdir(parents=True)
    trained = train("TurtleBot3Stage1", recipe=recipe, out=folder).run.folder
    yield Seed(trained / "config.json", "json", "run")
    yield Seed(trained / "progress.csv", "words", "run")
    for file in sorted(trained.glob("checkpoints/*/*")):
        family = {".npz": "archive", ".json": "json"}.get(file.suffix, "bytes")
        yield Seed(file, family, "checkpoint")
    yield Seed(pack_run(trained, folder / "archive" / "run.zip"), "archive", "run_archive")
    alone = folder / "policy"
    alone.mkdir()
    shutil.copy(trained / "policy.npz", alone / "policy.npz")
    contract = json.loads((trained / "contract.json").read_text(encoding="utf-8"))
    (alone / "policy.json").write_text(json.dumps(contract))
    yield Seed(alone / "policy.npz", "archive", "policy")
    yield Seed(alone / "policy.json", "json", "policy")
