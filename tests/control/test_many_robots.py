"""Robots whose controllers steps carry do what they do under Python, whatever happens to them, bit by bit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

import gazelle
from gazelle import formats
from gazelle.control.values import JointTargets
from gazelle.description import World

JOINTS = tuple(f"joint_{number}" for number in range(6))
GAINS = {"p": 60.0, "i": 30.0, "d": 4.0, "i_clamp": 5.0}
PID = {
    "type": "effort_controllers/JointGroupPositionController",
    "joints": list(JOINTS),
    **{name: {"pid": GAINS} for name in JOINTS},
}
EFFORTS = {"type": "effort_controllers/JointGroupEffortController", "joints": list(JOINTS)}


def arm_model(*, soft=False):
    """Return six joints, too many for one vector: the second slides, the last is continuous."""
    parts, parent = ['<robot name="arm"><link name="world"/>'], "world"
    safety = '<safety_controller k_velocity="20" k_position="15" soft_lower_limit="-2" soft_upper_limit="2"/>'
    for number, name in enumerate(JOINTS):
        kind = {1: "prismatic", 5: "continuous"}.get(number, "revolute")
        parts.append(
            f'<link name="link_{number}"><inertial><origin xyz="0 0 -0.1"/><mass value="1"/><inertia '
            'ixx="0.06" iyy="0.06" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="link_{number}"/>'
            f'<origin xyz="0 0 {2.0 if number == 0 else -0.2}"/><axis xyz="{number % 2} 1 0"/>'
            '<limit lower="-2.5" upper="2.5" effort="30" velocity="3"/>'
            f'{safety if soft else ""}<dynamics damping="0.5"/></joint><transmission name="t{number}">'
            f'<type>transmission_interface/SimpleTransmission</type><joint name="{name}">'
            "<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>"
            f'<actuator name="m{number}"/></transmission>'
        )
        parent = f"link_{number}"
    parts.append('<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo></robot>')
    return formats.load_model_string("".join(parts))


MODELS = [arm_model(), arm_model(soft=True)]


class Lab:
    """Robots of one world or several, to which things are done."""

    def __init__(self, nworld, *, native, threads):
        self.sim = gazelle.Simulation(World("lab"), nworld=nworld, threads=threads)
        if not native:
            self.sim.controls_in_step = False
        self.kept = None
        for _ in range(2):
            self.spawn()

    def spawn(self):
        number = len(self.sim.robots)
        robot = self.sim.spawn(MODELS[number % 2], f"arm_{number}", gazelle.Pose(x=3.0 * number))
        robot.controllers.load("pid", PID)
        robot.controllers.load("efforts", EFFORTS)
        self.kept = None  # a snapshot is of the robots that there were

    def do(self, what, which, number):
        robots = [*self.sim.robots.values()]
        robot = robots[which % len(robots)]
        if what in ("start", "stop", "command", "place"):
            self.do_to_robot(what, robot, which, number)
        elif what == "reset":
            self.sim.reset([which % self.sim.nworld] if which % 3 else None)
        elif what == "keep":
            self.kept = self.sim.snapshot()
        elif what == "put back" and self.kept is not None:
            self.sim.restore(self.kept)
        elif what == "spawn" and len(robots) < 4:
            self.spawn()
        elif what == "delete" and len(robots) > 1:
            self.sim.delete(robot.name)
            self.kept = None
        self.sim.step(1 + which % 25)
        return {
            name: np.array([each.joints[joint].positions() for joint in JOINTS])
            for name, each in self.sim.robots.items()
        }

    def do_to_robot(self, what, robot, which, number):
        manager = robot.controllers
        running = [name for name in ("pid", "efforts") if manager.state_of(name) == "running"]
        if what == "start":
            wanted = ("pid", "efforts")[which % 2]
            if wanted not in running:
                manager.switch([wanted], running)
        elif what == "stop" and running:
            manager.stop(*running)
        elif what == "command":
            values = tuple(np.sin(number * np.arange(1, 7)) * 4.0)
            world = np.array([which % self.sim.nworld])
            for name in ("pid", "efforts"):
                manager[name].inputs["command"].send(JointTargets(values), world)
        elif what == "place":
            robot.joints[JOINTS[which % 6]].position = 0.2 * number


DEEDS = (
    "start",
    "stop",
    "command",
    "reset",
    "keep",
    "put back",
    "spawn",
    "delete",
    "place",
    "wait",
)


@pytest.mark.long
@settings(max_examples=8, phases=(Phase.explicit, Phase.generate))  # shrinking takes long
@given(
    st.integers(1, 3),
    st.lists(
        st.tuples(st.sampled_from(DEEDS), st.integers(0, 60), st.floats(-3.0, 3.0)),
        min_size=4,
        max_size=12,
    ),
)
def test_whatever_is_done_to_them(nworld, deeds):
    carried = Lab(nworld, native=True, threads=2)
    alone = Lab(nworld, native=False, threads=1)
    for what, which, number in [("start", 0, 0.0), ("command", 3, 0.7), *deeds]:
        seen, wanted = (lab.do(what, which, number) for lab in (carried, alone))
        assert seen.keys() == wanted.keys()
        for name, found in seen.items():
            assert found.tobytes() == wanted[name].tobytes(), (what, name)


def test_what_a_robot_does_does_not_depend_on_others_or_threads():
    positions = []
    for nworld, robots, threads in ((1, 1, 1), (3, 1, 2), (2, 3, 2)):
        lab = Lab(nworld, native=True, threads=threads)
        while len(lab.sim.robots) < robots:
            lab.spawn()
        for name in [*lab.sim.robots][robots:]:
            lab.sim.delete(name)
        for robot in lab.sim.robots.values():
            robot.controllers.start("pid")
            robot.controllers["pid"].inputs["command"].send(JointTargets((0.4,) * 6))
        lab.sim.step(300)
        first = lab.sim.robots["arm_0"]
        positions += [first.joints[name].positions()[-1].tobytes() for name in JOINTS]
    assert positions[:6] == positions[6:12] == positions[12:]
