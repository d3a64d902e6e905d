"""Starts and goals off the published ones."""

from __future__ import annotations

import dataclasses

import gymnasium as gym
import numpy as np
import pytest

import gazelle.envs  # noqa: F401  registers the environments
from gazelle import formats
from gazelle.description import Pose
from gazelle.envs.options import NavigationSettings, held_out_options
from gazelle.envs.turtlebot3.layout import GoalLayout
from gazelle.envs.turtlebot3.places import grid_goals, plaza_goals
from gazelle.envs.turtlebot3.task import TurtleBot3Task
from gazelle.errors import TaskError
from gazelle.plugins.scripted_motion import ScriptedMotion
from tests.envs.turtlebot3.test_systems_of_tasks import listen

HELD_OUT = {"starts": "held-out", "goals": "held-out"}
ENGINES = ["planar", "mujoco"]


def many(stage, num_envs=32, engine="planar", **options):
    return gym.make_vec(
        f"gazelle/TurtleBot3Stage{stage}-v0",
        num_envs=num_envs,
        vectorization_mode="vector_entry_point",
        engine=engine,
        **options,
    )


def away(points, others):
    """Return the distance of each point from the nearest of others [m]."""
    return np.hypot(*np.moveaxis(points[:, None] - others[None], 2, 0)).min(axis=1)


@pytest.mark.parametrize("stage", [1, 2, 3, 4])
def test_held_out_goals_are_neither_published_nor_trained_on(stage):
    held_out = GoalLayout(stage, NavigationSettings(**HELD_OUT)).goals().points
    trained = GoalLayout(stage, NavigationSettings(goals="training")).goals().points
    published = (plaza_goals() if stage == 4 else grid_goals()).points
    assert away(held_out, trained).min() > 0.07
    assert away(held_out, published).min() > (0.15 if stage == 4 else 0.07)
    assert len(held_out) > 300


def test_held_out_goals_keep_away_from_those_a_user_trained_on():
    mine = [(1.05, 0.55), (-0.95, -1.25)]
    options = held_out_options({"goals": mine, "lidar_samples": 12})
    points = GoalLayout(1, NavigationSettings(**options)).goals().points
    assert away(points, np.array(mine)).min() > 0.2
    assert len(points) > 300


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("stage", [1, 2, 3, 4])
def test_nobody_starts_near_anything_or_at_the_goal(stage, engine):
    env = many(stage, 48, engine, respawn=False, **HELD_OUT)
    observation, info = env.reset(seed=3)
    start, goal = info["scenario"][:, :2], info["scenario"][:, 3:5]
    assert (np.hypot(*(start - goal).T) > 0.5).all()
    # Noise of the lidar is a centimetre or so.
    assert observation[:, :24].min() > 0.3
    np.testing.assert_allclose(info["position"], start, atol=0.02)
    np.testing.assert_allclose(info["goal"], goal)
    env.close()


@pytest.mark.parametrize("engine", ENGINES)
def test_episodes_differ_in_start_heading_goal_and_phases(engine):
    env = many(4, 64, engine, respawn=False, max_episode_steps=3, **HELD_OUT)
    seen = [env.reset(seed=0)[1]["scenario"]]
    for _ in range(6):
        *_, info = env.step(np.full(64, 2))
        if "final_info" in info:
            seen.append(info["scenario"])
    scenarios = np.vstack([rows[rows.any(axis=1)] for rows in seen])
    assert len(scenarios) >= 3 * 64
    assert len(np.unique(scenarios, axis=0)) == len(scenarios)
    assert env.unwrapped.scenario_names[-2:] == ("phase_0", "phase_1")
    for column, (low, high) in {2: (-np.pi, np.pi), 5: (0, 158.6), 6: (0, 145.9)}.items():
        shares = (scenarios[:, column] - low) / (high - low)
        assert np.abs(np.histogram(shares, 4, (0, 1))[0] / len(shares) - 0.25).max() < 0.13
    env.close()


