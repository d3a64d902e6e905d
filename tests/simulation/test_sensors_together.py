"""Sensors of one kind of many robots in three dimensions, measured at once: the bits of each alone."""

import numpy as np
import pytest
from looks import count_looks

import gazelle
from gazelle import formats
from gazelle.description import Pose

NOISE = "<noise><type>gaussian</type><stddev>{stddev}</stddev><mean>{mean}</mean></noise>"
LIDAR = """<sensor name='eyes' type='ray'><update_rate>{rate}</update_rate><pose>.05 0 .2 0 .1 {turn}</pose>
<ray><scan><horizontal><samples>{rays}</samples><min_angle>-2</min_angle><max_angle>2</max_angle>
</horizontal></scan><range><min>.05</min><max>4</max></range>{noise}</ray></sensor>"""
ROBOT = """<model name='{name}'><pose>{x} {y} .3 .1 0 {yaw}</pose><link name='base'><inertial><mass>2</mass>
<inertia><ixx>.02</ixx><iyy>.03</iyy><izz>.04</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
<collision name='b'><geometry><box><size>.3 .2 .1</size></box></geometry></collision>{base}</link>
<link name='head'><pose>0 0 .2 0 0 0</pose><inertial><mass>.3</mass></inertial><collision name='h'>
<geometry><sphere><radius>.06</radius></sphere></geometry></collision>{head}</link><joint name='neck'
type='{joint}'><parent>base</parent><child>head</child><axis><xyz>0 0 1</xyz></axis></joint></model>"""
GROUND = """<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision>{0}</link></model>"""
POST = """<model name='post{0}'><static>1</static><link name='l'><collision name='c'><pose>{1} .75 .5 0 0 0
</pose><geometry><cylinder><radius>.2</radius><length>1</length></cylinder></geometry></collision></link>
</model>"""


def lidar(number):
    """Return a lidar: every third is of another make, every fifth slower, each turned."""
    other = number % 3 == 2
    noise = {"stddev": 0.02 if other else 0.01, "mean": 0.03 if other else 0.0}
    return LIDAR.format(
        rate=10 if number % 5 else 7, turn=0.2 * number, rays=11 if other else 24,
        noise=NOISE.format(**noise),
    )  # fmt: skip


def imu(number):
    """Return an IMU: every third has other noise, one of them with biases and rounding."""
    other = number % 3 == 2
    drift = "<dynamic_bias_stddev>.01</dynamic_bias_stddev><dynamic_bias_correlation_time>2</dynamic_bias_correlation_time>"
    axis = f"<noise type='gaussian{'_quantized' if other else ''}'><stddev>.02</stddev>{drift}"
    if other:
        axis += "<bias_mean>.3</bias_mean><bias_stddev>.1</bias_stddev><precision>.005</precision>"
    rates = "".join(f"<{a}>{axis}</noise></{a}>" for a in "xyz")
    return f"""<sensor name='imu' type='imu'><update_rate>{10 if number % 5 else 7}</update_rate><pose>.05
    0 .1 0 .2 {0.1 * number}</pose><imu><angular_velocity>{rates}</angular_velocity></imu></sensor>"""


def contact(number):
    """Return a contact sensor of all of a link; one robot has two for the same."""
    text = """<sensor name='{0}' type='contact'><update_rate>{1}</update_rate></sensor>"""
    names = ("touch", "again") if number == 6 else ("touch",)
    return "".join(text.format(name, 10 if number % 5 else 7) for name in names)


SENSORS = {"lidar": lidar, "imu": imu, "contact": contact}


