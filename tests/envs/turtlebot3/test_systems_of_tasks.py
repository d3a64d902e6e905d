"""Systems in native code give what the plugins that they stand for give one by one."""

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import gazelle.envs  # noqa: F401  registers the environments
from gazelle.envs.options import NavigationSettings
from gazelle.envs.turtlebot3.task import TurtleBot3Task


def listen(task):
    """Subscribe, so that Python updates what a kernel does without subscribers."""
    for robot in task.scene.simulation.robots.values():
        for name in robot.outputs.keys() & {"odom", "odom_tf"}:  # a scan would draw more noise
            robot.outputs[name].subscribe(lambda _: None)


def tasks(stage, nworld=32, *, continuous=False, **options):
    settings = NavigationSettings(engine="planar", seed=5, threads=1, **options)
    made = [
        TurtleBot3Task(stage, nworld, continuous=continuous, settings=settings) for _ in range(2)
    ]
    listen(made[0])
    return made


@pytest.mark.parametrize(
    ("stage", "rays", "continuous"),
    [(1, 360, False), (2, 24, True), (3, 24, False), (4, 24, False), (4, 90, True)],
)
def test_a_task_on_systems_gives_what_one_on_plugins_gives(stage, rays, continuous):
    plugins, systems = tasks(stage, continuous=continuous, lidar_samples=rays, max_episode_steps=35)
    everywhere = np.arange(32)
    np.testing.assert_allclose(
        systems.begin(everywhere)[0], plugins.begin(everywhere)[0], atol=1e-6
    )
    generator = np.random.default_rng(stage)
    ends = 0
    for _ in range(50):
        actions = generator.integers(0, 5, 32)
        if continuous:
            actions = generator.uniform([0.5, -1.0], [1.0, 1.0], (32, 2))
        wanted, got = plugins.advance(actions), systems.advance(actions)
        np.testing.assert_allclose(got.observation, wanted.observation, atol=1e-5)
        np.testing.assert_allclose(got.reward, wanted.reward, atol=1e-9)
        np.testing.assert_array_equal(got.terminated, wanted.terminated)
        for name, values in wanted.info.items():
            np.testing.assert_allclose(got.info[name], values, atol=1e-9)
        done = np.flatnonzero(wanted.terminated | wanted.truncated)
        ends += len(done)
        if len(done):
            np.testing.assert_allclose(systems.begin(done)[0], plugins.begin(done)[0], atol=1e-5)
    assert ends >= 32
    for task in (plugins, systems):
        task.close()


def same(got, wanted):
    assert list(got) == list(wanted)
    for name, values in wanted.items():
        assert got[name].dtype == values.dtype
        np.testing.assert_allclose(got[name], values, atol=1e-9)


@pytest.mark.parametrize(
    ("stage", "options"),
    [
        (4, {"lidar_samples": 24}),
        (4, {"lidar_samples": 24, "max_episode_steps": 35, "respawn": False}),
        (1, {"lidar_samples": 9, "max_episode_steps": 20, "goals": [(0.6, 0.0), (0.3, 0.3)]}),
        (2, {"max_episode_steps": 11, "goals": [(0.35, 0.0), (0.3, 0.2)], "respawn": False}),
    ],
)
def test_steps_with_the_next_episodes_are_those_of_plugins(stage, options):
    plugins, systems = tasks(stage, **options)
    for task in (plugins, systems):
        task.begin(np.arange(32))
    generator = np.random.default_rng(stage)
    ends = dict.fromkeys(("is_success", "is_collision", "is_timeout"), 0)
    goals = 0
    for _ in range(90):
        actions = generator.choice([1, 2, 2, 3], 32)
        wanted, got = plugins.step(actions), systems.step(actions)
        for one, other in ((got.transition, wanted.transition),):
            np.testing.assert_allclose(one.observation, other.observation, atol=1e-5)
            np.testing.assert_allclose(one.reward, other.reward, atol=1e-9)
            np.testing.assert_array_equal(one.terminated, other.terminated)
            np.testing.assert_array_equal(one.truncated, other.truncated)
            same(one.info, other.info)
            goals += int(one.info["is_success"].sum())
        assert (got.final is None) == (wanted.final is None)
        if wanted.final is None:
            continue
        np.testing.assert_array_equal(got.final.worlds, wanted.final.worlds)
        np.testing.assert_allclose(got.final.observation, wanted.final.observation, atol=1e-5)
        same(got.final.info, wanted.final.info)
        for name in ends.keys() & wanted.final.info.keys():
            ends[name] += int(wanted.final.info[name].sum())
    assert ends["is_collision"] if stage == 4 else ends["is_timeout"]
    assert goals or ends["is_success"] or "goals" not in options
    for name in ("goal", "goal_draws", "goals_reached", "start_distance", "elapsed"):
        np.testing.assert_allclose(systems.get_state()[name], plugins.get_state()[name], atol=1e-9)
    for task in (plugins, systems):
        task.close()


