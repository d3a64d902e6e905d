"""A run changed from outside: forces with a beginning and an end, physics, parameters, reset."""

import gc
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
import scenes

from gazelle.description import Box, Light, Link, Model, Pose, Visual, World
from gazelle.errors import EngineError, SimulationError
from gazelle.simulation import Simulation


def floating(*models, **options):
    return Simulation(scenes.world(*models, gravity=(0.0, 0.0, 0.0)), **options)


def speed(sim, axis=0):
    return sim.robots["ball"].motion().linear[:, axis]


# -- forces ------------------------------------------------------------------------------


def test_a_wrench_acts_from_its_start_for_its_duration_to_the_step():
    with floating(scenes.ball(mass=2.0), nworld=2) as sim:
        link = sim.robots["ball"].links["link"]
        link.apply_wrench((3.0, 0.0, 0.0), start=0.1, duration=0.25, worlds=np.array([1]))
        sim.step(100)
        np.testing.assert_array_equal(speed(sim), 0.0)
        sim.step(1000)
        np.testing.assert_allclose(speed(sim), [0.0, 3.0 * 0.25 / 2.0], rtol=1e-12)


def test_several_wrenches_add_up_and_each_ends_by_itself():
    with floating(scenes.ball(mass=1.0)) as sim:
        link = sim.robots["ball"].links["link"]
        link.apply_wrench((1.0, 0.0, 0.0), duration=0.3)
        link.apply_wrench((2.0, 0.0, 0.0), start=0.1, duration=0.1)
        link.apply_wrench((0.0, 5.0, 0.0), start=0.5)
        sim.run(1.0)
        assert speed(sim)[0] == pytest.approx(0.3 + 0.2)
        assert speed(sim, 1)[0] == pytest.approx(2.5)
        link.clear_wrenches()
        sim.run(1.0)
        assert speed(sim, 1)[0] == pytest.approx(2.5)
        assert not sim.applied_wrenches.any


def test_a_force_at_a_point_turns_the_body_by_its_lever():
    with floating(scenes.ball(mass=1.0)) as sim:
        moment = 0.4 * 0.1**2
        sim.robots["ball"].links["link"].apply_wrench(
            (0.0, 0.1, 0.0), point=(0.1, 0.0, 0.0), duration=0.01
        )
        sim.run(0.1)
        spin = sim.robots["ball"].motion().angular[0, 2]
        assert spin == pytest.approx(0.1 * 0.1 * 0.01 / moment, rel=1e-9)


@pytest.mark.parametrize(("follow", "expected"), [(False, (0.0, 1.0)), (True, (1.0, 1.0))])
def test_a_wrench_in_the_frame_of_a_link_keeps_or_turns_its_direction(follow, expected):
    # The ball turns by a quarter turn a second: a following force ends up along -x.
    with floating(scenes.ball(mass=1.0, pose=Pose(yaw=np.pi / 2))) as sim:
        ball = sim.robots["ball"]
        ball.set_twist((0.0, 0.0, 0.0), (0.0, 0.0, np.pi / 2))
        ball.links["link"].apply_wrench(
            (1.0, 0.0, 0.0), frame=ball.links["link"], follow=follow, duration=1.0
        )
        sim.run(1.0)
        # Constant: (0, 1). Turning: the integral of (-sin, cos) over a quarter turn.
        share = 2.0 / np.pi if follow else 1.0
        assert -speed(sim)[0] == pytest.approx(share * expected[0], abs=2e-3)
        assert speed(sim, 1)[0] == pytest.approx(share * expected[1], abs=2e-3)


def test_an_effort_acts_for_its_duration_besides_a_lasting_one():
    with Simulation(scenes.world(scenes.burger(), gravity=(0, 0, 0))) as sim:
        joint = sim.robots["burger"].joints["wheel_left_joint"]
        name = joint.name
        joint.effort = 0.1
        joint.apply_effort(0.5, start=0.01, duration=0.02)
        sim.step(15)
        assert sim.engine.joints[name].effort()[0, 0] == pytest.approx(0.6)
        joint.effort = 0.2
        assert sim.engine.joints[name].effort()[0, 0] == pytest.approx(0.7)
        sim.step(30)
        assert sim.engine.joints[name].effort()[0, 0] == 0.2
        joint.clear_efforts()
        assert sim.engine.joints[name].effort()[0, 0] == 0.0


