"""The page of a task shows the goals of its episodes."""

import gymnasium as gym
import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

import gazelle.envs  # noqa: F401  # registers the tasks
from gazelle.cli.viewing import simulated
from gazelle.envs.course import CourseTask
from gazelle.envs.single_env import TaskEnv
from gazelle.viewer import LiveView


def made(task, copies, **options):
    env = gym.make_vec(
        f"gazelle/{task}-v0", num_envs=copies, vectorization_mode="vector_entry_point", **options
    )
    env.reset(seed=3)
    return env


def shown(view):
    """Return the places of marks after one picture, shape (n, 3)."""
    view._picture()
    return view._optional["Task goals"]._marks.batched_positions.copy()


def viewed(env, **options):
    owner = simulated(env)
    return LiveView(owner.simulation, goals=lambda: owner.goal_places, **options)


@pytest.mark.long
@pytest.mark.parametrize(
    "task", ["TurtleBot3Stage1", "Husarion", "KobukiEmpty", "WamvBuoys", "ParrotDroneGoto"]
)
def test_goals_that_the_info_tells_are_drawn_in_every_world(task):
    env = made(task, 3)
    _, _, _, _, info = env.step(env.action_space.sample())
    with viewed(env, world=1) as view:
        marks, goals = shown(view), info["goal"][1:]
        size = goals.shape[1]
        assert marks.shape == (2, 3)
        np.testing.assert_allclose(
            marks[:, :size] - view._context.spots[:, :size], goals, atol=1e-5
        )
    env.close()


@pytest.mark.long
@pytest.mark.parametrize("task", ["FetchReach", "ABBIRB120Reach"])
def test_goals_of_arms_are_drawn(task):
    env = made(task, 2)
    with viewed(env) as view:
        marks = shown(view) - view._context.spots
        found = env.unwrapped.task.scenario(np.arange(2))
        goals = found[:, :3] if task.startswith("Fetch") else found[:, -3:]
        np.testing.assert_allclose(marks, goals, atol=1e-5)
    env.close()


@pytest.mark.long
def test_each_vehicle_of_a_hall_has_a_goal_and_a_new_one_moves_the_mark():
    env = made("AGVFleet", 8, agents=4)
    task = env.unwrapped.task
    with viewed(env, world=1) as view:
        marks = shown(view)
        np.testing.assert_allclose(marks[:, :2], task.goals[4:] + view._context.spots[0, :2])
        task._next_goals(np.array([5]))
        env.step(env.action_space.sample())
        changed = np.any(shown(view) != marks, axis=1)
        assert changed.tolist() == [False, True, False, False]
        view._optional["Task goals"].shown = False
        view._picture()
        assert view._optional["Task goals"]._marks is None
    env.close()


@pytest.mark.long
def test_goals_are_found_within_wrappers_and_copies_of_an_environment():
    inner = made("Husarion", 1).unwrapped.task
    wrapped = CourseTask(inner, 5, 6, (1, 2))
    single = TaskEnv(wrapped)
    single.reset(seed=1)

    class Copies:
        envs = (single,)

    owner = simulated(Copies())
    assert owner is inner
    np.testing.assert_allclose(owner.goal_places, wrapped.goal_places)
    assert simulated(object()) is None


def test_a_task_without_goals_has_nothing_to_draw():
    env = made("CartPoleStayUp", 1)
    with viewed(env) as view:
        view._picture()
        assert view._optional["Task goals"]._marks is None
    env.close()