def robot(kind, number):
    """Return a robot that falls and topples a little, its sensor on the base or on a head."""
    sensor = SENSORS[kind](number)
    return ROBOT.format(
        name=f"r{number}", x=1.5 * (number % 3), y=1.5 * (number // 3), yaw=0.7 * number,
        base="" if number % 2 else sensor, head=sensor if number % 2 else "",
        joint="fixed" if number % 4 == 1 else "continuous",
    )  # fmt: skip


def text(kind, count):
    physics = "<physics name='p' type='ode'><max_step_size>.01</max_step_size></physics>"
    posts = "".join(POST.format(i, 1.5 * i + 0.75) for i in range(2))
    robots = "".join(robot(kind, number) for number in range(count))
    ground = GROUND.format(SENSORS[kind](0))
    return f"<sdf version='1.7'><world name='w'>{physics}{ground}{posts}{robots}</world></sdf>"


def units(sim):
    return [unit for each in sim.robots.values() for unit in each.sensors.values()]


def part(sim):
    """Measure each sensor by itself."""
    for unit in units(sim):
        unit.system = lambda: None


def yard(kind, count=7, *, together=True, **options):
    """Return a running world whose sensors are awake."""
    world = formats.load_string(text(kind, count))
    sim = gazelle.Simulation(world, "mujoco", seed=3, **options)
    if not together:
        part(sim)
    for unit in units(sim):
        unit.latest()
    return sim


def told(sim):
    """Return all that sensors publish, and the state with their noise and stamps."""
    said = [(unit.latest().tobytes(), unit.read(sim.nworld - 1).stamp) for unit in units(sim)]
    return sim.state_hash(), said


def push(sim, size):
    for number, each in enumerate(sim.robots.values()):
        if each.name.startswith(("r", "new")):
            spread = size * (1.0 + np.arange(sim.nworld)[:, None]) * (0.3, -0.2, 0.1)
            each.set_twist(spread * (number - 3.0), (0.1, 0.2, size * number))


def lived(sim, kind, *, together):
    """Run while models come and go, some listen for a while, and worlds start over."""
    found, heard = [], []
    for turn in (0.5, -0.8):
        push(sim, turn)
        sim.run(0.24)
        found.append(told(sim))
        listened = [units(sim)[i] for i in (1, 2, 4)]
        ends = [
            unit.subscribe(lambda each: heard.append((each.name, each.current().tobytes())))
            for unit in listened
        ]
        sim.run(0.4)
        found.append(told(sim))
        ends.pop()()
        sim.reset([sim.nworld - 1])
        found.append(told(sim))
        sim.run(0.15)
        saved = sim.snapshot()
        sim.run(0.3)
        found.append(told(sim))
        sim.restore(saved)
        sim.run(0.3)
        found.append(told(sim))
        for end in ends:
            end()
        if "r3" in sim.robots:
            sim.delete("r3")
        model = formats.load_string(f"<sdf version='1.7'>{robot(kind, 5)}</sdf>").models[0]
        sim.spawn(model, f"new{turn}", Pose(5.0 + turn, -2.0, 0.3))
        if not together:
            part(sim)
        units(sim)[-1].latest()
        sim.run(0.1)
    sim.reset()
    sim.run(0.2)
    return found, heard, told(sim)


@pytest.mark.parametrize("nworld", [1, 3])
@pytest.mark.parametrize("kind", SENSORS)
def test_sensors_say_together_what_each_says_alone(kind, nworld):
    with yard(kind, together=False, nworld=nworld, threads=1) as sim:
        wanted = lived(sim, kind, together=False)
    with yard(kind, nworld=nworld) as sim:
        got = lived(sim, kind, together=True)
    assert got == wanted
    assert len(wanted[1]) > 10


@pytest.mark.parametrize("kind", SENSORS)
def test_a_world_among_others_says_what_it_says_alone(kind):
    with yard(kind, nworld=1) as sim:
        sim.run(0.5)
        wanted = [unit.latest()[0].tobytes() for unit in units(sim)]
    with yard(kind, nworld=4, threads=2) as sim:
        sim.run(0.5)
        assert [unit.latest()[0].tobytes() for unit in units(sim)] == wanted


def test_lidars_of_a_kind_are_cast_in_one_call_and_without_listeners_in_steps(monkeypatch):
    calls, heard = [], []
    with yard("lidar") as sim:
        for number in (0, 1, 2, 6):
            eyes = sim.robots[f"r{number}"].sensors["eyes"]
            eyes.subscribe(lambda each: heard.append(each.read().stamp))
        sim.run(0.3)
        before, count, update = told(sim), len(heard), sim.engine.update
        monkeypatch.setattr(
            sim.engine, "update", lambda system: calls.append(system.rows) or update(system)
        )
        sim.run(1.0)
        after = told(sim)
    assert all(old != new for old, new in zip(before[1], after[1], strict=True))
    # r1 and r6 at 10 Hz; r0 at 7 Hz and r2, of another make, are alone; the others act in steps.
    assert sorted(calls) == [1] * 17 + [2] * 10
    assert len(heard) - count == 7 + 3 * 10


def test_imus_of_a_kind_feel_the_coming_step_in_one_call_whoever_listens(monkeypatch):
    heard = []
    with yard("imu") as sim:
        sim.robots["r1"].sensors["imu"].subscribe(lambda each: heard.append(each.read().stamp))
        sim.run(0.3)
        looks = count_looks(monkeypatch, "links", "acceleration")
        sim.run(1.0)
    # as the lidars: 17 looks at the two that are alone, and 17 at the six others
    assert sorted(looks) == [1] * 17 + [2] * 7 + [4] * 10


def test_contacts_of_all_are_found_in_one_step_whoever_listens(monkeypatch):
    probes = []
    with yard("contact", nworld=2) as sim:
        touching = []
        sim.robots["r4"].sensors["touch"].subscribe(
            lambda each: touching.append(each.read().contacts.others)
        )
        sim.run(0.3)
        probe = sim._engine.reactions.probe
        monkeypatch.setattr(
            sim._engine.reactions, "probe", lambda world: probes.append(world) or probe(world)
        )
        sim.run(1.0)
        both = [sim.robots["r6"].sensors[name].read().contacts for name in ("touch", "again")]
        ground = sim.robots["ground"].sensors["touch"].read().contacts
    assert probes == [0, 1] * 17  # 10 Hz for most of them, 7 Hz for r0's, r5's and the ground's
    assert both[0].others == both[1].others == ("ground::l::c",) * len(both[0])
    assert len(both[0])
    assert {name for name in ground.others if name.startswith("r6")} == {"r6::base::b"}
    assert any(touching)


def test_white_noise_that_is_changed_in_the_middle_of_a_run_is_each_sensors_own():
    said = []
    for together in (False, True):
        with yard("imu", together=together, nworld=2) as sim:
            sim.run(0.3)
            for name, size in (("r1", 0.0), ("r4", 0.5)):
                sim.robots[name].sensors["imu"].model.noises[0].stddev = size
            sim.run(0.5)
            sim.robots["r1"].sensors["imu"].model.noises[0].stddev = [0.0, 0.1]
            sim.run(0.5)
            said.append(told(sim))
    assert said[0] == said[1]


def test_readings_that_somebody_keeps_do_not_change():
    with yard("lidar") as sim:
        unit = sim.robots["r2"].sensors["eyes"]
        sim.run(0.1)
        kept = unit.latest()
        copy = kept.copy()
        sim.run(0.5)
        np.testing.assert_array_equal(kept, copy)
        assert (unit.latest() != copy).any()


def test_a_listener_may_delete_the_robots_that_are_told_after_it():
    with yard("lidar") as sim:
        sim.run(0.2)
        heard = []
        sim.robots["r1"].sensors["eyes"].subscribe(
            lambda _: [sim.delete(name) for name in ("r2", "r4") if name in sim.robots]
        )
        sim.robots["r6"].sensors["eyes"].subscribe(lambda each: heard.append(each.current().max()))
        sim.run(0.55)
        assert "r2" not in sim.robots
        assert len(heard) == 5


def test_a_sensor_whose_rate_changes_leaves_the_others():
    with yard("lidar") as sim:
        sim.run(0.2)
        sim.robots["r1"].sensors["eyes"].limit_rate(2.0)
        sim.run(1.1)
        assert sim.robots["r1"].sensors["eyes"].read().stamp == 1_000_000_000
        assert sim.robots["r3"].sensors["eyes"].read().stamp == 1_300_000_000