def test_forces_survive_a_snapshot_and_end_with_a_reset_of_their_world():
    with floating(scenes.ball(mass=1.0), nworld=2) as sim:
        sim.robots["ball"].links["link"].apply_wrench((1.0, 0.0, 0.0), start=0.2, duration=0.2)
        sim.run(0.3)
        saved = sim.snapshot()
        sim.run(0.5)
        future = speed(sim)
        sim.restore(saved)
        sim.run(0.5)
        np.testing.assert_array_equal(speed(sim), future)
        sim.restore(saved)
        sim.reset([0])
        sim.run(0.5)
        np.testing.assert_allclose(speed(sim), [0.0, 0.2])


def test_wrong_forces_are_refused_at_once():
    with floating(scenes.ball(), scenes.ground()) as sim:
        link = sim.robots["ball"].links["link"]
        with pytest.raises(SimulationError, match="finite"):
            link.apply_wrench((np.nan, 0.0, 0.0))
        with pytest.raises(SimulationError, match="duration"):
            link.apply_wrench((1.0, 0.0, 0.0), duration=-1.0)
        ground = sim.robots["ground_plane"].links["link"]
        with pytest.raises(EngineError, match="no force can act on it"):
            ground.apply_wrench((1.0, 0.0, 0.0), start=5.0)


def test_deleting_a_model_ends_what_pushes_it():
    with floating(scenes.ball(), scenes.box(pose=Pose(x=2.0))) as sim:
        ball, box = sim.robots["ball"].links["link"], sim.robots["box"].links["link"]
        ball.apply_wrench((1.0, 0.0, 0.0))
        box.apply_wrench((0.0, 1.0, 0.0), frame=ball)
        sim.run(0.1)
        sim.delete("ball")
        before = box.motion().linear
        sim.run(0.1)
        np.testing.assert_allclose(box.motion().linear, before, atol=1e-12)


# -- configuration and properties ----------------------------------------------------------


def test_a_configuration_is_set_at_once_in_each_world():
    with Simulation(scenes.world(scenes.burger()), nworld=2) as sim:
        robot = sim.robots["burger"]
        names = ["wheel_right_joint", "wheel_left_joint"]
        robot.set_configuration(names, [[0.1, 0.2], [0.3, 0.4]])
        np.testing.assert_array_equal(robot.joints[names[0]].positions()[:, 0], [0.1, 0.3])
        np.testing.assert_array_equal(robot.joints[names[1]].positions()[:, 0], [0.2, 0.4])
        with pytest.raises(SimulationError, match="wheel_left_joint must be 2 numbers"):
            robot.set_configuration(names, [0.1])


def test_properties_of_links_and_joints_change_in_the_middle_of_a_run():
    with Simulation(scenes.world(scenes.burger(), scenes.ball(pose=Pose(z=3.0)))) as sim:
        sim.run(0.1)
        ball = sim.robots["ball"].links["link"]
        ball.set_properties(mass=3.0, gravity=False, inertia=(0.1, 0.1, 0.1, 0, 0, 0))
        before = ball.motion().linear
        ball.apply_wrench((3.0, 0.0, 0.0), duration=0.5)
        sim.run(0.5)
        gained = ball.motion().linear - before
        np.testing.assert_allclose(gained, [[0.5, 0.0, 0.0]], atol=1e-9)
        joint = sim.robots["burger"].joints["wheel_left_joint"]
        joint.set_properties(damping=0.3, lower=-1.0, upper=1.0)
        assert sim.engine.parameter("joint_damping", joint.name)[0, 0] == 0.3
        assert sim.engine.parameter("joint_upper", joint.name)[0, 0] == 1.0


def test_links_can_be_attached_and_let_go():
    with floating(scenes.box("a"), scenes.box("b", pose=Pose(x=0.4))) as sim:
        a, b = sim.robots["a"].links["link"], sim.robots["b"].links["link"]
        sim.attach(a, b)
        a.apply_wrench((0.0, 2.0, 0.0))
        sim.run(0.5)
        assert b.pose.y > 0.02
        sim.detach(a, b)
        velocity = b.motion().linear
        sim.run(0.5)
        np.testing.assert_allclose(b.motion().linear, velocity, atol=1e-9)


