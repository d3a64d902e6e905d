"""Systems in MuJoCo's steps and between them do what plugins do that Python updates, bit by bit."""

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.engines import DivergenceError
from gazelle.errors import SimulationWarning
from gazelle.plugins.diff_drive_law import DiffDriveLaw, WheelTables
from gazelle.plugins.scripted_motion import ScriptedMotion
from gazelle.simulation import ModelPlugin, register, step_loop
from gazelle.simulation.scheduled_systems import ScheduledSystem
from tests.simulation import test_drives_in_space as drives

WHEELS = ("diff", "at every step", "skid", "built in")


def yard(kind, nworld, *, native, more="", **options):
    """Return three robots, and a pillar on the way of the first."""
    physics = "<physics name='p' type='ode'><max_step_size>.01</max_step_size></physics>"
    robots = "".join(drives.robot(number, drives.KINDS[kind]) for number in range(3))
    text = (
        f"<sdf version='1.7'><world name='w'>{physics}{drives.GROUND}{robots}{more}</world></sdf>"
    )
    sim = gazelle.Simulation(formats.load_string(text), "mujoco", nworld=nworld, **options)
    for each in [] if native else sim.robots.values():
        for name in each.outputs.keys() & {"odom", "odom_tf"}:
            each.outputs[name].subscribe(lambda _: None)
    sim.plugin, sim.together = drives.KINDS[kind], True
    return sim


@pytest.mark.parametrize("nworld", [1, pytest.param(3, marks=pytest.mark.long)])
@pytest.mark.parametrize("kind", drives.KINDS)
def test_a_busy_run_is_the_same_as_from_python(kind, nworld):
    acts = [
        ("send", 0, 0.5, 0.3),
        ("run", 0.35),
        *drives.BUSY,
        ("send", 1, 0.3, -0.4),
        ("run", 0.4),
    ]
    acts = [each for each in acts if nworld > 1 or each != ("reset", (1,))]
    results = []
    for native in (False, True):
        with yard(kind, nworld, native=native, threads=1 + native) as sim:
            results.append(drives.lived(sim, acts))
    assert results[1] == results[0]


@pytest.mark.parametrize("kind", WHEELS)
def test_python_has_no_part_in_wheels_that_nobody_listens_to(kind, monkeypatch):
    with yard(kind, 2, native=True) as sim:
        sim.run(0.05)
        monkeypatch.setattr(ScheduledSystem, "update", None)
        for each in drives.moving(sim):
            each.inputs["cmd_vel"].send(0.4, 0.2)
        before = drives.moving(sim)[0].position
        sim.run(0.5)
        assert not np.allclose(drives.moving(sim)[0].position, before, atol=0.05)


class Hand(ModelPlugin):
    """Breaks a world at a time."""

    update_rate = 0.0
    worlds = ()

    def load(self, robot, parameters):
        del parameters
        self.robot, self.update_rate = robot, 3.0

    def on_update(self, time):
        if time > 0.3 and len(self.worlds):
            worlds, type(self).worlds = np.array(self.worlds), ()
            nowhere = np.full(3, np.nan)
            self.robot.simulation.engine.models[self.robot.name].set_motion(
                nowhere, nowhere, worlds
            )


@pytest.mark.parametrize("kind", ["diff", "skid"])
@pytest.mark.parametrize("policy", ["reset", "raise"])
def test_worlds_that_break_down_do_so_wherever_steps_are_cut(kind, policy, tmp_path, monkeypatch):
    register("libhand.so", Hand)
    box = (
        "<model name='box'><pose>0 3 1 0 0 0</pose><link name='l'/>"
        "<plugin name='h' filename='libhand.so'/></model>"
    )
    found, others = [], []
    for native, longest in ((False, 1e9), (True, 1e9), (True, 0.0)):
        for name in ("_PIECE", "_LONG_PIECE"):  # as many steps at once as can be, or one
            monkeypatch.setattr(step_loop, name, longest)
        Hand.worlds = (1,)
        faults = {"on_fault": policy, "fault_dump": tmp_path / "fault.jsonl"}
        with yard(kind, 3, native=native, more=box, **faults) as sim:
            for each in drives.moving(sim):
                each.inputs["cmd_vel"].send(0.4, 0.2)
            if policy == "raise":
                with pytest.raises(DivergenceError, match="1 of 3 worlds") as said:
                    sim.run(0.9)
                assert said.value.worlds.tolist() == [1]
            else:
                with pytest.warns(SimulationWarning, match="1 of 3 worlds became infinite"):
                    sim.run(0.9)
            found.append((sim.clock.now_ns, sim.state_hash()))
            sim.run(1.4 - sim.time)
            found[-1] += (sim.state_hash(),)
            others.append([sim.state_hash([world]) for world in (0, 2)])
    assert found[1] == found[2]
    assert others[0] == others[1] == others[2]


