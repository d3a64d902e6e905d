"""frobs_rl's tasks for Kobuki: what is seen, paid and ended, by its rules."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import gazelle.envs
from gazelle.envs.kobuki_maze.rules import BOX_STEP, DYNAMIC_1, DYNAMIC_2, EMPTY, MAZE
from gazelle.envs.kobuki_maze.task import KobukiTask
from gazelle.envs.options import TaskSettings

NAMES = ("KobukiEmpty", "KobukiMaze", "KobukiDynamic1", "KobukiDynamic2", "KobukiDynamic3")


def vector(name, count, **options):
    options = {"engine": "planar", **options}
    return gym.make_vec(
        f"gazelle/{name}-v0", num_envs=count, vectorization_mode="vector_entry_point", **options
    )


def begun(rules, nworld=1, **options):
    task = KobukiTask(rules, nworld, TaskSettings(**{"engine": "planar", **options}))
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


@pytest.mark.parametrize("name", NAMES)
def test_gymnasiums_checker_finds_nothing(name):
    env = gym.make(f"gazelle/{name}-v0", engine="planar")
    check_env(env.unwrapped, skip_render_check=True)
    assert env.unwrapped.contract.size == env.observation_space.shape[0]
    env.close()


def test_the_maze_can_be_rendered_in_space():
    env = gym.make("gazelle/KobukiMaze-v0", render_mode="rgb_array")
    env.reset(seed=0)
    assert env.render().shape == (400, 480, 3)
    env.close()


def test_every_point_of_every_way_is_free_and_can_be_driven_to():
    """Nothing of the maze is within the goal's tolerance, but where a box stands at first."""
    task = begun(MAZE, 4)
    for way in MAZE.paths():
        for point in way:
            task.robot.set_pose([*point, 0.0])
            ranges = task.robot.sensors["laser"].measure(None)[0]
            assert ranges.min() > 0.45


def test_the_reward_is_less_for_distance_heading_and_points_left():
    for rules, seed in ((MAZE, 1), (DYNAMIC_1, 2), (DYNAMIC_2, 3), (EMPTY, 4)):
        task = begun(rules, 8)
        rng = np.random.default_rng(seed)
        for _ in range(10):
            goal = task.memory["goal"].copy()
            step = task.advance(rng.uniform(-1, 1, (8, 2)))
            x, y, yaw = task.robot.planar_pose(None).T
            distance = np.hypot(goal[:, 0] - x, goal[:, 1] - y)
            angle = np.abs(
                (np.arctan2(goal[:, 1] - y, goal[:, 0] - x) - yaw + np.pi) % (2 * np.pi) - np.pi
            )
            wanted = -rules.distance_weight * distance
            wanted -= rules.heading_weight * np.minimum(angle, np.pi - angle)
            wanted -= rules.remaining_weight * 7
            np.testing.assert_allclose(step.observation[:, 0], distance, atol=1e-4)
            np.testing.assert_allclose(step.reward, wanted, atol=1e-3)


def test_a_way_is_gone_point_by_point_and_its_end_is_the_success():
    task = begun(MAZE, 1)
    way = MAZE.paths()[task.memory["way"][0]]
    for number, point in enumerate(way):
        np.testing.assert_array_equal(task.memory["goal"][0], point)
        task.robot.set_pose([*point, 0.0])
        step = task.advance(np.zeros((1, 2)))
        last = number == len(way) - 1
        assert step.reward[0] == 10.0
        assert bool(step.terminated[0]) == bool(step.info["is_success"][0]) == last


def test_collisions_cost_and_do_not_end():
    task = begun(MAZE, 1)
    # The outer wall on the left, its face at x = -9.92, with the base at 0.2 m from it.
    task.robot.set_pose([-9.72, 7.5, 0.0], yaw=np.pi / 2)
    step = task.advance(np.zeros((1, 2)))
    assert step.info["is_collision"][0]
    assert step.info["collisions"][0] == 1
    assert not step.terminated[0]
    assert step.reward[0] < -200.0


def test_boxes_go_to_and_fro_along_their_heading():
    task = begun(MAZE, 3)
    boxes = [task.simulation.robots[f"box{n}"] for n in (1, 2)]
    home = np.array(MAZE.boxes)
    pace, heading = task.memory["box_pace"].copy(), task.memory["box_heading"].copy()
    assert (pace >= 0.0).all()
    assert (pace <= BOX_STEP).all()
    for count in range(1, 330):
        task.advance(np.zeros((3, 2)))
        if count <= 100:
            way = count
        elif count <= 301:
            way = 100 - (count - 100)
        else:
            way = -101 + (count - 301)
        for number, box in enumerate(boxes):
            pose = box.planar_pose(None)
            gone = way * pace[:, number]
            wanted = home[number] + np.stack(
                [gone * np.cos(heading[:, number]), gone * np.sin(heading[:, number])], 1
            )
            np.testing.assert_allclose(pose[:, :2], wanted, atol=1e-6)


def test_starts_and_goals_are_drawn_within_their_corners_and_differ():
    task = begun(EMPTY, 200)
    scenario = task.scenario(np.arange(200))
    assert len(np.unique(scenario, axis=0)) == 200
    low, high = np.array([-5.3, -7.0, -np.pi, -6.0, -8.0]), np.array([25.0, 6.3, np.pi, 26.0, 7.0])
    assert (scenario[:, :5] >= low).all()
    assert (scenario[:, :5] <= high).all()
    assert np.ptp(scenario[:, :5], axis=0) == pytest.approx(high - low, rel=0.1)
    np.testing.assert_allclose(task.robot.planar_pose(None), scenario[:, :3], atol=1e-6)


def test_worlds_do_not_know_of_others_and_states_go_on():
    many, one, other = (vector("KobukiMaze", count) for count in (3, 1, 3))
    np.testing.assert_array_equal(many.reset(seed=9)[0][:1], one.reset(seed=9)[0])
    actions = np.random.default_rng(0).uniform(-1, 1, (40, 3, 2))
    for row in actions[:20]:
        np.testing.assert_array_equal(many.step(row)[0][:1], one.step(row[:1])[0])
    other.reset(seed=1)
    other.unwrapped.set_state(many.unwrapped.get_state())
    for row in actions[20:]:
        np.testing.assert_array_equal(many.step(row)[0], other.step(row)[0])
    for env in (many, one, other):
        env.close()


def test_an_option_that_is_not_there_is_refused():
    with pytest.raises(gazelle.TaskError, match="there is no option 'starts'"):
        vector("KobukiMaze", 1, starts="training")
