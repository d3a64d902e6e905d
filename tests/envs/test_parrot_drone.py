"""The flight to a place: the rules of openai_ros' task by hand, its starts, seeds and noise."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from gazelle import assets, formats
from gazelle.envs.goal_rules import distance_to
from gazelle.envs.parrot_drone.places import squares
from gazelle.envs.parrot_drone.rules import FlightRules, ends_of, reward_of
from gazelle.envs.parrot_drone.task import ParrotDroneSettings, ParrotDroneTask
from gazelle.errors import TaskError

ID = "gazelle/ParrotDroneGoto-v0"
RULES = FlightRules()
COARSE = {"time_step": 0.02}  # enough where only rules are looked at


def begun(nworld=1, **options):
    task = ParrotDroneTask(nworld, ParrotDroneSettings(**{**COARSE, **options}))
    task.seed(0)
    task.begin(np.arange(nworld))
    return task


def seen(x=0, y=0, z=1, roll=0.0, pitch=0.0, sonar=5.0):
    return np.array([[x, y, z, roll, pitch, 0.0, sonar]])


def test_gymnasiums_checker_finds_nothing():
    env = gym.make(ID, **COARSE)
    check_env(env.unwrapped, skip_render_check=True)
    env.close()


def test_the_drone_weighs_and_turns_as_published():
    model = formats.load_model(assets.robot("parrot_ardrone"))
    (link,) = model.links
    inertia = link.inertial.inertia
    assert link.inertial.mass == 1.477
    assert (inertia.ixx, inertia.iyy, inertia.izz) == (0.1152, 0.1152, 0.218)
    assert [sensor.name for sensor in link.sensors] == ["sensor_imu", "sensor_sonar"]
    camera = formats.load_model(assets.robot("parrot_ardrone"), xacro_args={"camera": "true"})
    assert [sensor.name for sensor in camera.links[0].sensors][2:] == [
        "front_camera",
        "down_camera",
    ]


@pytest.mark.parametrize(
    ("observed", "over", "success", "crashed"),
    [
        (seen(), False, False, False),
        (seen(9, 4), True, True, False),
        (seen(9, 4, 3), True, True, False),  # the height does not count
        (seen(10, 4), True, False, False),  # near enough for the end, not for the reward
        (seen(9, 5), True, False, False),
        (seen(8, 4), False, False, False),
        (seen(9, 3), False, False, False),
        (seen(-1, 0), True, False, False),
        (seen(0, -1), True, False, False),
        (seen(11, 0), True, False, False),
        (seen(0, 0, 4), True, False, False),
        (seen(0, 0, 3), False, False, False),
        (seen(sonar=0.4), True, False, True),
        (seen(sonar=0.5), False, False, False),
        (seen(roll=1.6), True, False, True),
        (seen(pitch=-1.6), True, False, True),
    ],
)
def test_ends_are_the_published_ones(observed, over, success, crashed):
    ends = ends_of(RULES, observed)
    assert (ends.over[0], ends.succeeded[0], ends.crashed[0]) == (over, success, crashed)
    for closer in (False, True):
        reward = reward_of(
            RULES, over=ends.over, succeeded=ends.succeeded, closer=np.array([closer])
        )[0]
        assert reward == (200.0 if success else -200.0 if over else 10.0 * closer)


def test_the_first_distance_is_the_true_one_and_the_others_are_as_observed():
    task = begun()
    assert task.memory["distance"][0] == pytest.approx(np.linalg.norm([9, 4, 2 - 0.85]))
    step = task.advance(np.array([1]))
    assert step.reward[0] == 0.0
    assert task.memory["distance"][0] == pytest.approx(distance_to(np.zeros((1, 3)), RULES.goal)[0])


def test_actions_are_velocities_along_the_axes():
    task = begun(6)
    for _ in range(2):
        step = task.advance(np.arange(6))
    velocity = task.robot.motion().linear
    directions = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    moving = directions.astype(bool)
    moving[5] = False  # that one is on the ground by now
    np.testing.assert_allclose(velocity[moving], 0.5 * directions[moving], atol=0.15)
    assert step.observation[0, :2].tolist() == [0.0, 0.0]


def test_it_hovers_at_the_origin_when_an_episode_begins():
    task = begun(2)
    assert task.robot.placement().position.tolist() == [[0.0, 0.0, 0.85]] * 2
    observation, info = task.begin(np.array([1]))
    assert observation[0, :6].tolist() == [0.0] * 6
    # The cone of 15 degrees meets the ground.
    assert observation[0, 6] == pytest.approx(1.15 / np.sin(np.arctan(1.33974596 / 5.0)), abs=0.06)
    assert info["distance"][0] == pytest.approx(
        distance_to(np.array([[0, 0, 0.85]]), RULES.goal)[0]
    )


def test_starts_of_training_and_evaluation_are_apart_and_free():
    trained, held_out = squares(held_out=False), squares(held_out=True)
    assert not {tuple(each) for each in trained} & {tuple(each) for each in held_out}
    task = begun(64, starts="held-out")
    start = task.memory["start"]
    near = np.abs(start[:, None] - held_out).max(axis=2)
    assert (near.min(axis=1) <= 0.2 + 1e-12).all()
    step = task.advance(np.zeros(64, np.int64))
    assert not step.terminated.any()
    with pytest.raises(TaskError, match="starts"):
        ParrotDroneSettings(starts="anywhere")


def test_equal_seeds_give_equal_flights_whoever_else_flies():
    actions = np.random.default_rng(0).integers(0, 6, (2, 3))

    def flown(nworld):
        task = begun(nworld, starts="training")
        return np.array([task.step(row[:nworld]).transition.observation[:2] for row in actions])

    first = flown(3)
    np.testing.assert_array_equal(first, flown(3))
    np.testing.assert_array_equal(first, flown(2))


def test_the_state_can_be_put_back():
    task = begun(2)
    task.advance(np.array([0, 4]))
    kept = task.get_state()
    ahead = [task.advance(np.array([2, 0])).observation for _ in range(2)]
    task.set_state(kept)
    again = [task.advance(np.array([2, 0])).observation for _ in range(2)]
    np.testing.assert_array_equal(ahead, again)