def test_both_engines_have_the_same_episodes():
    firsts = []
    for engine in ENGINES:
        env = many(4, 16, engine, respawn=False, **HELD_OUT)
        observation, info = env.reset(seed=8)
        firsts.append((info["scenario"], observation))
        env.close()
    np.testing.assert_array_equal(firsts[0][0], firsts[1][0])
    np.testing.assert_allclose(firsts[0][1][:, 24:26], firsts[1][1][:, 24:26], atol=0.03)
    assert np.median(np.abs(firsts[0][1][:, :24] - firsts[1][1][:, :24])) < 0.03


def test_obstacles_stand_where_their_phase_says():
    settings = NavigationSettings(engine="planar", seed=2, **HELD_OUT)
    task = TurtleBot3Task(3, 8, continuous=False, settings=settings)
    task.begin(np.arange(8))
    phases = task.scenario(np.arange(8))[:, 5]
    loaded = [entry.plugin for entry in task.scene.simulation.plugins]
    script = next(plugin for plugin in loaded if isinstance(plugin, ScriptedMotion))
    for _ in range(3):
        turn = np.angle(np.exp(1j * (script.robot.yaw - script.spin[2] * phases)))
        np.testing.assert_allclose(turn, turn[0], atol=1e-9)
        task.advance(np.full(8, 2))
    task.close()


@pytest.mark.long
@pytest.mark.parametrize("stage", [3, 4])
def test_a_task_on_systems_begins_as_one_on_plugins(stage):
    settings = NavigationSettings(
        engine="planar", seed=5, threads=1, respawn=False, max_episode_steps=25, **HELD_OUT
    )
    plugins, systems = (
        TurtleBot3Task(stage, 16, continuous=False, settings=settings) for _ in range(2)
    )
    listen(plugins)
    everywhere = np.arange(16)
    np.testing.assert_allclose(
        systems.begin(everywhere)[0], plugins.begin(everywhere)[0], atol=1e-5
    )
    generator = np.random.default_rng(stage)
    begun = 0
    for _ in range(60):
        actions = generator.integers(0, 5, 16)
        wanted, got = plugins.step(actions), systems.step(actions)
        np.testing.assert_allclose(
            got.transition.observation, wanted.transition.observation, atol=1e-5
        )
        assert list(got.transition.info) == list(wanted.transition.info)
        for name, values in wanted.transition.info.items():
            np.testing.assert_allclose(got.transition.info[name], values, atol=1e-9)
        begun += 0 if wanted.final is None else len(wanted.final.worlds)
    assert begun >= 32
    for task in (plugins, systems):
        task.close()


@pytest.mark.long
@pytest.mark.parametrize("engine", ENGINES)
def test_a_saved_environment_goes_on_with_the_same_bits(engine):
    env = many(4, 4, engine, respawn=False, max_episode_steps=8, **HELD_OUT)
    env.reset(seed=1)
    for _ in range(5):
        env.step(np.full(4, 1))
    state = env.get_state()
    first = [env.step(np.full(4, 3)) for _ in range(12)]
    other = many(4, 4, engine, respawn=False, max_episode_steps=8, **HELD_OUT)
    other.reset(seed=7)
    other.set_state(state)
    for wanted in first:
        got = other.step(np.full(4, 3))
        np.testing.assert_array_equal(got[0], wanted[0])
        if "scenario" in wanted[4]:
            np.testing.assert_array_equal(got[4]["scenario"], wanted[4]["scenario"])
    env.close()
    other.close()


@pytest.mark.long
def test_worlds_know_nothing_of_each_other():
    few, lots = many(4, 3, **HELD_OUT), many(4, 20, **HELD_OUT)
    one = gym.make("gazelle/TurtleBot3Stage4-v0", engine="planar", **HELD_OUT)
    first = lots.reset(seed=4)[1]["scenario"]
    np.testing.assert_array_equal(few.reset(seed=4)[1]["scenario"], first[:3])
    np.testing.assert_array_equal(one.reset(seed=4)[1]["scenario"], first[0])
    for env in (few, lots, one):
        env.close()


