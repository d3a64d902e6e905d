"""Parts of a kind of many robots, updated together, do what each would do by itself."""

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.description import Pose
from gazelle.errors import PluginWarning, SimulationWarning
from gazelle.sensors import LidarModel
from gazelle.simulation import ModelPlugin, PluginSystem, register

WHEEL = """<link name='{0}'><pose>0 {1} .05 -1.5708 0 0</pose><collision name='c'><geometry><cylinder>
<radius>.05</radius><length>.02</length></cylinder></geometry></collision></link><joint name='{0}_joint'
type='revolute'><parent>base</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
LIDAR = """<sensor name='eyes' type='ray'><update_rate>{rate}</update_rate><pose>.05 0 .1 0 0 .1</pose><ray>
<scan><horizontal><samples>{rays}</samples><min_angle>-2</min_angle><max_angle>2</max_angle></horizontal>
</scan><range><min>.05</min><max>{far}</max></range><noise><type>gaussian</type><stddev>{noise}</stddev>
<mean>{bias}</mean></noise></ray></sensor>"""
ROBOT = """<model name='{name}'><pose>{x} {y} 0 0 0 {yaw}</pose><link name='base'><pose>0 0 .1 0 0 0</pose>
<collision name='b'><pose>0 0 .02 0 0 0</pose><geometry><box><size>.3 .2 .1</size></box></geometry>
</collision>{lidar}</link>{wheels}<plugin name='drive' filename='libgazebo_ros_diff_drive.so'>
<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint><wheelSeparation>.24</wheelSeparation>
<wheelDiameter>.1</wheelDiameter><updateRate>{hz}</updateRate><wheelAcceleration>{push}</wheelAcceleration>
<odometrySource>{odometry}</odometrySource></plugin></model>"""
POST = """<model name='post{0}'><static>1</static><link name='l'><collision name='c'><pose>{1} {2} .5 0 0 0</pose>
<geometry><cylinder><radius>.2</radius><length>1</length></cylinder></geometry></collision></link></model>"""
SIDE = 4


def robot(number, **changes):
    """Return a robot of a lattice; every third one is of another make."""
    other = number % 3 == 2
    lidar = {"rate": 10 if number % 5 else 7, "rays": 40, "far": 6, "noise": 0.01, "bias": 0.0}
    if other:
        lidar |= {"rays": 11, "noise": 0.0 if number % 2 else 0.02, "bias": 0.03}
    parts = {
        "name": f"r{number}",
        "x": 1.5 * (number % SIDE),
        "y": 1.5 * (number // SIDE),
        "yaw": 0.7 * number,
        "wheels": WHEEL.format("left", 0.12) + WHEEL.format("right", -0.12),
        "lidar": LIDAR.format(**lidar),
        "hz": 20 if other else 50,
        "push": 0.4 if number % 4 == 1 else 0.0,
        "odometry": "encoder" if number == 7 else "world",
    }
    return ROBOT.format(**parts | changes)


def world(count):
    """Return robots in rows, and posts among them."""
    posts = (
        POST.format(i, 1.5 * (i % SIDE) + 0.75, 1.5 * (i // SIDE) + 0.75) for i in range(count)
    )
    physics = "<physics name='p' type='ode'><max_step_size>.02</max_step_size></physics>"
    made = "".join((physics, *posts, *map(robot, range(count))))
    return f"<sdf version='1.7'><world name='yard'>{made}</world></sdf>"


def yard(count=12, *, native=True, **options):
    """Return a running world of robots; without ``native`` Python measures and publishes."""
    sim = gazelle.Simulation(formats.load_string(world(count)), "planar", seed=3, **options)
    if not native:
        for each in sim.robots.values():
            for unit in each.sensors.values():
                unit.system = lambda: None
            if "odom" in each.outputs:
                each.outputs["odom"].subscribe(lambda _: None)
    for name, each in sim.robots.items():
        if name.startswith("r"):
            each.sensors["eyes"].latest()
    return sim


def moving(sim):
    return [each for name, each in sim.robots.items() if name.startswith("r")]


def command(sim, turn):
    """Command each robot in each world differently."""
    for number, each in enumerate(moving(sim)):
        spread = np.arange(sim.nworld)
        each.inputs["cmd_vel"].send(0.3 - 0.02 * number + 0.01 * spread, turn * (number - 4.0))


def told(sim):
    """Return all that robots and their sensors publish, and the state."""
    readings = [each.sensors["eyes"].latest().tobytes() for each in moving(sim)]
    stamps = [each.sensors["eyes"].read().stamp for each in moving(sim)]
    return sim.state_hash(), readings, stamps


def lived(sim):
    """Run while models come and go, some listen for a while, and worlds start over."""
    found, heard = [], []
    for turn in (0.1, -0.3):
        command(sim, turn)
        sim.run(0.44)
        found.append(told(sim))
        robots = moving(sim)
        ends = [
            robots[1]
            .sensors["eyes"]
            .subscribe(lambda unit: heard.append(unit.current().tobytes())),
            robots[2].outputs["odom"].subscribe(lambda odom: heard.append(odom.position.tobytes())),
        ]
        sim.run(0.5)
        found.append(told(sim))
        for end in ends:
            end()
        sim.reset([sim.nworld - 1])
        found.append(told(sim))
        saved = sim.snapshot()
        sim.run(0.3)
        found.append(told(sim))
        sim.restore(saved)
        sim.run(0.3)
        found.append(told(sim))
        if "r3" in sim.robots:
            sim.delete("r3")
        new = sim.spawn(formats.load_string(f"<sdf version='1.7'>{robot(5)}</sdf>").models[0],
                        f"new{turn}", Pose(9.0 + turn, 9.0))  # fmt: skip
        new.sensors["eyes"].latest()
        sim.run(0.1)
    sim.reset()
    sim.run(0.2)
    return found, heard, told(sim)


@pytest.mark.long
@pytest.mark.parametrize("nworld", [1, 3])
def test_robots_do_together_what_each_does_alone(nworld):
    with yard(native=False, nworld=nworld, threads=1) as sim:
        wanted = lived(sim)
    with yard(nworld=nworld) as sim:
        got = lived(sim)
    assert got == wanted
    assert len(wanted[1]) > 20


def test_bits_are_the_same_at_any_number_of_threads_and_worlds():
    with yard(nworld=1, threads=1) as sim:
        command(sim, 0.2)
        sim.run(1.0)
        wanted = told(sim)
    for nworld, threads in ((1, 2), (1, 3), (9, 2)):
        with yard(nworld=nworld, threads=threads) as sim:
            command(sim, 0.2)
            sim.run(1.0)
            assert sim.state_hash([0]) == wanted[0]
            readings = [each.sensors["eyes"].latest()[0].tobytes() for each in moving(sim)]
            assert readings == wanted[1]


def test_python_has_no_part_in_what_nobody_listens_to(monkeypatch):
    def refuse(*_, **__):
        raise AssertionError("asked from Python")

    with yard() as sim:
        command(sim, 0.2)
        sim.run(0.2)
        before = told(sim)
        for name in ("measure", "system"):
            monkeypatch.setattr(LidarModel, name, refuse)
        sim.run(1.0)
        after = told(sim)
        assert all(old != new for old, new in zip(before[1], after[1], strict=True))
        assert max(after[2]) == 1_200_000_000


def test_readings_that_somebody_keeps_do_not_change():
    with yard(3) as sim:
        unit = sim.robots["r0"].sensors["eyes"]
        sim.run(0.1)
        kept = unit.latest()
        copy = kept.copy()
        command(sim, 0.5)
        sim.run(1.0)
        np.testing.assert_array_equal(kept, copy)
        assert (unit.latest() != copy).any()


def test_a_rate_that_one_sensor_gets_is_its_own():
    with yard(2) as sim:
        sim.run(0.2)
        sim.robots["r0"].sensors["eyes"].limit_rate(2.0)
        sim.robots["r1"].sensors["eyes"].latest()
        sim.run(1.1)
        assert sim.robots["r0"].sensors["eyes"].schedule.rate == 2.0
        assert sim.robots["r1"].sensors["eyes"].schedule.rate == 10.0
        assert sim.robots["r1"].sensors["eyes"].read().stamp == 1_300_000_000
        assert sim.robots["r0"].sensors["eyes"].read().stamp == 1_000_000_000


def test_a_command_before_and_after_native_steps_reaches_the_motors():
    with yard(2) as sim:
        own = sim.robots["r0"]
        end = own.outputs["odom"].subscribe(lambda _: None)
        own.inputs["cmd_vel"].send(0.3)
        sim.run(0.1)
        end()
        own.inputs["cmd_vel"].send(0.0)
        sim.run(0.1)
        own.outputs["odom"].subscribe(lambda _: None)
        own.inputs["cmd_vel"].send(0.3)
        sim.run(0.1)
        assert own.motion().linear[0, 0] == pytest.approx(0.3)


class Herding(PluginSystem):
    """A system that is made of one plugin only."""

    def __init__(self, plugins):
        (self.plugin,) = plugins
        super().__init__(plugins)

    def update(self, time):
        self.plugin.calls += 1


class Herd(ModelPlugin):
    """Names a system that cannot be made of many."""

    system = Herding
    update_rate = 10.0
    calls = 0


def test_plugins_that_cannot_make_their_system_are_updated_alone():
    register("libherd.so", Herd)
    plugin = "<plugin name='herd' filename='libherd.so'/>"
    with yard(2) as sim:
        for number in (20, 21):
            text = robot(number).replace("<plugin name='drive'", f"{plugin}<plugin name='drive'")
            sim.spawn(formats.load_string(f"<sdf version='1.7'>{text}</sdf>").models[0])
        with pytest.warns((SimulationWarning, PluginWarning), match="when their system was made"):
            sim.run(0.5)
        herd = [each.plugin.calls for each in sim.plugins if isinstance(each.plugin, Herd)]
        assert herd == [5, 5]


@pytest.mark.long
def test_a_hundred_robots_load_quickly_enough_to_be_tested():
    """Motors were given by building the whole world anew: a hundred robots took minutes."""
    with yard(100) as sim:
        assert sim.engine.revision == 1


class Looker(ModelPlugin):
    """Looks through its robot's lidar once a second, from the middle of a run on."""

    update_rate = 1.0

    def load(self, robot, parameters):
        self.robot = robot
        self.stamps = robot.simulation.looked = []

    def on_update(self, time):
        if time > 0.5:
            self.robot.sensors["eyes"].latest()
            self.stamps.append(self.robot.sensors["eyes"].read().stamp)


def test_a_sensor_that_a_plugin_wakes_is_measured_at_its_rate_from_then_on():
    register("liblooker.so", Looker)
    plugin = "<plugin name='look' filename='liblooker.so'/>"
    with yard(2) as sim:
        text = robot(20).replace("<plugin name='drive'", f"{plugin}<plugin name='drive'")
        new = sim.spawn(formats.load_string(f"<sdf version='1.7'>{text}</sdf>").models[0])
        sim.run(2.98)
        assert sim.looked == [1_000_000_000, 2_000_000_000]
        assert new.sensors["eyes"].read().stamp == 2_860_000_000  # 7 Hz, on steps of 20 ms
