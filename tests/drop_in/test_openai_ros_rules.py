"""Rules of openai_ros' tasks: on a graph, natively, and in the published code they are the same."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from drop_in import published_rules as published
from drop_in.parameters import on_a_graph
from hypothesis import assume, given
from hypothesis import strategies as st

from gazelle.drop_in.openai_ros.task_envs.geometry import point
from gazelle.envs.cartpole.task import CartPoleTask
from gazelle.envs.discrete_drive import rules as drive_rules
from gazelle.envs.discrete_drive.task import DriveSettings, DriveTask
from gazelle.envs.hopper.task import HopperTask
from gazelle.envs.moving_cube.task import MovingCubeSettings, MovingCubeTask
from gazelle.envs.options import TaskSettings
from gazelle.envs.parrot_drone.task import ParrotDroneSettings, ParrotDroneTask
from gazelle.envs.wamv.task import WamvSettings, WamvTask
from gazelle_ros.transformations import quaternion_from_euler

NAMES = {
    "maze": "MyTurtleBot2Maze-v0",
    "wall": "MyTurtleBot2Wall-v0",
    "turtlebot3": "TurtleBot3World-v0",
    "husarion": "HusarionGetToPosTurtleBotPlayGround-v0",
    "summit": "SumitXlRoom-v0",
    "drone": "ParrotDroneGoto-v0",
    "wamv": "WamvNavTwoSetsBuoys-v0",
    "cube": "MovingCubeOneDiskWalk-v0",
    "cartpole": "CartPoleStayUp-v0",
    "hopper": "HopperStayUp-v0",
}
DRIVES = {
    "maze": drive_rules.MAZE,
    "wall": drive_rules.WALL,
    "turtlebot3": drive_rules.TURTLEBOT3_WORLD,
    "husarion": drive_rules.HUSARION,
    "summit": drive_rules.SUMMIT_XL,
}


@pytest.fixture(scope="module")
def env(request):
    return on_a_graph(NAMES[request.param])


def for_tasks(*names):
    return pytest.mark.parametrize(
        ("env", "name"), [(each, each) for each in names], indirect=["env"]
    )


def odometry(x, y, yaw=0.0):
    orientation = SimpleNamespace(
        **dict(zip("xyzw", quaternion_from_euler(0.0, 0.0, yaw), strict=True))
    )
    pose = SimpleNamespace(position=point(x, y), orientation=orientation)
    return SimpleNamespace(pose=SimpleNamespace(pose=pose))


def hundredths(low, high):
    return st.integers(round(100 * low), round(100 * high)).map(lambda each: each / 100)


lengths = st.sampled_from((math.inf, -math.inf, math.nan, 0.0, 0.2, 0.35, 0.5, -0.1)) | hundredths(
    0, 8
)
goals = {"wall": (5.0, 0.0), "summit": (-2.94, 3.92), "husarion": (-2.9, 3.9)}
at_goals = st.tuples(
    st.sampled_from(list(goals.values())), *[st.sampled_from((-0.1, -0.05, 0.0, 0.05, 0.1))] * 2
).map(lambda each: (round(each[0][0] + each[1], 2), round(each[0][1] + each[2], 2)))


@for_tasks(*DRIVES)
@given(
    st.lists(lengths, min_size=10, max_size=11),
    st.tuples(hundredths(-8, 7), hundredths(-6, 5)) | at_goals,
    st.tuples(hundredths(-8, 7), hundredths(-6, 5)),
    st.integers(0, 2),
    st.sampled_from((9.8, 20.0, 20.1, 50.1)),
)
def test_driving_on_a_graph_goes_by_the_published_code(
    env, name, ranges, place, before, action, acceleration
):
    env.new_ranges = 2 if name == "maze" else 5
    env.laser_scan = SimpleNamespace(ranges=ranges, range_min=0.1, range_max=6.0)
    env.odom = odometry(*place)
    env.imu = SimpleNamespace(linear_acceleration=SimpleNamespace(x=0.0, y=acceleration, z=0.0))
    env.last_action = ("FORWARDS", "TURN_LEFT", "TURN_RIGHT")[action]
    digits = 1 if name == "husarion" else 2
    x, y = (round(side, digits) for side in place)
    closer = False
    if name in goals:
        left = published.far((x, y, 0.0), (*goals[name], 0.0))
        was = published.far((*before, 0.0), (*goals[name], 0.0))
        assume(abs(left - was) > 1e-9)  # the last bits are those of a machine's library
        closer, env.previous_distance_from_des_point = left < was, was
    wanted = published.drive(name, ranges, 2, x, y, action, closer, acceleration)
    seen = env._get_obs()
    count = len(wanted[0])
    assert seen[:count] == wanted[0]
    assert [type(each) for each in seen[:count]] == [type(each) for each in wanted[0]]
    done = env._is_done(seen)
    assert (done, env._compute_reward(seen, done)) == wanted[1:]


tenths = st.integers(-40, 360).map(lambda each: each / 10)
metres = st.integers(-2, 11)
tilts = st.sampled_from((-1.6, -1.5, 0.0, 1.5, 1.6))


@for_tasks("drone")
@given(metres, metres, st.integers(-2, 4), tilts, tilts, st.integers(0, 50), st.booleans())
def test_the_drone_goes_by_the_published_code(env, name, x, y, z, roll, pitch, sonar, closer):
    seen = [x, y, z, roll, pitch, 0.0, sonar / 10]
    left = published.far(seen[:3], (9.0, 4.0, 2.0))
    env.previous_distance_from_des_point = left + (0.1 if closer else -0.1)
    done = env._is_done(seen)
    assert (done, env._compute_reward(seen, done)) == published.drone(seen, closer)
    assert env.previous_distance_from_des_point == pytest.approx(left)
    assert env.is_inside_workspace(point(x, y, z)) == (-1 < x <= 10 and -1 < y <= 5 and -1 < z <= 3)
    assert env.drone_has_flipped(point(roll, pitch)) == (max(abs(roll), abs(pitch)) > 1.57)


@for_tasks("wamv")
@given(tenths, tenths | st.integers(-60, 60).map(lambda each: each / 10), st.booleans())
def test_the_vessel_goes_by_the_published_code(env, name, x, y, closer):
    left = published.far((x, y, 0.0), (30.0, 0.0, 1.0))
    env.previous_distance_from_des_point = left + (0.1 if closer else -0.1)
    seen = [x, y, *[0.0] * 7]
    done = env._is_done(seen)
    assert (done, env._compute_reward(seen, done)) == published.wamv(seen, closer)


small = st.integers(-40, 40).map(lambda each: each / 100)


@for_tasks("cube")
@given(st.tuples(*[st.integers(-9, 9).map(lambda each: each / 10)] * 6), small)
def test_the_cube_goes_by_the_published_code(env, name, seen, before):
    env.current_y_distance = before
    done = env._is_done(list(seen))
    assert (done, env._compute_reward(list(seen), done)) == published.cube(seen, before)
    assert env.current_y_distance == (before if done else seen[1])


@for_tasks("cartpole")
@given(
    st.sampled_from((-1.0, -0.7, 0.7, 1.0, math.nan)) | small, st.sampled_from((-0.7, 0.7)) | small
)
def test_the_pole_goes_by_the_published_code(env, name, place, angle):
    env._init_env_variables()
    seen = np.array([place, 0.0, angle, 0.0])
    done = env._is_done(seen)
    assert done == published.cartpole(seen)
    assert env._compute_reward(seen, done) == 1.0


@for_tasks("hopper")
@given(
    st.tuples(*[st.integers(-20, 35).map(lambda each: each / 10)] * 11),
    st.floats(-1.6, 1.6),
    st.floats(-1.5, 1.5),
)
def test_the_leg_goes_by_the_published_code(env, name, seen, roll, pitch):
    turned = quaternion_from_euler(roll, pitch, 0.0)
    env.imu = SimpleNamespace(orientation=SimpleNamespace(**dict(zip("xyzw", turned, strict=True))))
    rpy = env.get_base_rpy()
    done, reward = published.hopper(seen, rpy.x, rpy.y)
    assert env._is_done(list(seen)) == done
    assert env._compute_reward(list(seen), done) == pytest.approx(reward, abs=1e-12)


def test_the_leg_sees_no_force_and_no_distance_as_published():
    env = on_a_graph(NAMES["hopper"])
    env.odom = odometry(0.5, 0.0)
    env.imu = SimpleNamespace(orientation=SimpleNamespace(x=0.0, y=0.0, z=0.0, w=1.0))
    force = point(3.0, 0.0, 0.0)
    state = SimpleNamespace(total_wrench=SimpleNamespace(force=force))
    env.lowerleg_contactsensor_state = SimpleNamespace(states=[state])
    env.joint_states = SimpleNamespace(position=[0.1, 0.2, -0.3])
    assert env._get_obs() == [0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, -0.3, 0.5, 0.0, 0.0]
    assert env.contact_force is force


# -- and natively ----------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("name", DRIVES)
def test_driving_natively_is_scored_as_on_a_graph(name):
    """The same ranges and places give the same observations, rewards and ends."""
    task = DriveTask(DRIVES[name], 24, DriveSettings(engine="planar", starts="training"))
    task.seed(0)
    task.begin(np.arange(24))
    env, rays = on_a_graph(NAMES[name]), task.lidar.lidar.horizontal.samples
    env.new_ranges = 1 if name == "maze" else rays
    env.imu = SimpleNamespace(linear_acceleration=SimpleNamespace(x=0.0, y=0.0, z=9.8))
    rng, ended = np.random.default_rng(1), 0
    for _ in range(20):
        before, actions = task.memory["distance"].copy(), rng.choice(3, 24, p=(0.8, 0.1, 0.1))
        step = task.advance(actions)
        for world, (x, y, yaw) in enumerate(task.robot.planar_pose(None)):
            env.laser_scan = SimpleNamespace(ranges=task.scan[world], range_min=0.0, range_max=6.0)
            env.odom, env.last_action = odometry(x, y, yaw), ("FORWARDS", "", "")[actions[world]]
            env.previous_distance_from_des_point = before[world]
            seen = env._get_obs()
            assert np.abs(np.array(seen) - step.observation[world]).max() < 1e-5
            done = env._is_done(seen)
            reward = env._compute_reward(seen, done)
            assert (done, reward) == (step.terminated[world], step.reward[world])
        over = np.flatnonzero(step.terminated)
        ended += len(over)
        if len(over):
            task.begin(over)
    assert ended > 0


COARSE = {"time_step": 0.02}
NATIVE = {
    "drone": lambda: ParrotDroneTask(6, ParrotDroneSettings(starts="training", **COARSE)),
    "wamv": lambda: WamvTask(6, WamvSettings(starts="training", **COARSE)),
    "cube": lambda: MovingCubeTask(6, MovingCubeSettings()),
    "cartpole": lambda: CartPoleTask(6, TaskSettings()),
    "hopper": lambda: HopperTask(6, TaskSettings()),
}


@pytest.mark.long
@pytest.mark.parametrize("name", NATIVE)
def test_other_tasks_are_scored_natively_as_on_a_graph(name):
    task, env = NATIVE[name](), on_a_graph(NAMES[name])
    task.seed(0)
    task.begin(np.arange(6))
    rng, ended = np.random.default_rng(2), 0
    for _ in range(15 if task.control_period == 1.0 else 60):
        before = {key: value.copy() for key, value in task.memory.items()}
        step = task.advance(rng.choice(task.action_space.n, 6))
        for world in range(6):
            seen = step.observation[world].astype(float)
            seen = (seen if name == "cartpole" else seen.round(1)).tolist()
            env.steps_beyond_done = None
            env.previous_distance_from_des_point = before.get("distance", np.zeros(6))[world]
            env.current_y_distance = before.get("place", np.zeros(6))[world]
            if name == "hopper":
                turned = task.robot.placement().quaternion[world]
                env.imu = SimpleNamespace(
                    orientation=SimpleNamespace(**dict(zip("xyzw", turned, strict=True)))
                )
            done = env._is_done(seen)
            reward = env._compute_reward(seen, done)
            assert done == step.terminated[world]
            assert reward == pytest.approx(step.reward[world], abs=1e-9)
        over = np.flatnonzero(step.terminated)
        ended += len(over)
        if len(over):
            task.begin(over)
    assert ended > 0 or name in ("cube", "drone", "wamv")
    task.close()