def test_a_light_changes_what_is_seen():
    from gazelle.sensors import View, look_at

    lamp = Light("lamp", "directional", diffuse=(0.8, 0.8, 0.8, 1.0))
    cube = Link("l", visuals=(Visual("v", Box((0.5, 0.5, 0.5))),))
    world = World("w", models=(Model("cube", static=True, links=(cube,)),), lights=(lamp,))
    with Simulation(world) as sim:
        sim.set_light("lamp", diffuse=(0.0, 0.0, 0.0, 1.0))
        assert sim.world.lights[0].diffuse == (0.0, 0.0, 0.0, 1.0)
        with pytest.raises(SimulationError, match="did you mean 'lamp'"):
            sim.set_light("lamb", intensity=2.0)
        with pytest.raises(SimulationError, match="a light has no 'difuse'"):
            sim.set_light("lamp", difuse=(1.0, 1.0, 1.0, 1.0))
        view = View(look_at((1.0, 1.0, 1.0), (0.0, 0.0, 0.0)), width=8, height=6)
        dark = sim.render(view)
        sim.set_light("lamp", diffuse=(1.0, 1.0, 1.0, 1.0))
        assert sim.render(view).sum() > dark.sum()


# -- parameters --------------------------------------------------------------------------


def test_world_i_is_the_same_as_alone_with_its_parameters():
    friction, mass = [0.05, 0.1, 0.3], [0.8, 1.0, 1.3]

    def run(chosen):
        world = scenes.world(scenes.ground(), scenes.burger(stddev=0.01), step=0.002)
        with Simulation(world, nworld=len(chosen)) as sim:
            p = sim.parameters
            for side in ("left", "right"):
                p.friction[f"burger::wheel_{side}_link::c"] = [friction[i] for i in chosen]
            p.scale_mass("burger::base_footprint", [mass[i] for i in chosen])
            robot = sim.robots["burger"]
            robot.inputs["cmd_vel"].send(linear=0.2, angular=1.0)
            sim.run(1.5)
            return robot.position

    together = run([0, 1, 2])
    for i in range(3):
        np.testing.assert_array_equal(run([i])[0], together[i])
    assert len({tuple(place) for place in together}) == 3


def test_lidar_noise_of_each_world():
    with Simulation(
        scenes.world(*scenes.square(), scenes.burger(samples=360, stddev=0.0)), nworld=3
    ) as sim:
        name = "burger::base_footprint::lds"
        sim.parameters.lidar_noise[name] = [0.0, 0.01, 0.05]
        lidar = sim.robots["burger"].sensors["lds"]
        true = lidar.measure()[0]
        spread = (lidar.measure() - true).std(axis=1)
        np.testing.assert_allclose(spread, [0.0, 0.01, 0.05], rtol=0.15)
        with pytest.raises(SimulationError, match="did you mean"):
            sim.parameters.lidar_noise[name + "s"] = 0.1


def test_initial_poses_of_each_world_hold_at_every_reset():
    with Simulation(scenes.world(scenes.ground(), scenes.burger()), nworld=2) as sim:
        poses = sim.parameters.pose["burger"]
        poses[:, 0] = [0.5, -0.5]
        sim.parameters.pose["burger"] = poses
        sim.reset()
        np.testing.assert_array_equal(sim.robots["burger"].position[:, 0], [0.5, -0.5])
        sim.robots["burger"].set_pose((3.0, 0.0, 0.0))
        sim.reset([1])
        np.testing.assert_array_equal(sim.robots["burger"].position[:, 0], [3.0, -0.5])


def test_draws_do_not_depend_on_the_other_worlds():
    def draw(nworld):
        with Simulation(scenes.world(scenes.box()), nworld=nworld, seed=3) as sim:
            sim.parameters.randomize("link_mass", "box::link", 0.5, 1.5)
            sim.parameters.randomize("gravity", "", (0, 0, -10.0), (0, 0, -9.0))
            return sim.parameters.link_mass["box::link"], sim.parameters.gravity

    few, many = draw(2), draw(50)
    np.testing.assert_array_equal(few[0], many[0][:2])
    np.testing.assert_array_equal(few[1], many[1][:2])
    assert 0.5 <= many[0].min() < 0.6 < 1.4 < many[0].max() < 1.5
    sim = Simulation(scenes.world(scenes.box()))
    with pytest.raises(SimulationError, match="did you mean 'link_mass'"):
        sim.parameters.randomize("link_mas", "box::link", 0.5, 1.5)


