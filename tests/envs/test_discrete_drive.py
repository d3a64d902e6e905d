"""openai_ros' driving tasks: what is seen, paid and ended, by its rules."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import gazelle.envs
from gazelle import assets, formats
from gazelle.description import Pose
from gazelle.envs.discrete_drive.rules import (
    HUSARION,
    MAZE,
    SUMMIT_XL,
    TURTLEBOT3_WORLD,
    WALL,
    DriveRules,
)
from gazelle.envs.discrete_drive.scoring import ends_of, has_crashed, reward_of
from gazelle.envs.discrete_drive.task import DriveSettings, DriveTask

NAMES = ("TurtleBot2Maze", "TurtleBot2Wall", "TurtleBot3World", "Husarion", "SummitXLRoom")
RULES = dict(zip(NAMES, (MAZE, WALL, TURTLEBOT3_WORLD, HUSARION, SUMMIT_XL), strict=True))


def vector(name, count, **options):
    options = {"engine": "planar", **options}
    return gym.make_vec(
        f"gazelle/{name}-v0", num_envs=count, vectorization_mode="vector_entry_point", **options
    )


def begun(rules, nworld=1, **options):
    task = DriveTask(rules, nworld, DriveSettings(**{"engine": "planar", **options}))
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


@pytest.mark.parametrize("name", NAMES)
def test_gymnasiums_checker_finds_nothing(name):
    env = gym.make(f"gazelle/{name}-v0", render_mode="rgb_array")
    check_env(env.unwrapped)
    env.close()


@pytest.mark.parametrize("name", NAMES)
def test_the_rays_that_are_cast_are_those_that_the_published_loop_picks(name):
    """``if i % every == 0`` over the whole scan, which is cast here by a robot of its own."""
    rules = RULES[name]
    task = begun(rules, 6, starts="training")
    simulation = gazelle.Simulation(assets.world(rules.world), "planar", nworld=6)
    robot = simulation.spawn(formats.load_model(assets.robot(rules.robot)), pose=Pose(*rules.start))
    robot.set_pose(task.robot.placement(None).position, yaw=task.scenario(np.arange(6))[:, 2])
    whole = robot.sensors[task.lidar.sensor].measure(None)
    seen = task.observe(None)
    for world in range(6):
        wanted, sure = [], []
        for i, item in enumerate(whole[world].tolist()):
            if i % rules.every == 0:
                if np.isinf(item):
                    wanted.append(rules.far)
                else:
                    whole_metres = rules.decimals is None
                    raised = max(item, rules.least)
                    wanted.append(int(raised) if whole_metres else round(raised, rules.decimals))
                # The burger's laser has noise, which may carry a range over a whole metre.
                sure.append(rules.robot != "turtlebot3_burger" or abs(item % 1.0 - 0.5) < 0.42)
        found = seen[world, : len(wanted)][sure]
        np.testing.assert_allclose(found, np.array(wanted)[sure], atol=1e-6)
    extra = (2 if rules.goal else 0) + rules.sees_yaw + 2 * rules.sees_goal
    assert seen.shape[1] == len(wanted) + extra


def published_wall(rules, ranges, place, before, forward):
    """Return the published loop of TurtleBot2Wall for one step, as its code reads."""
    done = any(rules.crash_range > item > 0 for item in ranges)
    x, y = place
    gx, gy = rules.goal
    at_goal = gx - 0.05 < x <= gx + 0.05 and gy - 0.05 < y <= gy + 0.05
    if not (-1.0 < x <= 6.0 and -3.0 < y <= 3.0) or at_goal:
        done = True
    distance = np.hypot(x - gx, y - gy)
    if done:
        return (200 if at_goal else -200), True
    return (5 if forward else 1) + (5 if distance < before else 0), False


def test_rewards_and_ends_are_those_of_the_published_loop():
    task = begun(WALL, 32, starts="training")
    rng = np.random.default_rng(3)
    ended = 0
    for _ in range(60):
        before = task.memory["distance"].copy()
        actions = rng.choice(3, 32, p=(0.8, 0.1, 0.1))
        step = task.advance(actions)
        ranges = task.robot.sensors[task.lidar.sensor].measure(None)
        for world in range(32):
            place = step.observation[world, -2:].astype(float).round(2)
            wanted = published_wall(WALL, ranges[world], place, before[world], actions[world] == 0)
            assert (step.reward[world], bool(step.terminated[world])) == wanted
        over = np.flatnonzero(step.terminated)
        ended += len(over)
        if len(over):
            task.begin(over)
    assert ended > 10


def test_the_goal_is_a_success_and_ends_the_episode():
    env = vector("TurtleBot2Wall", 1, goal=(1.0, 0.0), autoreset_mode="Disabled")
    env.reset(seed=0)
    rewards = []
    for _ in range(12):
        _, reward, terminated, _, info = env.step(np.array([0]))
        rewards.append(float(reward[0]))
        if terminated[0]:
            break
    assert rewards == [10.0] * 9 + [200.0]
    assert info["is_success"][0]
    assert not info["is_collision"][0]
    env.close()


def test_driving_into_a_wall_is_a_crash():
    env = vector("TurtleBot2Maze", 1, autoreset_mode="Disabled")
    env.reset(seed=0)
    rewards = []
    while not rewards or rewards[-1] > 0:
        seen, reward, terminated, _, info = env.step(np.array([0]))
        rewards.append(float(reward[0]))
    # The corridor's end is at 7 m, and no ray looks straight along it at first.
    assert rewards == [5.0] * (len(rewards) - 1) + [-200.0]
    assert terminated[0]
    assert info["is_collision"][0]
    assert 5.0 < info["position"][0, 0] < 6.6
    assert seen.min() <= 0.5
    env.close()


def test_lasting_without_a_crash_is_a_success_where_there_is_no_goal():
    env = vector("TurtleBot2Maze", 2, max_episode_steps=5)
    env.reset(seed=0)
    for _ in range(5):
        _, _, terminated, truncated, info = env.step(np.array([0, 1]))
    assert truncated.all()
    assert not terminated.any()
    assert info["final_info"]["is_success"].all()
    env.close()


@pytest.mark.parametrize("name", NAMES)
def test_starts_in_free_space_are_clear_and_others_when_held_out(name):
    places = {}
    for kind in ("training", "held-out"):
        task = begun(RULES[name], 40, starts=kind)
        scenario = task.scenario(np.arange(40))
        np.testing.assert_allclose(task.robot.planar_pose(None), scenario, atol=1e-6)
        nearest = task.robot.sensors[task.lidar.sensor].measure(None).min(axis=1)
        assert (nearest > (RULES[name].crash_range or RULES[name].least)).all()
        places[kind] = {tuple(row) for row in scenario[:, :2].round(6).tolist()}
    assert not places["training"] & places["held-out"]


def test_both_engines_drive_alike():
    seen = []
    for engine in ("planar", "mujoco"):
        task = begun(MAZE, 1, engine=engine)
        for action in (0, 0, 0, 1, 1, 0, 0, 2, 2, 0):
            task.advance(np.array([action]))
        seen.append(task.robot.planar_pose(None)[0])
    np.testing.assert_allclose(*seen, atol=0.05)


def test_a_reward_has_one_reason():
    rules = DriveRules(
        world="",
        robot="",
        every=1,
        crash_range=0.5,
        velocities=(),
        goal=(0.0, 0.0),
        rewards=((1.0, 11.0), (1.0, 11.0)),
    )
    place = np.array([[0.05, -0.04], [-0.05, 0.0], [1.0, 1.0]])
    ranges = np.array([[0.4], [1.0], [1.0]])
    ends = ends_of(rules, has_crashed(rules, ranges, ranges), place)
    assert ends.reached.tolist() == [True, False, False]  # the lower bound does not count
    assert ends.crashed.tolist() == [True, False, False]
    forward, closer = np.array([True, True, False]), np.array([True, True, False])
    reward = reward_of(rules, over=ends.over, reached=ends.reached, forward=forward, closer=closer)
    assert reward.tolist() == [200.0, 11.0, 1.0]


def test_worlds_do_not_know_of_others_and_states_go_on():
    many, one, other = (vector("TurtleBot2Wall", n, starts="training") for n in (4, 1, 4))
    np.testing.assert_array_equal(many.reset(seed=9)[0][:1], one.reset(seed=9)[0])
    actions = np.random.default_rng(0).integers(0, 3, (60, 4))
    for row in actions[:30]:
        np.testing.assert_array_equal(many.step(row)[0][:1], one.step(row[:1])[0])
    other.reset(seed=1)
    other.unwrapped.set_state(many.unwrapped.get_state())
    for row in actions[30:]:
        np.testing.assert_array_equal(many.step(row)[0], other.step(row)[0])
    for env in (many, one, other):
        env.close()


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("TurtleBot2Maze", {"goal": (1.0, 2.0)}, "no goal"),
        ("TurtleBot2Wall", {"goal": (1.0,)}, "x and y"),
        ("TurtleBot2Wall", {"starts": "heldout"}, "kind of starts"),
    ],
)
def test_options_that_cannot_be_are_refused(name, options, message):
    with pytest.raises(gazelle.TaskError, match=message):
        vector(name, 1, **options)


def test_the_goal_of_the_rosbot_is_beyond_its_work_space_as_published():
    assert HUSARION.goal[1] > HUSARION.bounds[3]
    task = begun(HUSARION, 2, goal=(-2.9, 2.5))
    task.robot.set_pose([[-2.88, 2.52, 0.0], [-2.9, 3.1, 0.0]])
    step = task.advance(np.array([1, 1]))
    assert step.reward.tolist() == [200.0, -200.0]
    assert step.terminated.all()
    assert step.info["is_success"].tolist() == [True, False]


def test_bases_on_four_wheels_turn_with_slip_in_both_engines():
    """The published geometry turns by less than it is told; about a tenth, alike in plane and space."""
    turned = []
    for engine in ("planar", "mujoco"):
        task = begun(SUMMIT_XL, 1, engine=engine)
        for _ in range(5):
            task.advance(np.array([1]))
        turned.append(task.robot.planar_pose(None)[0, 2])
    assert 0.22 < turned[0] < 0.3
    assert turned[1] == pytest.approx(turned[0], rel=0.15)