def test_published_starts_are_the_default():
    env = many(4, 3)
    _, info = env.reset(seed=4)
    np.testing.assert_array_equal(info["scenario"], [[-0.7, 0.0, 0.0, 0.6, 0.0]] * 3)
    env.close()


@pytest.mark.parametrize(
    ("options", "text"),
    [({"goals": "heldout"}, "held-out"), ({"starts": "trainig"}, "training")],
)
def test_a_near_miss_is_named(options, text):
    with pytest.raises(TaskError) as raised:
        many(1, 1, **options)
    assert text in str(raised.value.hint)


def test_a_world_of_ones_own_has_places_too():
    layout = GoalLayout(1, NavigationSettings(world="furnished_room", **HELD_OUT))
    assert len(layout.goals().points) > 100


def test_a_start_in_an_obstacle_says_what_to_do():
    settings = NavigationSettings(world="turtlebot3_world", **HELD_OUT)
    with pytest.raises(TaskError, match=r"within 0\.2 m of something") as raised:
        GoalLayout(1, settings).goals()
    assert 'starts="published"' in str(raised.value.hint)


@pytest.mark.filterwarnings("ignore:the lidar 'lds_lfcd_sensor'")
def test_a_robot_whose_lidar_leans_has_places_too():
    """Its rays cannot be cast in the plane, where free space is looked for."""
    robot = formats.load_model("turtlebot3_burger")
    links = [
        dataclasses.replace(
            link,
            sensors=tuple(
                dataclasses.replace(each, pose=Pose(0.0, 0.0, 0.0, 0.0, 0.3, 0.0))
                for each in link.sensors
            ),
        )
        for link in robot.links
    ]
    tilted = dataclasses.replace(robot, links=tuple(links))
    usual, leaning = (
        GoalLayout(1, NavigationSettings(robot=each, **HELD_OUT)).goals().points
        for each in (None, tilted)
    )
    np.testing.assert_array_equal(leaning, usual)


@pytest.mark.parametrize("starts", ["published", "held-out"])
def test_goals_in_free_space_are_drawn_anew_for_each_episode(starts):
    """Also where episodes go on at a goal: one that cannot be reached would come up for ever."""
    env = many(4, 16, goals="training", starts=starts, respawn=True, max_episode_steps=2)
    goals = [env.reset(seed=0)[1]["goal"]]
    goals += [env.step(np.full(16, 2))[4]["goal"] for _ in range(8)]
    assert len(np.unique(np.vstack(goals), axis=0)) > 50
    env.close()


@pytest.mark.parametrize("margin", [0.0, 0.1])
def test_a_margin_makes_ranges_collisions_sooner(margin):
    env = many(4, 32, "planar", respawn=False, margin=margin, **HELD_OUT)
    env.reset(seed=2)
    nearest = []
    for _ in range(60):
        _, _, _, _, info = env.step(np.full(32, 2))  # straight on
        if "final_obs" in info:
            crashed = np.flatnonzero(info["final_info"]["is_collision"])
            nearest += [info["final_obs"][world][:24].min() for world in crashed]
    assert len(nearest) > 20
    # A step drives 0.03 m, and obstacles come as far or more.
    assert 0.13 + margin - 0.08 < min(nearest)
    assert max(nearest) < 0.13 + margin
    assert max(nearest) > 0.13 + margin - 0.02
    env.close()


def test_evaluations_know_no_margin():
    assert held_out_options({"margin": 0.04})["margin"] == 0.0
    assert "margin" not in held_out_options({})


@pytest.mark.parametrize("margin", [-0.01, 0.2, "wide", True, float("nan")])
def test_a_margin_that_cannot_be_is_refused(margin):
    with pytest.raises(TaskError, match=r"margin must be from 0 to 0\.15 metres"):
        NavigationSettings(margin=margin)