def test_robots_that_drive_into_walls_stop_where_they_do_part_by_part():
    plugins, systems = tasks(4)
    for task in (plugins, systems):
        task.begin(np.arange(32))
    generator = np.random.default_rng(1)
    turns = generator.integers(0, 5, 32)
    for step in range(70):  # nobody is reset: they push against walls and pillars
        actions = turns if step < 8 else np.full(32, 2)
        wanted, got = plugins.advance(actions), systems.advance(actions)
        np.testing.assert_allclose(got.observation, wanted.observation, atol=1e-5)
    stalled = systems.scene.simulation.engine.fleet.stalled
    assert stalled.any()
    np.testing.assert_array_equal(stalled, plugins.scene.simulation.engine.fleet.stalled)


def test_a_state_of_systems_goes_on_in_plugins():
    plugins, systems = tasks(4, 8)
    systems.begin(np.arange(8))
    generator = np.random.default_rng(2)
    for _ in range(7):
        systems.advance(generator.integers(0, 5, 8))
    plugins.set_state(systems.get_state())
    for _ in range(7):
        actions = generator.integers(0, 5, 8)
        wanted, got = plugins.advance(actions), systems.advance(actions)
        np.testing.assert_allclose(got.observation, wanted.observation, atol=1e-5)


def make_vec(num_envs, **options):
    return gym.make_vec(
        "gazelle/TurtleBot3Stage4-v0",
        num_envs=num_envs,
        vectorization_mode="vector_entry_point",
        engine="planar",
        **options,
    )


def test_results_do_not_depend_on_threads_or_the_number_of_worlds():
    envs = [make_vec(300, threads=1), make_vec(300, threads=2), make_vec(3, threads=1)]
    first = [env.reset(seed=9)[0] for env in envs]
    assert (first[0] == first[1]).all()
    assert (first[0][:3] == first[2]).all()
    generator = np.random.default_rng(3)
    for _ in range(60):
        actions = generator.integers(0, 5, 300)
        steps = [env.step(actions[: env.num_envs]) for env in envs]
        for left, right, small in zip(*(step[:4] for step in steps), strict=True):
            np.testing.assert_array_equal(left, right)
            np.testing.assert_array_equal(left[:3], small)
    for env in envs:
        env.close()


def test_a_seed_starts_the_same_run_over():
    env = make_vec(16)
    runs = []
    for _ in range(2):
        env.reset(seed=4)
        generator = np.random.default_rng(0)
        runs.append([env.step(generator.integers(0, 5, 16))[0] for _ in range(40)])
    np.testing.assert_array_equal(runs[0], runs[1])
    env.reset(seed=5)
    other = env.step(np.full(16, 2))[0]
    assert (other != runs[0][0]).any()


@pytest.mark.parametrize("name", ["TurtleBot3Stage1", "TurtleBot3Stage4Continuous"])
def test_gymnasium_accepts_the_planar_environments(name):
    env = gym.make(f"gazelle/{name}-v0", engine="planar")
    check_env(env.unwrapped, skip_render_check=True)
    env.close()


def test_rewards_and_ends_are_those_of_the_physical_engine():
    """Straight drives, and turns that last, in both engines: what a policy would learn from."""
    made = {}
    for engine in ("mujoco", "planar"):
        env = gym.make_vec(
            "gazelle/TurtleBot3Stage1-v0",
            num_envs=5,
            vectorization_mode="vector_entry_point",
            engine=engine,
            threads=1,
        )
        env.reset(seed=1)
        steps = [env.step(np.arange(5)) for _ in range(80)]
        made[engine] = [np.array([step[k] for step in steps]) for k in (0, 1, 2)]
        env.close()
    (seen, pay, end), (seen_flat, pay_flat, end_flat) = made["mujoco"], made["planar"]
    # The one that goes straight: it reaches the goal ahead, and then the wall.
    assert abs(int(end[:, 2].argmax()) - int(end_flat[:, 2].argmax())) <= 1
    assert end[:, 2].any()
    assert end_flat[:, 2].any()
    assert (pay[:, 2] == 200.0).any()
    assert (pay_flat[:, 2] == 200.0).any()
    early = slice(0, 5)
    np.testing.assert_allclose(seen_flat[early, 2, 24:26], seen[early, 2, 24:26], atol=0.04)
    np.testing.assert_allclose(pay_flat[early, 2], pay[early, 2], atol=0.3)
    # Those that turn on the spot of a circle end nowhere in either.
    assert not end[:, [0, 4]].any()
    assert not end_flat[:, [0, 4]].any()
