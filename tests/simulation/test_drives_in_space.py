"""Drives of many robots in three dimensions act and publish at once: the bits of each alone."""

import functools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from looks import count_looks

import gazelle
from gazelle import formats
from gazelle.description import Pose
from gazelle.errors import PluginWarning
from gazelle.simulation import JointArray, ModelPlugin, PluginSystem, TwistInput, register

SOLID = """<inertial><mass>{0}</mass><inertia><ixx>{1}</ixx><iyy>{1}</iyy><izz>{1}</izz><ixy>0</ixy><ixz>0</ixz>
<iyz>0</iyz></inertia></inertial>"""
WHEEL = """<link name='{0}'><pose>{1} {2} .05 -1.5708 0 0</pose>{3}<collision name='c'><geometry><sphere>
<radius>.05</radius></sphere></geometry></collision></link><joint name='{0}_joint' type='continuous'>
<parent>{4}</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
FORK = """<link name='{0}'><pose>{1} {2} .05 0 0 0</pose>{3}</link><joint name='{0}_joint' type='continuous'>
<parent>{4}</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
ROBOT = """<model name='{0}'><pose>{1} {2} 0 0 0 {1}</pose><link name='base'><pose>.03 0 .1 0 0 {3}</pose>{4}
<collision name='b'><geometry><box><size>.3 .2 .05</size></box></geometry></collision>{6}</link>{5}</model>"""
GROUND = """<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>"""
PLACES = {"left": (0.0, 0.12), "right": (0.0, -0.12), "left_front": (0.1, 0.12),
          "right_front": (0.1, -0.12), "left_rear": (-0.1, 0.12), "right_rear": (-0.1, -0.12),
          "fork": (0.1, 0.0), "front": (0.1, 0.0)}  # fmt: skip
CORNERS = tuple(PLACES)[2:6]
SIZES = "<wheelSeparation>.24</wheelSeparation><wheelDiameter>.1</wheelDiameter><updateRate>20</updateRate>"
DIFF = "<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>" + SIZES
TRICYCLE = (
    "<steeringJoint>fork_joint</steeringJoint><actuatedWheelJoint>front_joint</actuatedWheelJoint>"
    "<actuatedWheelDiameter>.1</actuatedWheelDiameter><encoderWheelDiameter>.1</encoderWheelDiameter>"
    "<encoderWheelLeftJoint>left_joint</encoderWheelLeftJoint><updateRate>20</updateRate>"
    "<encoderWheelRightJoint>right_joint</encoderWheelRightJoint>"
)
ENCODERS = "<odometrySource>encoder</odometrySource>"
KOBUKI = """<left_wheel_joint_name>left_joint</left_wheel_joint_name><wheel_diameter>.1</wheel_diameter>
<right_wheel_joint_name>right_joint</right_wheel_joint_name><wheel_separation>.24</wheel_separation>
<torque>5</torque><velocity_command_timeout>.2</velocity_command_timeout><imu_name>imu</imu_name>
<cliff_detection_threshold>.2</cliff_detection_threshold><bumper_name>bumper</bumper_name>""" + "".join(
    f"<cliff_sensor_{side}_name>{side}</cliff_sensor_{side}_name>"
    for side in ("left", "center", "right")
)
SPREAD = (
    "<noise type='gaussian'><mean>0</mean><stddev>.01</stddev><bias_mean>.02</bias_mean></noise>"
)
SENSORS = f"""<sensor name='imu' type='imu'><update_rate>30</update_rate><imu><angular_velocity><z>{SPREAD}</z>
</angular_velocity></imu></sensor><sensor name='bumper' type='contact'><contact><collision>b</collision></contact>
</sensor>""" + "".join(
    f"<sensor name='{side}' type='ray'><pose>.1 {y} 0 0 1.5708 0</pose><ray><scan><horizontal><samples>1</samples>"
    "</horizontal></scan><range><min>.01</min><max>1</max></range></ray></sensor>"
    for side, y in (("left", 0.05), ("center", 0.0), ("right", -0.05))
)  # fmt: skip
KINDS = {
    "diff": (
        "libgazebo_ros_diff_drive.so",
        ("left", "right"),
        DIFF + "<wheelAcceleration>.6</wheelAcceleration>"
        "<publishWheelJointState>1</publishWheelJointState>",
    ),
    "at every step": (
        "libgazebo_ros_diff_drive.so",
        ("left", "right"),
        DIFF.replace(">20<", ">0<"),
    ),
    "skid": ("libgazebo_ros_skid_steer_drive.so", CORNERS, SIZES),
    "built in": (
        "libDiffDrivePlugin.so",
        ("left", "right"),
        "<left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>",
    ),
    "encoders": (
        "libgazebo_ros_diff_drive.so",
        ("left", "right"),
        DIFF + ENCODERS + "<publishWheelTF>1</publishWheelTF>",
    ),
    "tricycle": (
        "libgazebo_ros_tricycle_drive.so",
        ("fork", "front", "left", "right"),
        TRICYCLE + "<publishWheelJointState>1</publishWheelJointState>",
    ),
    "slow tricycle": (
        "libgazebo_ros_tricycle_drive.so",
        ("fork", "front", "left", "right"),
        TRICYCLE + ENCODERS + "<steeringSpeed>.8</steeringSpeed>"
        "<wheelAcceleration>9</wheelAcceleration>",
    ),
    "slide": ("libgazebo_ros_planar_move.so", ("left",), "<odometryRate>30</odometryRate>"),
    "patient": ("libgazebo_ros_planar_move.so", ("left",), "<cmdTimeout>.1</cmdTimeout>"),
    "kobuki": ("libgazebo_ros_kobuki.so", ("left", "right"), KOBUKI),
}


