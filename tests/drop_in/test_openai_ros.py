"""openai_ros by its names: the layers on a graph, and the rules of its tasks."""

from __future__ import annotations

import importlib
from types import SimpleNamespace

import numpy as np
import pytest
from drop_in.cart_graph import cart_graph
from graph import until

import gazelle_ros as ros
from gazelle.clients import Controllers
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import MODULES, WITHOUT_ROBOT
from gazelle.drop_in.shared import background
from gazelle.errors import TaskError
from gazelle_ros.launch.errors import MissingPackageError

CONTROLLERS = [
    "joint_state_controller",
    "foot_joint_velocity_controller",
    "pole_joint_velocity_controller",
]


@pytest.fixture(scope="module")
def cart():
    """Run openai_ros' cart and pole on a graph, and rospy's node in this process."""
    with cart_graph() as graph:
        with Controllers(graph.node, "/cartpole_v0", timeout=60.0) as controllers:
            controllers.spawn(CONTROLLERS)
        yield graph


@pytest.fixture(scope="module")
def env(cart):
    """Return the task by its name, as scripts make it."""
    rewards = []
    info = ros.load_message("openai_ros/RLExperimentInfo")
    cart.node.subscribe("/openai/reward", info, rewards.append)
    cart.node.set_param("/cartpole_v0/max_pole_angle", 0.5)
    common = importlib.import_module("openai_ros.openai_ros_common")
    made = common.StartOpenAI_ROS_Environment("CartPoleStayUp-v0")
    return SimpleNamespace(env=made, rewards=rewards, cart=cart, unwrapped=made.unwrapped)


def test_modules_have_the_names_that_scripts_import():
    with ros.install():
        for name in (
            "robot_gazebo_env",
            "robot_gazebo_env_goal",
            "gazebo_connection",
            "controllers_connection",
            "openai_ros_common",
            "task_envs.task_commons",
            "task_envs.task_envs_list",
            *(f"robot_envs.{each}_env" for each in ("cartpole", "turtlebot2", "turtlebot3")),
        ):
            assert importlib.import_module(f"openai_ros.{name}").__doc__
        for module, kind in MODULES.values():
            assert hasattr(importlib.import_module(f"openai_ros.task_envs.{module}"), kind)
        message = importlib.import_module("openai_ros.msg").RLExperimentInfo
        assert importlib.import_module("openai_ros").msg.RLExperimentInfo is message
        assert message._md5sum == "117729220546455cc216a7df0b6e91d0"
        base = importlib.import_module("openai_ros").robot_gazebo_env.RobotGazeboEnv
        assert issubclass(base, importlib.import_module("gym").Env)


@pytest.mark.long
def test_an_episode_goes_to_its_end(env):
    observation = env.env.reset()
    assert observation.shape == (4,)
    assert env.env.observation_space.contains(observation.astype(np.float32))
    # The pole is pushed one way until it falls.
    steps = []
    while not steps or not steps[-1][2]:
        assert len(steps) < 200
        steps.append(env.env.step(1))
    assert all(reward == 1.0 and info == {} for _, reward, _, info in steps)
    place, _, angle, _ = steps[-1][0]
    assert abs(place) > 1.0 or abs(angle) > 0.5
    beyond = [env.env.step(1)[1] for _ in range(2)]
    assert beyond == [0.0, 0.0]


def test_a_step_takes_its_time_in_the_simulation(env):
    env.env.reset()
    before = env.cart.sim.time
    for action in (0, 1, 0, 1):
        env.env.step(action)
    assert env.cart.sim.time - before >= 4 * 0.04 - 0.005
    still = env.cart.sim.time
    env.cart.rospy.get_param("/use_sim_time")
    assert env.cart.sim.paused
    assert env.cart.sim.time == still


def test_rewards_are_published_by_episode(env):
    env.env.reset()
    number = env.unwrapped.episode_num
    total = sum(env.env.step(0)[1] for _ in range(3))
    env.env.reset()
    # Those of earlier episodes may still be on their way.
    until(lambda: any(each.episode_number == number for each in env.rewards))
    (info,) = (each for each in env.rewards if each.episode_number == number)
    assert info.episode_reward == total
    assert env.unwrapped.episode_num == number + 1
    assert env.unwrapped.cumulated_episode_reward == 0.0