def test_a_snapshot_holds_parameters_attachments_and_physics():
    with Simulation(
        scenes.world(scenes.ground(), scenes.box("a"), scenes.box("b", pose=Pose(x=0.5))), nworld=2
    ) as sim:
        a, b = sim.robots["a"].links["link"], sim.robots["b"].links["link"]
        sim.parameters.link_mass["a::link"] = [1.0, 2.0]
        sim.attach(a, b)
        sim.run(0.1)
        saved = sim.snapshot()
        sim.run(0.2)
        future = sim.state_hash()
        sim.detach(a, b)
        sim.physics.time_step = 0.005
        sim.parameters.link_mass["a::link"] = 9.0
        sim.parameters.friction["b::link::c"] = 0.1
        sim.run(0.2)
        sim.restore(saved)
        np.testing.assert_array_equal(sim.parameters.link_mass["a::link"], [1.0, 2.0])
        sim.run(0.2)
        assert sim.state_hash() == future


# -- reset -------------------------------------------------------------------------------


def test_a_reset_with_a_seed_is_a_run_with_that_seed():
    def world():
        return scenes.world(scenes.ground(), *scenes.square(), scenes.burger(stddev=0.01))

    def scans(sim):
        sim.run(0.5)
        return sim.robots["burger"].sensors["lds"].latest()

    with (
        Simulation(world(), seed=1, nworld=2) as sim,
        Simulation(world(), seed=7, nworld=2) as sim7,
    ):
        for each in (sim, sim7):
            each.robots["burger"].sensors["lds"].subscribe(lambda unit: None)
        first = scans(sim)
        sim.reset(seed=7)
        assert sim.seed == 7
        seventh = scans(sim)
        np.testing.assert_array_equal(seventh, scans(sim7))
        sim.reset(seed=1)
        np.testing.assert_array_equal(scans(sim), first)
        assert (first != seventh).any()


def test_a_reset_can_leave_the_clock_alone():
    with Simulation(scenes.world(scenes.ground(), scenes.burger())) as sim:
        sim.robots["burger"].inputs["cmd_vel"].send(linear=0.2)
        sim.run(1.0)
        sim.reset(time=False)
        assert sim.time == 1.0
        np.testing.assert_array_equal(sim.robots["burger"].position[0], 0.0)
        sim.run(0.1)


@pytest.mark.parametrize("stage", [1, 2, 3, 4])
def test_the_turtlebot3_stages_reset_in_less_than_a_millisecond(stage):
    with Simulation(f"turtlebot3_stage_{stage}") as sim:
        sim.spawn("turtlebot3_burger", name="burger")
        sim.run(0.5)
        took = []
        for _ in range(50):
            start = time.process_time()
            sim.reset()
            took.append(time.process_time() - start)
        assert min(took) < 1e-3


# -- spawn and delete ------------------------------------------------------------------------


def cycles(count):
    """Spawn and delete a ball; returns how much memory grew [byte], Python's and all."""
    world = scenes.world(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(2.0, 0.0, 0.1)))
    with Simulation(world, nworld=2) as sim:
        sim.robots["burger"].inputs["cmd_vel"].send(linear=[0.1, 0.2])
        sim.run(0.5)
        before = sim.engine.snapshot()
        ball = scenes.ball(pose=Pose(y=3.0, z=1.0))
        python, whole = [], []
        for k in range(count):
            if k == count - 60:
                tracemalloc.start()
            sim.spawn(ball)
            sim.delete("ball")
            if k in {count // 5, 3 * count // 5, count - 1}:
                gc.collect()
                whole.append(resident())
            if k in {count - 40, count - 1}:
                gc.collect()
                python.append(tracemalloc.get_traced_memory()[0])
        tracemalloc.stop()
        np.testing.assert_array_equal(sim.engine.snapshot(), before)
        sim.run(0.1)
    # What leaks grows all the time; an arena or a stack that is taken once is no leak.
    return python[1] - python[0], 2 * min(whole[1] - whole[0], whole[2] - whole[1])


def resident():
    """Return resident memory [byte]."""
    import resource

    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * resource.getpagesize()


@pytest.mark.long
def test_200_spawns_and_deletes_leave_memory_and_all_else_as_it_is():
    python, whole = cycles(200)
    assert python < 60_000  # numpy keeps small arrays for later
    assert whole < 8_000_000


@pytest.mark.slow
def test_10000_spawns_and_deletes_leave_memory_and_all_else_as_it_is():
    python, whole = cycles(10_000)
    assert python < 60_000  # numpy keeps small arrays for later
    assert whole < 8_000_000