def part_of_drive(name):
    parent = "fork" if name == "front" else "base"
    form = FORK if name == "fork" else WHEEL
    return form.format(name, *PLACES[name], SOLID.format(0.3, 4e-4), parent)


def robot(number, plugin):
    file, wheels, tags = plugin
    made = "".join(part_of_drive(name) for name in wheels)
    drive = f"<plugin name='drive' filename='{file}'>{tags}</plugin>"
    place, solid = (0.6 * number, 0.3 * number, 0.2 * (number % 2)), SOLID.format(3, 0.03)
    sensors = SENSORS if file == KINDS["kobuki"][0] else ""
    return ROBOT.format(f"r{number}", *place, solid, made + drive, sensors)


def yard(plugin, *, together=True, nworld=1):
    """Return three robots on a ground; without ``together`` each is updated by itself."""
    physics = "<physics name='p' type='ode'><max_step_size>.01</max_step_size></physics>"
    robots = "".join(robot(number, plugin) for number in range(3))
    text = f"<sdf version='1.7'><world name='w'>{physics}{GROUND}{robots}</world></sdf>"
    sim = gazelle.Simulation(formats.load_string(text), "mujoco", nworld=nworld, threads=1)
    sim.plugin, sim.together = plugin, together
    part(sim)
    return sim


def part(sim):
    for entry in [] if sim.together else sim.entities.plugins:
        entry.alone = True


def moving(sim):
    return [each for each in sim.robots.values() if each.inputs]


def listen(sim, heard, number):
    """Record what a robot publishes, in the order of its topics."""
    each = moving(sim)[number % len(moving(sim))]

    def note(name, value):
        arrays = [each for each in vars_of(value) if isinstance(each, np.ndarray)]
        bits = tuple(np.ascontiguousarray(array).tobytes() for array in arrays)
        heard.setdefault((each.name, name), []).append((value.stamp, *bits))

    for name, output in each.outputs.items():
        output.subscribe(functools.partial(note, name))


def vars_of(value):
    return [getattr(value, name) for name in value.__slots__]


