"""The bundled Fetch before a table with a cube, under its controllers; and its hand."""

import contextlib

import numpy as np
import yaml

import gazelle
from gazelle import assets
from gazelle.description import Pose
from gazelle.planning import Group, ParallelHand, PlaceLocation, PlanOptions, box_grasps

FINGERS = ("l_gripper_finger_joint", "r_gripper_finger_joint")
HAND = ParallelHand(
    "gripper_link",
    dict.fromkeys(FINGERS, 0.05),
    dict.fromkeys(FINGERS, 0.0),
    width=0.1,
    depth=0.02,
    effort=60.0,
)
READY = {
    "torso_lift_joint": 0.3,
    "shoulder_lift_joint": -0.8,
    "elbow_flex_joint": 1.2,
    "wrist_flex_joint": 1.17,
}
CUBE, TOP = 0.06, 0.7


def controllers():
    """Return parameters of controllers by name, from the package's file."""
    file = assets.root() / "fetch_gazebo" / "config" / "default_controllers.yaml"
    return yaml.safe_load(file.read_text(encoding="utf-8"))


def start_controllers(robot):
    """Start the default controllers."""
    for name, parameters in controllers().items():
        robot.controllers.load(name, parameters)
        if name != "arm_with_torso_controller":
            robot.controllers.start(name)


@contextlib.contextmanager
def kitchen(x=0.65, y=-0.2, yaw=0.3):
    """Yield the robot with its arm ready, and the cube somewhere on the table."""
    with gazelle.Simulation("pick_and_place") as sim:
        robot = sim.spawn("fetch")
        start_controllers(robot)
        cube = sim.robots["demo_cube"]
        high = Group(robot, "arm_with_torso")  # the arm is stretched out above the table at first
        high.see()
        lifted = high.go(READY)
        assert lifted, lifted.message
        cube.set_pose((x, y, TOP + CUBE / 2.0), Pose(yaw=yaw).quaternion)
        sim.run(0.3)
        yield robot, cube


def carry(robot, cube, there, seed=0):
    """Move the cube elsewhere on the table; return its height on the way, and its error [m]."""
    arm = Group(robot, "arm", options=PlanOptions(seed=seed))
    arm.see()
    (thing,) = (name for name in arm.scene.objects if name.startswith("demo_cube"))
    found = arm.scene.objects[thing].pose
    taken = arm.pick(thing, box_grasps(HAND, found, (CUBE, CUBE, CUBE))).run()
    assert taken, taken.message
    height = cube.pose.z - TOP - CUBE / 2.0
    x, y, yaw = there
    goal = arm.base.inverse() * Pose(x, y, TOP + CUBE / 2.0 + 0.001, yaw=yaw)
    turns = (0.0, np.pi / 2.0, -np.pi / 2.0, np.pi)
    places = [PlaceLocation(goal * Pose(yaw=turn), open=HAND.open) for turn in turns]
    left = arm.place(thing, places).run()
    assert left, left.message
    robot.simulation.run(0.5)
    away = np.subtract(cube.pose.position, (x, y, TOP + CUBE / 2.0))
    return height, float(np.linalg.norm(away))


def errand(seed):
    """Return the cube's place (x, y, yaw), and its target."""
    random = np.random.default_rng(seed)
    ways = [(*random.uniform((0.6, -0.35), (0.75, 0.35)), random.uniform(-3, 3)) for _ in range(2)]
    return tuple(map(float, ways[0])), tuple(map(float, ways[1]))
