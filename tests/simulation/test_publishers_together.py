"""Plugins of many robots that only publish, measured at once: the bits of each alone."""

import numpy as np
import pytest
from looks import count_looks

import gazelle
from gazelle import formats
from gazelle.errors import PluginWarning

P3D = """<plugin name='p3d' filename='libgazebo_ros_p3d.so'><bodyName>{body}</bodyName><topicName>true</topicName>
<updateRate>{rate}</updateRate><gaussianNoise>{noise}</gaussianNoise><xyzOffset>.1 0 .2</xyzOffset>
<rpyOffset>0 0 .3</rpyOffset><frameName>{frame}</frameName></plugin>"""
IMU = """<plugin name='imu' filename='libgazebo_ros_imu.so'><bodyName>{body}</bodyName><topicName>imu</topicName>
<updateRate>{rate}</updateRate><gaussianNoise>{noise}</gaussianNoise><rpyOffset>0 0 .3</rpyOffset></plugin>"""
JOINTS = """<plugin name='joints' filename='libgazebo_ros_joint_state_publisher.so'><jointName>neck{more}
</jointName><updateRate>{rate}</updateRate></plugin>"""
ROBOT = """<model name='r{0}'><pose>{0} 0 1 .1 0 {0}</pose><link name='base'><collision name='b'><geometry><box>
<size>.3 .2 .1</size></box></geometry></collision></link><link name='head'><pose>0 0 .2 0 0 0</pose><collision
name='h'><geometry><sphere><radius>.06</radius></sphere></geometry></collision></link><joint name='neck'
type='continuous'><parent>base</parent><child>head</child><axis><xyz>0 0 1</xyz></axis></joint>{1}</model>"""


def yard(*, together=True, nworld=2, rate=20):
    """Return six robots that fall and turn; one of them sees its head from its base."""
    robots = "".join(
        ROBOT.format(
            i,
            (P3D + IMU + JOINTS).format(
                body="head" if i % 2 else "base", rate=rate if i < 5 else 0,
                more=",r4::neck" if i == 4 else "", noise=0.1 if i in (0, 1, 2) else 0.0, frame="base" if i == 3 else "world",
            ),
        )
        for i in range(6)
    )  # fmt: skip
    physics = "<physics name='p' type='ode'><max_step_size>.01</max_step_size></physics>"
    text = f"<sdf version='1.7'><world name='w'>{physics}{robots}</world></sdf>"
    sim = gazelle.Simulation(formats.load_string(text), "mujoco", seed=5, nworld=nworld)
    if not together:
        for entry in sim.entities.plugins:
            entry.alone = True
    for i, each in enumerate(sim.robots.values()):
        each.set_twist((0.1 * i, 0.2, 0.0), (0.3, 0.1 * i, 1.0))
    return sim


ARRAYS = {
    "true": ("position", "quaternion", "linear", "angular"),
    "joint_states": ("position", "velocity"),
    "imu": ("orientation", "angular_velocity", "linear_acceleration"),
}


def lived(sim, output):
    """Run listeners that come and go, a reset and a snapshot."""
    heard = []

    def listen(name):
        def note(value):
            arrays = [np.ascontiguousarray(getattr(value, each)) for each in ARRAYS[output]]
            heard.append((name, value.stamp, *(each.tobytes() for each in arrays)))

        return sim.robots[name].outputs[output].subscribe(note)

    ends = [listen(f"r{i}") for i in range(6)]
    sim.run(0.33)
    ends.pop(0)()  # the others of its kind make a group of their own, and it joins them again
    sim.run(0.1)
    ends.append(listen("r0"))
    sim.run(0.1)
    saved = sim.snapshot()
    sim.run(0.3)
    sim.restore(saved)
    sim.run(0.12)
    ends.pop(0)()
    sim.run(0.1)
    sim.delete("r4")
    ends.append(listen("r1"))
    sim.run(0.2)
    sim.reset()
    sim.run(0.2)
    # Each robot's own, in order: those measured together are told one after another.
    return sorted(heard, key=lambda each: each[0]), sim.state_hash()


@pytest.mark.parametrize("nworld", [1, 3])
@pytest.mark.parametrize("output", ARRAYS)
def test_many_publish_together_as_alone(output, nworld):
    with yard(together=False, nworld=nworld) as sim:
        wanted = lived(sim, output)
    with yard(nworld=nworld) as sim:
        got = lived(sim, output)
    assert got == wanted
    assert len(wanted[0]) > 100


def test_true_poses_of_all_are_looked_up_at_once(monkeypatch):
    stamps = []
    with yard() as sim:
        for name in ("r0", "r1", "r2", "r4"):
            sim.robots[name].outputs["true"].subscribe(lambda each: stamps.append(each.stamp))
        looks = count_looks(monkeypatch, "links", "placement", allow_one=False)
        sim.run(1.0)
    # Beside them it is looked now and then whether one of the six models falls out of the world.
    assert [count for count in looks if count != 6] == [4] * 20
    assert len(stamps) == 4 * 20


def test_imus_of_all_feel_one_coming_step(monkeypatch):
    stamps = []
    with yard() as sim:
        for name in ("r3", "r4"):
            sim.robots[name].outputs["imu"].subscribe(lambda each: stamps.append(each.stamp))
        looks = count_looks(monkeypatch, "links", "acceleration", allow_one=False)
        sim.run(1.0)
    assert looks == [2] * 20
    assert len(stamps) == 2 * 20


def test_joints_of_all_are_looked_up_at_once(monkeypatch):
    heard = []
    with yard() as sim:
        for name in ("r0", "r2", "r4"):
            sim.robots[name].outputs["joint_states"].subscribe(heard.append)
        looks = count_looks(monkeypatch, "joints", "position", allow_one=False)
        sim.run(1.0)
    assert looks == [4] * 20
    assert [each.names for each in heard[:3]] == [("neck",), ("neck",), ("neck", "neck")]


def test_a_listener_that_fails_detaches_its_own_publisher_alone():
    heard = []
    with yard() as sim:
        sim.robots["r0"].outputs["true"].subscribe(lambda each: heard.append(each.stamp))
        sim.robots["r1"].outputs["true"].subscribe(lambda _: 1 / 0)
        sim.robots["r2"].outputs["true"].subscribe(lambda each: heard.append(each.stamp))
        with pytest.warns(PluginWarning, match="ZeroDivisionError"):
            sim.run(0.5)
    assert len(heard) == 2 * 10


def test_each_publishes_once_in_a_step_though_somebody_subscribes_in_its_middle():
    stamps = []
    with yard(rate=0) as sim:

        def note(value):
            stamps.append(value.stamp)
            if len(stamps) == 7:
                sim.robots["r2"].outputs["true"].subscribe(lambda _: None)

        sim.robots["r0"].outputs["true"].subscribe(note)
        sim.robots["r1"].outputs["true"].subscribe(lambda _: None)
        sim.run(0.2)
    assert stamps == [10_000_000 * step for step in range(20)]