def test_parameters_that_are_set_stay_and_others_are_filled_in(env):
    assert env.unwrapped.max_pole_angle == 0.5
    assert env.cart.node.get_param("/cartpole_v0/min_pole_angle") == -0.7
    assert env.env.action_space.n == 2


def test_physics_is_that_of_openai_ros(env):
    physics = env.unwrapped.gazebo._gazebo.physics
    assert (physics.time_step, physics.max_update_rate) == (0.001, 1000.0)
    assert physics.gravity == (0.0, 0.0, -9.81)
    env.unwrapped.gazebo.change_gravity(0.0, 0.0, -1.6)
    assert env.cart.sim.physics.gravity[2] == pytest.approx(-1.6)
    env.unwrapped.gazebo.init_physics_parameters()
    assert env.cart.sim.physics.gravity[2] == pytest.approx(-9.81)


def test_a_world_that_runs_as_fast_as_possible_goes_on_doing_so(env):
    env.unwrapped.gazebo._gazebo.set_physics(max_update_rate=0.0)
    env.unwrapped.gazebo.init_physics_parameters()
    assert env.unwrapped.gazebo._gazebo.physics.max_update_rate == 0.0
    env.unwrapped.gazebo._gazebo.set_physics(max_update_rate=1000.0)


@pytest.mark.parametrize("mode", ["SIMULATION", "WORLD", "NO_RESET_SIM"])
def test_kinds_of_reset(env, mode):
    connection = importlib.import_module("openai_ros.gazebo_connection")
    sim, foot = env.cart.sim, env.cart.sim.robots["cartpole_v0"].joints["foot_joint"]
    env.unwrapped.gazebo.unpauseSim()
    until(lambda: sim.time > 0.0)
    gazebo = connection.GazeboConnection(
        start_init_physics_parameters=False, reset_world_or_sim=mode
    )
    assert sim.paused
    foot.set_position(0.4)
    before = sim.time
    gazebo.resetSim()
    assert foot.position == pytest.approx(0.4 if mode == "NO_RESET_SIM" else 0.0)
    assert sim.time == (0.0 if mode == "SIMULATION" else before)


def test_a_kind_of_reset_that_is_none_is_said(env):
    connection = importlib.import_module("openai_ros.gazebo_connection")
    with pytest.raises(TaskError, match="did you mean 'WORLD'"):
        connection.GazeboConnection(reset_world_or_sim="WORDL")


def test_controllers_are_switched_and_reset(env):
    env.unwrapped.gazebo.unpauseSim()
    controllers = env.unwrapped.controllers_object
    foot = "foot_joint_velocity_controller"
    assert controllers.switch_service_name == "/cartpole_v0/controller_manager/switch_controller"
    with Controllers(env.cart.node, "/cartpole_v0") as manager:
        assert controllers.switch_controllers([], [foot])
        assert manager.states()[foot] == "stopped"
        assert controllers.reset_controllers()
        assert set(manager.states().values()) == {"running"}
        assert not controllers.switch_controllers([foot, "no_controller"], [], strictness=2)
    known = controllers.controllers_list
    controllers.update_controllers_list([foot])
    assert controllers.controllers_list == [foot]
    controllers.update_controllers_list(known)
    env.unwrapped.gazebo.pauseSim()


def test_a_silent_topic_is_named(env, monkeypatch):
    topics = importlib.import_module("openai_ros.robot_envs.topic_robot_env")
    monkeypatch.setattr(topics, "PATIENCE_S", 0.05)
    robot = env.unwrapped
    monkeypatch.setattr(
        robot, "sensors", [topics.RobotTopic("scan", "/cartpole_v0/joint_stats", "a/B")]
    )
    robot._received["scan"] = 0
    with pytest.raises(TaskError, match=r"it has no publisher.*joint_states"):
        robot._check_all_sensors_ready()
    monkeypatch.setattr(
        robot, "sensors", [topics.RobotTopic("joints", "/cartpole_v0/joint_states", "a/B")]
    )
    robot.gazebo.pauseSim()

    def hear_for_ever():  # what was on its way when the world was paused may still come
        while True:
            robot._check_all_sensors_ready()

    with pytest.raises(TaskError, match="does time go on"):
        hear_for_ever()