PATHS = {
    "straight": "<waypoint><time>0</time><pose>0 0 .2 0 0 0</pose></waypoint><waypoint><time>.7</time>"
    "<pose>1 .4 .2 0 0 0</pose></waypoint><waypoint><time>1</time><pose>1 0 .3 0 0 0</pose></waypoint>",
    "leaning": "<waypoint><time>.1</time><pose>0 0 .2 .1 .2 .3</pose></waypoint>"
    "<waypoint><time>.5</time><pose>1 .4 .2 .1 .2 .3</pose></waypoint><loop>1</loop>",
    "one": "<waypoint><time>.1</time><pose>.1 .2 .3 0 0 .3</pose></waypoint>",
    "turning": "<waypoint><time>0</time><pose>0 0 .2 0 0 0</pose></waypoint><waypoint><time>.7</time>"
    "<pose>1 .4 .2 0 .3 2</pose></waypoint><loop>1</loop>",
    "spinning": "<angular_velocity>.3 .4 -2</angular_velocity>",
    "standing": "<loop>1</loop>",
    "spline": "<trajectory><waypoint><time>0</time><pose>0 0 .2 0 0 0</pose></waypoint><waypoint>"
    "<time>.7</time><pose>1 .4 .2 0 0 0</pose></waypoint></trajectory>",
}
MOVER = """<model name='mover'><pose>0 0 .2 0 0 .4</pose><link name='l'><pose>{0}</pose><collision name='c'>
<geometry><box><size>.4 .2 .2</size></box></geometry></collision></link>{2}<plugin name='p'
filename='libgazelle_scripted_motion.so'>{1}<updateRate>{3}</updateRate></plugin></model>"""
BALL = """<model name='ball'><pose>.5 .2 .2 0 0 0</pose><link name='l'>{0}<collision name='c'><geometry>
<sphere><radius>.1</radius></sphere></geometry></collision></link></model>"""
SECOND = "<link name='m'><pose>0 0 .5 0 0 0</pose></link>"


@pytest.mark.parametrize(
    ("path", "offset", "more"),
    [
        *((path, "0 0 0 0 0 0", "") for path in PATHS),
        ("straight", ".1 0 .2 0 0 .3", ""),
        ("turning", ".1 0 .2 .1 0 .3", ""),
        ("straight", "0 0 0 0 0 0", SECOND),
    ],
)
def test_a_model_on_a_path_goes_as_python_puts_it(path, offset, more, monkeypatch):
    found, bind = [], ScriptedMotion.bind
    for native in (False, True):
        monkeypatch.setattr(ScriptedMotion, "bind", bind if native else lambda _: None)
        ball = BALL.format(drives.SOLID.format(1, 0.01))
        models = MOVER.format(offset, PATHS[path], more, 0 if path == "one" else 30) + ball
        text = f"<sdf version='1.7'><world name='w'>{drives.GROUND}{models}</world></sdf>"
        with gazelle.Simulation(
            formats.load_string(text), "mujoco", nworld=3, time_step=0.01
        ) as sim:
            sim.run(0.2)
            sim.reset([1])
            kept = sim.snapshot()
            sim.run(0.61)
            found.append(sim.engine.peek().copy())
            sim.restore(kept)
            sim.run(0.4)
            found.append(sim.engine.peek().copy())
    # numpy adds up squares and takes sines as the processor likes it best; the engine does not.
    most = 1e-9 if path in ("turning", "spinning", "leaning") else 0.0
    for one, other in ((0, 2), (1, 3)):
        np.testing.assert_allclose(found[other], found[one], rtol=0.0, atol=most)


@pytest.mark.parametrize(
    ("path", "native"), [("straight", True), ("turning", True), ("spline", False)]
)
def test_python_has_no_part_in_paths_that_engines_follow(path, native):
    models = MOVER.format("0 0 .1 0 0 0", PATHS[path], "", 30)
    text = f"<sdf version='1.7'><world name='w'>{drives.GROUND}{models}</world></sdf>"
    with gazelle.Simulation(formats.load_string(text), "mujoco") as sim:
        sim.step()
        assert (sim.loop._plan.settled is not None) == native
        before = sim.robots["mover"].position
        sim.run(0.3)
        assert abs(sim.robots["mover"].position - before).max() > 0.1