SPEED = st.floats(-0.6, 0.6).map(lambda value: round(value, 3))
WHICH = st.integers(0, 4)
ACTS = st.one_of(
    st.tuples(st.just("run"), st.sampled_from([0.01, 0.07, 0.15])),
    st.tuples(st.just("send"), WHICH, SPEED, SPEED),
    st.tuples(st.just("listen"), WHICH),
    st.tuples(st.just("reset"), st.sampled_from([None, (0,), (1,)])),
    st.tuples(st.just("again"), st.sampled_from([0.05, 0.1])),
    st.tuples(st.just("spawn"), WHICH),
    st.tuples(st.just("delete"), WHICH),
    st.tuples(st.just("push"), WHICH, SPEED),
    st.tuples(st.just("awake"), WHICH),
)


def do_to_one(sim, act, number, *values):
    """Command a robot, turn a wheel of it by hand, read its IMU, or take it out."""
    robots = moving(sim)
    each = robots[number % len(robots)]
    if act == "send":
        forward = values[0] + 0.01 * np.arange(sim.nworld)
        next(iter(each.inputs.values())).send(forward, values[1])
    elif act == "delete" and len(robots) > 1:
        sim.delete(each.name)
    elif act == "awake" and "imu" in each.sensors:
        each.sensors["imu"].latest()
    elif act == "push":
        joint = next(iter(each.joints.values()))
        if joint.has_motor:
            joint.drive(values[0])


def lived(sim, acts):
    """Do all that, and say what came of it: hashes of states, and what was published by whom."""
    found, heard, spawned = [], {}, 0
    for act, *values in acts:
        if act == "run":
            sim.run(values[0])
        elif act == "listen":
            listen(sim, heard, values[0])
        elif act == "reset":
            sim.reset(None if values[0] is None else list(values[0]))
        elif act == "again":
            saved = sim.snapshot()
            sim.run(values[0])
            sim.restore(saved)
        elif act == "spawn":
            spawned += 1
            text = f"<sdf version='1.7'>{robot(values[0], sim.plugin)}</sdf>"
            sim.spawn(formats.load_string(text).models[0], f"n{spawned}", Pose(-spawned, 2.0))
            part(sim)
        else:
            do_to_one(sim, act, *values)
        found.append(sim.state_hash())
    sim.run(0.1)
    return [*found, sim.state_hash()], heard


def same_together_and_alone(plugin, acts):
    results = []
    for together in (False, True):
        with yard(plugin, together=together, nworld=2) as sim:
            results.append(lived(sim, [("send", 0, 0.5, 0.3), ("listen", 1), ("run", 0.07), *acts]))
    assert results[1] == results[0]


BUSY = [("awake", 1), ("run", 0.07), ("reset", (1,)), ("send", 1, -0.2, 0.6), ("again", 0.05),
        ("spawn", 3), ("listen", 3), ("run", 0.15), ("delete", 0), ("push", 0, 0.4), ("run", 0.07)]  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_a_busy_run_is_the_same_together_and_alone(kind):
    same_together_and_alone(KINDS[kind], BUSY)


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=12, deadline=None)
@given(acts=st.lists(ACTS, min_size=4, max_size=14))
def test_many_do_together_what_each_does_alone(kind, acts):
    same_together_and_alone(KINDS[kind], acts)


def test_odometry_of_all_is_looked_up_at_once(monkeypatch):
    stamps = []
    with yard(KINDS["skid"], nworld=2) as sim:
        for each in moving(sim):
            each.outputs["odom"].subscribe(lambda odom: stamps.append(odom.stamp))
        looks = count_looks(monkeypatch, "models", "placement", allow_one=False)
        sim.run(1.0)
    assert looks == [3] * 20
    assert len(stamps) == 3 * 20


def test_a_recorded_run_is_the_same_and_can_be_replayed(tmp_path):
    hashes, after = [], []
    for record in (False, True):
        with yard(KINDS["skid"], nworld=2) as sim:
            if record:
                writer = sim.record(tmp_path / "run.jsonl")
            for turn in (0.5, -0.5):
                for each in moving(sim):
                    each.inputs["cmd_vel"].send(0.3, turn)
                sim.run(0.3)
            hashes.append(sim.state_hash())
            if record:
                writer.close()
            moving(sim)[0].inputs["cmd_vel"].send(-0.2)
            sim.run(0.1)
            after.append(sim.state_hash())
    assert hashes[0] == hashes[1]
    assert after[0] == after[1] != hashes[0]
    with gazelle.simulation.Replay(tmp_path / "run.jsonl") as replay:
        replay.run()
        assert replay.simulation.state_hash() == hashes[0]


