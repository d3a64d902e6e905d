"""Drives of one kind of many robots are one system, whoever listens, and do what each would alone."""

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.description import Pose
from gazelle.errors import PluginWarning
from gazelle.plugins.odometry import TrueOdometry
from gazelle.simulation.scheduled_systems import ScheduledSystem

WHEEL = """<link name='{0}'><pose>{2} {1} .05 -1.5708 0 0</pose><collision name='c'><geometry><cylinder>
<radius>.05</radius><length>.02</length></cylinder></geometry></collision></link><joint name='{0}_joint'
type='revolute'><parent>base</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
ROBOT = """<model name='{name}'><pose>{x} {y} 0 0 0 {yaw}</pose><link name='base'><pose>.03 0 .1 0 0 .2</pose>
<collision name='b'><pose>0 0 .02 0 0 0</pose><geometry><box><size>.3 .2 .1</size></box></geometry>
</collision></link>{wheels}<plugin name='drive' filename='{file}'>{tags}</plugin></model>"""
POST = """<model name='post'><static>1</static><pose>1.2 0 0 0 0 0</pose><link name='l'><collision name='c'>
<geometry><box><size>.1 9 1</size></box></geometry></collision></link></model>"""
SIZES = "<wheelSeparation>.24</wheelSeparation><wheelDiameter>.1</wheelDiameter>"
DIFF = "<{0}>left_joint</{0}><{1}>right_joint</{1}>"
CORNERS = ("left_front", "right_front", "left_rear", "right_rear")
KINDS = {
    "diff": (
        "libgazebo_ros_diff_drive.so",
        ("left", "right"),
        DIFF.format("leftJoint", "rightJoint") + SIZES + "<wheelAcceleration>.6</wheelAcceleration>"
        "<publishWheelJointState>1</publishWheelJointState><updateRate>20</updateRate>",
    ),
    "encoders": (
        "libgazebo_ros_diff_drive.so",
        ("left", "right"),
        DIFF.format("leftJoint", "rightJoint") + SIZES + "<odometrySource>encoder</odometrySource>"
        "<updateRate>20</updateRate>",
    ),
    "skid": (
        "libgazebo_ros_skid_steer_drive.so",
        CORNERS,
        "".join(f"<{a}{b}Joint>{a}_{b.lower()}_joint</{a}{b}Joint>" for a in ("left", "right") for b in ("Front", "Rear"))
        + SIZES + "<updateRate>20</updateRate>",
    ),
    "multi": (
        "libdiffdrive_plugin_multi_wheel.so",
        (*CORNERS, "left", "right"),
        "<leftJoints>left_front_joint left_joint left_rear_joint</leftJoints>"
        "<rightJoints>right_front_joint right_joint right_rear_joint</rightJoints>" + SIZES,
    ),
    "move": ("libgazebo_ros_planar_move.so", (), "<odometryRate>30</odometryRate>"),
    "patient": ("libgazebo_ros_planar_move.so", (), "<cmdTimeout>.3</cmdTimeout>"),
    "built in": ("libDiffDrivePlugin.so", ("left", "right"), DIFF.format("left_joint", "right_joint")),
    "both": ("libSkidSteerDrivePlugin.so", CORNERS, "".join(f"<{c}>{c}_joint</{c}>" for c in CORNERS)),
}  # fmt: skip
TOGETHER = [kind for kind in KINDS if kind not in ("patient", "encoders")]


def robot(number, kind):
    file, wheels, tags = KINDS[kind]
    places = {"front": 0.1, "rear": -0.1}
    made = "".join(
        WHEEL.format(
            name, 0.12 if "left" in name else -0.12, places.get(name.rpartition("_")[2], 0.0)
        )
        for name in wheels
    )
    return ROBOT.format(
        name=f"r{number}", x=0.0, y=0.7 * number, yaw=0.3 * number, wheels=made, file=file, tags=tags
    )  # fmt: skip


def yard(kind, *, native=True, together=True, **options):
    """Return a running world of four robots and a wall; without ``native`` Python publishes.

    Without ``together`` it updates each by itself.
    """
    physics = "<physics name='p' type='ode'><max_step_size>.01</max_step_size></physics>"
    models = "".join(robot(number, kind) for number in range(4))
    text = f"<sdf version='1.7'><world name='w'>{physics}{POST}{models}</world></sdf>"
    sim = gazelle.Simulation(formats.load_string(text), "planar", **options)
    if not native:
        for each in sim.robots.values():
            for name in each.outputs.keys() & {"odom", "odom_tf"}:
                each.outputs[name].subscribe(lambda _: None)
    if not together:
        part(sim)
    return sim


def part(sim):
    """Update each plugin by itself."""
    for entry in sim.entities.plugins:
        entry.alone = True


def moving(sim):
    return [each for each in sim.robots.values() if each.inputs]


def command(sim, turn):
    for number, each in enumerate(moving(sim)):
        port = next(iter(each.inputs.values()))
        forward = 0.4 - 0.05 * number + 0.01 * np.arange(sim.nworld)
        linear = np.column_stack((forward, np.full((sim.nworld, 2), 0.1)))
        port.send(linear, turn * (number - 1.2))


def lived(sim):
    """Run commands, listeners that come and go, a snapshot, resets, a spawn and a deletion."""
    found, heard = [], []

    def listen(number):
        def note(value):
            arrays = (value.position, value.quaternion, value.linear, value.angular)
            heard.append((number, value.stamp, *(np.ascontiguousarray(a).tobytes() for a in arrays)))  # fmt: skip

        output = moving(sim)[number].outputs.get("odom")
        return output.subscribe(note) if output else lambda: None

    for turn in (0.5, -0.8):
        command(sim, turn)
        sim.run(0.213)
        ends = [listen(1), listen(3)]
        sim.run(0.307)
        command(sim, -turn)
        found.append(sim.state_hash())
        ends.pop()()
        sim.run(0.2)
        sim.reset([sim.nworld - 1])
        saved = sim.snapshot()
        sim.run(0.25)
        found.append(sim.state_hash())
        sim.restore(saved)
        sim.run(0.25)
        found.append(sim.state_hash())
        ends.pop()()
        sim.run(0.1)
    sim.delete("r2")
    own = formats.load_string(f"<sdf version='1.7'>{robot(2, sim.kind)}</sdf>").models[0]
    sim.spawn(own, "new", Pose(-3.0, -3.0))
    end = listen(0)
    sim.run(0.2)
    sim.reset()
    command(sim, 0.3)
    sim.run(0.4)
    end()
    return [*found, sim.state_hash()], heard


@pytest.mark.parametrize("nworld", [1, 3])
@pytest.mark.parametrize("kind", KINDS)
def test_many_do_together_what_each_does_alone(kind, nworld):
    with yard(kind, native=False, together=False, nworld=nworld, threads=1) as sim:
        sim.kind = kind
        wanted = lived(sim)
    for native in (True, False):
        with yard(kind, native=native, nworld=nworld) as sim:
            sim.kind = kind
            got = lived(sim)
        assert got == wanted
    assert len(wanted[1]) > 15 or kind in ("built in", "both")


@pytest.mark.parametrize("kind", TOGETHER)
def test_python_has_no_part_in_what_nobody_listens_to(kind, monkeypatch):
    with yard(kind) as sim:
        command(sim, 0.2)
        sim.run(0.05)
        monkeypatch.setattr(ScheduledSystem, "update", None)
        before = moving(sim)[0].position
        sim.run(0.5)
        assert not np.allclose(moving(sim)[0].position, before, atol=0.05)
        assert len(sim.entities.plugins) == 4


@pytest.mark.parametrize("kind", ["diff", "skid", "multi", "move"])
def test_odometry_of_all_is_measured_at_once(kind, monkeypatch):
    calls, stamps = [], []
    monkeypatch.setattr(TrueOdometry, "__call__", lambda _: calls.append(1))
    with yard(kind) as sim:
        for each in moving(sim):
            each.outputs["odom"].subscribe(lambda odom: stamps.append(odom.stamp))
        sim.run(1.0)
        assert not calls
        assert len(stamps) == 4 * len(set(stamps))
        assert len(set(stamps)) == {"diff": 20, "skid": 20, "multi": 100, "move": 30}[kind]


def test_a_listener_that_fails_detaches_its_own_robot_alone():
    with yard("skid") as sim:
        first, second, third, _ = moving(sim)
        heard = []
        first.outputs["odom"].subscribe(lambda odom: heard.append(odom.stamp))
        second.outputs["odom"].subscribe(lambda _: 1 / 0)
        third.outputs["odom"].subscribe(lambda odom: heard.append(odom.stamp))
        with pytest.warns(PluginWarning, match="ZeroDivisionError"):
            sim.run(0.5)
        assert len(heard) == 2 * 10
        command(sim, 0.0)
        sim.run(0.2)
        assert [abs(each.motion().linear[0]).max() > 0.1 for each in moving(sim)] == [
            True, False, True, True,
        ]  # fmt: skip


def test_commands_act_at_the_rate_of_the_drive_as_in_gazebo():
    with yard("skid") as sim:  # 20 Hz
        sim.run(0.06)
        command(sim, 0.0)
        sim.run(0.04)
        assert not moving(sim)[0].motion().linear.any()
        sim.run(0.01)
        assert moving(sim)[0].motion().linear[0, 0] == pytest.approx(0.4)


@pytest.mark.parametrize("engine", ["planar", "mujoco"])
def test_a_motion_on_the_ground_is_along_and_across_the_heading(engine):
    box = """<model name='{0}'><pose>{1} 0 1 0 0 .7</pose><link name='l'><gravity>0</gravity><collision
    name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link></model>"""
    world = "".join(box.format(*each) for each in (("a", 0), ("b", 5)))
    text = f"<sdf version='1.7'><world name='w'>{world}</world></sdf>"
    with gazelle.Simulation(formats.load_string(text), engine, nworld=2) as sim:
        sim.engine.models["a"].set_ground_motion((0.3, 0.1, 0.5))
        sim.engine.models["b"].set_ground_motion([(0.2, 0.0, 0.0)], np.array([1]))
        a, b = sim.robots["a"].motion(), sim.robots["b"].motion()
        c, s = np.cos(0.7), np.sin(0.7)
        np.testing.assert_allclose(
            a.linear, [[0.3 * c - 0.1 * s, 0.3 * s + 0.1 * c, 0.0]] * 2, atol=1e-9
        )
        np.testing.assert_allclose(a.angular, [[0.0, 0.0, 0.5]] * 2, atol=1e-9)
        np.testing.assert_allclose(b.linear, [[0.0, 0.0, 0.0], [0.2 * c, 0.2 * s, 0.0]], atol=1e-9)