def recording(base):
    """Return a user's robot environment that records its calls."""

    class Noted(base):
        def __init__(self, **options):
            self.calls = []
            super().__init__(**options)

        def _check_all_systems_ready(self):
            self.calls.append("check")

        def _set_init_pose(self):
            self.calls.append("pose")

        def _init_env_variables(self):
            self.calls.append("variables")

        def _set_action(self, action):
            self.calls.append(f"act {action}")

        def _get_obs(self):
            self.calls.append("see")
            return 7

        def _is_done(self, observations):
            self.calls.append(f"done {observations}")
            return False

        def _compute_reward(self, observations, done):
            self.calls.append(f"reward {observations} {done}")
            return 2.5

    return Noted


@pytest.mark.parametrize("module", ["robot_gazebo_env", "robot_gazebo_env_goal"])
def test_methods_are_called_in_their_order(cart, module):
    base = importlib.import_module(f"openai_ros.{module}").RobotGazeboEnv
    env = recording(base)(robot_name_space="", controllers_list=None, reset_controls=False)
    assert env.reset() == 7
    assert env.calls == ["check", "pose", "check", "variables", "see"]
    del env.calls[:]
    assert env.step(1) == (7, 2.5, False, {})
    assert env.calls == ["act 1", "see", "done 7", "reward 7 False"]
    assert cart.sim.paused == (module == "robot_gazebo_env")
    assert env.episode_num == 1
    assert env.seed(4) == [4]


def test_what_is_missing_is_named_and_where_it_is_from(cart, tmp_path):
    common = importlib.import_module("openai_ros.openai_ros_common")
    with pytest.raises(MissingPackageError, match=r"no package 'sawyer_gazebo'.*sawyer_full"):
        common.ROSLauncher("sawyer_gazebo", "start_world.launch", str(tmp_path))
    (tmp_path / "src" / "my_own_robot" / "launch").mkdir(parents=True)
    (tmp_path / "src" / "my_own_robot" / "package.xml").write_text(
        "<package><name>my_own_robot</name></package>"
    )
    (tmp_path / "src" / "my_own_robot" / "launch" / "put.launch").write_text(
        '<launch><param name="put_there" value="5"/></launch>'
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_PACKAGE_PATH", "")
        common.ROSLauncher("my_own_robot", "put.launch", str(tmp_path))
    assert cart.node.get_param("/put_there") == 5
    background.stop_all()


def test_tasks_that_are_not_here_are_said(cart):
    listed = importlib.import_module("openai_ros.task_envs.task_envs_list")
    assert [listed.RegisterOpenAI_Ros_Env(name) for name in WITHOUT_ROBOT] == [False] * len(
        WITHOUT_ROBOT
    )
    assert not listed.RegisterOpenAI_Ros_Env("CartPoleStayUpp-v0")
    assert listed.RegisterOpenAI_Ros_Env("HopperStayUp-v0", max_episode_steps=7)
    registration = importlib.import_module("gym.envs.registration")
    assert registration.spec("HopperStayUp-v0").max_episode_steps == 7


def test_parameters_of_a_file_are_set(cart, tmp_path, monkeypatch):
    (tmp_path / "pkg" / "cfg").mkdir(parents=True)
    (tmp_path / "pkg" / "package.xml").write_text("<package><name>pkg</name></package>")
    (tmp_path / "pkg" / "cfg" / "a.yaml").write_text("robot: {speed: 2.0, arms: [1, 2]}\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    commons = importlib.import_module("openai_ros.task_envs.task_commons")
    commons.LoadYamlFileParamsTest("pkg", "cfg", "a.yaml")
    assert cart.node.get_param("/robot") == {"speed": 2.0, "arms": [1, 2]}