class Scooter(ModelPlugin):
    """A drive as a user writes it: both wheels turn as fast as they are told."""

    update_rate = 50.0

    def load(self, robot, parameters):
        self.command = robot.inputs["speed"] = TwistInput(robot.simulation.nworld, "speed")
        self.wheels = [robot.joints[name] for name in ("left_joint", "right_joint")]
        for wheel in self.wheels:
            wheel.add_motor(5.0)
        self.broken = False
        self.system = Scooters


class Scooters(PluginSystem):
    def __init__(self, plugins):
        super().__init__(plugins)
        self.joints = JointArray([wheel for each in plugins for wheel in each.wheels])
        shape = (2, len(plugins[0].command.linear), len(plugins), 3)
        self.linear, angular = np.zeros(shape)
        for part, each in enumerate(plugins):
            each.command.store_in(self.linear[:, part], angular[:, part])

    def update(self, time):
        if any(each.broken for each in self.plugins):
            raise RuntimeError("a wheel is off")
        self.joints.drive(np.repeat(self.linear[..., 0] / 0.05, 2, axis=1))


SCOOTER = ("libscooter.so", ("left", "right"), "")


@pytest.fixture(autouse=True)
def scooter():
    register("libscooter.so", Scooter)


@pytest.mark.long
@settings(max_examples=8, deadline=None)
@given(acts=st.lists(ACTS, min_size=4, max_size=10))
def test_a_drive_of_a_user_takes_part(acts):
    acts = [each for each in acts if each[0] != "push"]  # this one tells motors at every update
    same_together_and_alone(SCOOTER, acts)


def test_a_row_that_fails_is_detached_alone():
    with yard(SCOOTER) as sim:
        sim.run(0.1)
        sim.entities.plugins[1].plugin.broken = True
        moving(sim)[0].inputs["speed"].send(0.3)
        with pytest.warns(PluginWarning, match="RuntimeError: a wheel is off") as said:
            sim.run(0.5)
        assert [str(each.message).partition(":")[0] for each in said] == [
            "plugin 'drive' of 'r0' failed when updated with others, and all are updated alone",
            "plugin 'drive' of 'r1' failed at 0.1 s and is detached",
        ]
        assert [entry.detached for entry in sim.entities.plugins] == [False, True, False]
        assert abs(moving(sim)[0].motion().linear[0]).max() > 0.2


def test_joints_of_many_robots_are_read_and_driven_at_once():
    with yard(KINDS["built in"]) as sim:
        sim.step()
        joints = [each.joints["left_joint"] for each in moving(sim)]
        group = JointArray(joints)
        with pytest.raises(gazelle.SimulationError, match="a row of 3 for each of 1 worlds"):
            group.drive([1.0, 2.0])
        with pytest.raises(gazelle.SimulationError, match="at least one"):
            JointArray([])
        group.drive([1.0, 2.0, 3.0], np.array([True, False, True]))
        sim.run(0.1)
        np.testing.assert_allclose(group.velocities()[0], [1.0, 0.0, 3.0], atol=0.05)
        assert np.array_equal(group.positions(), np.hstack([each.positions() for each in joints]))


def test_joints_of_many_robots_are_placed_between_their_limits():
    with yard(KINDS["built in"], nworld=2) as sim:
        for each in moving(sim):
            each.joints["left_joint"].set_properties(lower=-1.0, upper=1.0)
        group = JointArray([each.joints["left_joint"] for each in moving(sim)])
        group.place([[0.5, 2.0, 3.0], [-0.5, -2.0, 4.0]], 0.25, np.array([True, True, False]))
        assert group.positions().tolist() == [[0.5, 1.0, 0.0], [-0.5, -1.0, 0.0]]
        assert group.velocities().tolist() == [[0.25, 0.25, 0.0]] * 2