@pytest.mark.parametrize("lean", ["0 0 .4", ".3 -.2 2"])
def test_bases_that_slide_go_as_engines_set_them(lean):
    """Of several links, with a frame that is not the link's, leaning, in worlds of their own."""
    wheel = drives.WHEEL.format("left", 0.0, 0.12, drives.SOLID.format(0.3, 4e-4), "base")
    base = f"<link name='base'><pose>.03 .02 .1 .1 0 .2</pose>{drives.SOLID.format(3, 0.03)}</link>{wheel}"
    text = "".join(
        f"<model name='r{i}'><pose>{i} 0 1 {lean}</pose>{base}<plugin name='d' "
        "filename='libgazebo_ros_planar_move.so'/></model>"
        for i in range(2)
    )
    text = f"<sdf version='1.7'><world name='w'><gravity>0 0 0</gravity>{text}</world></sdf>"
    with gazelle.Simulation(formats.load_string(text), "mujoco", nworld=2) as sim:
        command = np.random.default_rng(0).normal(size=(2, 2, 3))
        linear, angular = np.zeros((2, 2, 2, 3))
        linear[..., :2], angular[..., 2] = command[..., :2], command[..., 2]
        names = ("r0", "r1")
        for number, name in enumerate(names):
            sim.robots[name].inputs["cmd_vel"].send(linear[:, number], angular[:, number])
        sim.run(0.3)
        assert sim.loop._plan.settled is not None
        models, joints = sim.engine.models[names], sim.engine.joints[("r0::left_joint",)]
        sim.engine.update(models.twist(linear, angular))
        found = sim.engine.peek().copy(), sim.engine.links["r0::left"].motion()
        models.set_ground_motion(command)
        wanted = sim.engine.peek().copy(), sim.engine.links["r0::left"].motion()
        np.testing.assert_allclose(found[0], wanted[0], rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(found[1].linear, wanted[1].linear, rtol=0.0, atol=1e-12)
        assert (joints.velocity() == 0.0).all()


@pytest.mark.parametrize("kind", WHEELS)
def test_steps_are_not_cut_for_drives_and_paths(kind, monkeypatch):
    path = (
        "<model name='mover'><pose>0 5 1 0 0 0</pose><link name='l'/><plugin name='p' "
        "filename='libgazelle_scripted_motion.so'><updateRate>0</updateRate>"
        "<angular_velocity>0 0 1</angular_velocity></plugin></model>"
    )
    for name in ("_PIECE", "_LONG_PIECE"):
        monkeypatch.setattr(step_loop, name, 1e9)
    with yard(kind, 2, native=True, more=path) as sim:
        sim.run(1.0)
        steps, batch = [], sim.engine.running.batch
        make = batch.step
        monkeypatch.setattr(batch, "step", lambda **how: (steps.append(how), make(**how)))
        sim.run(0.6)
        assert steps == [{"nstep": 60}]


@pytest.mark.parametrize("rate", [0.0, 40.0, 1e3 / 7])
@pytest.mark.parametrize("nworld", [1, 3])
def test_a_system_that_names_what_it_uses_is_updated_in_steps_to_the_same_bits(rate, nworld):
    found = []
    for known in (False, True):
        with yard("at every step", nworld, native=True, threads=2) as sim:
            engine = sim.engine
            names = tuple(each for each in engine.joints.names if each.startswith("r0::"))[:2]
            tables = WheelTables.empty(nworld, 1)
            law = DiffDriveLaw(tables, separation=[0.3], radius=[0.1], acceleration=[0.8])
            law.send_to(*engine.joints[names].motor_targets(), np.arange(2))
            law.rate, law.uses = rate, law.uses if known else None
            tables.linear[..., 0] = 0.1 + np.arange(nworld)[:, None]
            calls, make, time = [], engine.running.batch.step, 0
            engine.running.batch.step = lambda make=make, calls=calls, **how: (
                calls.append(1),
                make(**how),
            )
            for count in (1, 13, 2, 40):
                engine.step(count, [law], time)
                time += count * 10_000_000
                tables.linear[:] *= -1.0
            found.append((engine.snapshot().tobytes(), tables.speeds.tobytes(), law.due))
            assert (len(calls) == 4) == known
    assert found[0] == found[1]


def test_a_system_before_one_that_may_need_it_is_not_put_off():
    with yard("at every step", 1, native=True) as sim:
        names = tuple(each for each in sim.engine.joints.names if each.startswith("r0::"))[:2]
        targets, columns = sim.engine.joints[names].motor_targets()
        first, second = (
            DiffDriveLaw(
                WheelTables.empty(1, 1), separation=[0.3], radius=[0.1], acceleration=[0.0]
            )
            for _ in range(2)
        )
        for law in (first, second):
            law.send_to(targets, columns, np.arange(2))
        second.uses = None
        seen = []
        sim.engine.step(1, [first, second], 0)
        seen.append(sim.engine._made._sort([first, second]) or sim.engine._made._within)
        seen.append(sim.engine._made._sort([second, first]) or sim.engine._made._within)
        assert seen == [False, True]
