"""frobs_rl by its names: helpers, the environment, wrappers and models, on a graph."""

from __future__ import annotations

import importlib
import math

import gymnasium
import numpy as np
import pytest
from drop_in.cart_graph import cart_graph
from graph import until
from gymnasium import spaces

import gazelle_ros as ros
from gazelle.drop_in import gym
from gazelle.drop_in.frobs_rl.common import (
    connection,
    ros_controllers,
    ros_gazebo,
    ros_launch,
    ros_node,
    ros_params,
    ros_spawn,
    ros_urdf,
)
from gazelle.drop_in.frobs_rl.envs.robot_BasicEnv import RobotBasicEnv
from gazelle.drop_in.frobs_rl.models.ppo import PPO
from gazelle.drop_in.frobs_rl.models.utils import get_action_noise, get_policy_kwargs
from gazelle.drop_in.frobs_rl.wrappers.modern import modern
from gazelle.drop_in.frobs_rl.wrappers.NormalizeActionWrapper import NormalizeActionWrapper
from gazelle.drop_in.frobs_rl.wrappers.NormalizeObservWrapper import NormalizeObservWrapper
from gazelle.drop_in.frobs_rl.wrappers.TimeLimitWrapper import TimeLimitWrapper
from gazelle.errors import TaskError

SPACE = "/cartpole_v0"
FOOT, POLE = (f"{name}_joint_effort_controller" for name in ("foot", "pole"))
BOX = "<sdf version='1.6'><model name='b'><link name='l'><inertial><mass>1</mass></inertial></link></model></sdf>"


@pytest.fixture(scope="module")
def cart():
    with cart_graph() as graph:
        connection.gazebo().unpause()
        assert ros_controllers.spawn_controllers_srv(["joint_state_controller", FOOT], ns=SPACE)
        yield graph


class Cart(RobotBasicEnv):
    """Push the cart; one step is ten of the physics."""

    def __init__(self, **options):
        self.action_space = spaces.Box(-20.0, 20.0, (1,), np.float32)
        self.observation_space = spaces.Box(-5.0, 5.0, (2,), np.float32)
        super().__init__(namespace=SPACE, **{"step_mode": 2, "num_gazebo_steps": 10, **options})
        rospy = importlib.import_module("rospy")
        number = importlib.import_module("std_msgs.msg").Float64
        state = importlib.import_module("sensor_msgs.msg").JointState
        self.seen, self.steps, self.number = None, 0, number
        self.effort = rospy.Publisher(f"{SPACE}/{FOOT}/command", number, queue_size=1)
        rospy.Subscriber(f"{SPACE}/joint_states", state, self.see)

    def see(self, message):
        self.seen = message

    def _check_subs_and_pubs_connection(self):
        self.seen = None
        until(lambda: self.seen is not None)

    def _set_episode_init_params(self):
        self.steps = 0

    def _send_action(self, action):
        self.effort.publish(self.number(float(action[0])))
        self.steps += 1

    def _get_observation(self):
        place = self.seen.name.index("foot_joint")
        pair = [self.seen.position[place], self.seen.velocity[place]]
        return np.clip(np.array(pair, np.float32), -5.0, 5.0)

    def _get_reward(self):
        return 1.0

    def _check_if_done(self):
        self.info["is_success"] = 1.0
        return self.steps >= 20


def test_modules_have_the_names_that_scripts_import():
    with ros.install():
        for name in (
            *(f"common.ros_{each}" for each in ("gazebo", "controllers", "launch", "node")),
            *(f"common.ros_{each}" for each in ("params", "urdf", "spawn")),
            "envs.robot_BasicEnv",
            "models.utils",
            "templates.CustomRobotEnv",
            "templates.CustomTaskEnv",
        ):
            assert importlib.import_module(f"frobs_rl.{name}").__doc__
        for name in ("A2C", "DDPG", "DQN", "PPO", "SAC", "TD3"):
            assert hasattr(importlib.import_module(f"frobs_rl.models.{name.lower()}"), name)
        for name in ("NormalizeActionWrapper", "NormalizeObservWrapper", "TimeLimitWrapper"):
            assert hasattr(importlib.import_module(f"frobs_rl.wrappers.{name}"), name)


# -- helpers -----------------------------------------------------------------------------------


def test_time_is_stepped_exactly(cart):
    assert ros_gazebo.gazebo_pause_physics()
    before = cart.sim.time
    assert ros_gazebo.gazebo_step_physics(steps=7)
    assert cart.sim.time - before == pytest.approx(7 * ros_gazebo.gazebo_get_time_step())
    assert ros_gazebo.gazebo_unpause_physics()
    until(lambda: cart.sim.time > before + 0.05)
    assert not ros_gazebo.gazebo_step_physics(3)  # time goes on


def test_the_world_is_put_back(cart):
    foot = cart.sim.robots[SPACE.strip("/")].joints["foot_joint"]
    for reset, back in (
        (ros_gazebo.gazebo_reset_world, False),
        (ros_gazebo.gazebo_reset_sim, True),
    ):
        ros_gazebo.gazebo_pause_physics()
        ros_gazebo.gazebo_step_physics(10)
        foot.set_position(0.3)
        assert reset(retries=2)
        assert foot.position == pytest.approx(0.0)
        assert (cart.sim.time == 0.0) == back
    ros_gazebo.gazebo_unpause_physics()


def test_physics_is_set_and_read(cart):
    assert ros_gazebo.gazebo_set_max_update_rate(2.0)
    assert ros_gazebo.gazebo_get_max_update_rate() == pytest.approx(2.0 / 0.001)
    assert ros_gazebo.gazebo_set_time_step(0.002)
    assert ros_gazebo.gazebo_get_time_step() == 0.002
    assert ros_gazebo.gazebo_get_max_update_rate() == pytest.approx(2.0 / 0.002)
    assert ros_gazebo.gazebo_set_gravity(0.0, 0.0, -3.7)
    assert ros_gazebo.gazebo_get_gravity().z == -3.7
    assert ros_gazebo.gazebo_set_ODE_physics(False, 0, 77, 1.3, 0.0, 0.001, 100.0, 0.0, 0.2, 20)
    assert ros_gazebo.gazebo_get_ODE_physics().sor_pgs_iters == 77
    assert ros_gazebo.gazebo_set_default_properties()
    assert ros_gazebo.gazebo_get_time_step() == 0.001
    assert ros_gazebo.gazebo_get_gravity().z == -9.8


def test_models_come_and_go(cart, tmp_path):
    half = math.sqrt(0.5)
    file = tmp_path / "b.sdf"
    file.write_text(BOX)
    assert ros_gazebo.gazebo_spawn_sdf_path(
        str(file), model_name="one", pos_x=3.0, ori_z=half, ori_w=half
    )
    assert ros_gazebo.gazebo_spawn_sdf_string(BOX, "two", "/", "world", 5.0, 1.0)
    cart.rospy.set_param("/box", BOX)
    assert ros_gazebo.gazebo_spawn_sdf_param("/box", "three", pos_y=9.0)
    header, pose, _, success = ros_gazebo.gazebo_get_model_state("one")
    assert success
    assert header.frame_id == "world"
    assert (pose.position.x, pose.orientation.z) == (pytest.approx(3.0), pytest.approx(half))
    assert ros_gazebo.gazebo_get_model_state("two")[1].position.y == pytest.approx(1.0)
    ros_gazebo.gazebo_pause_physics()
    assert ros_gazebo.gazebo_set_model_state("two", pos_x=7.0, lin_vel_x=0.5, sleep_time=0.0)
    _, pose, twist, _ = ros_gazebo.gazebo_get_model_state("two")
    assert (pose.position.x, twist.linear.x) == (pytest.approx(7.0), pytest.approx(0.5))
    ros_gazebo.gazebo_unpause_physics()
    for name in ("one", "two", "three"):
        assert ros_gazebo.gazebo_delete_model(name)
    assert not ros_gazebo.gazebo_delete_model("one")
    assert ros_gazebo.gazebo_get_model_state("one")[3] is False


def test_robots_are_spawned_from_all_that_describes_them(cart):
    urdf = ros_urdf.urdf_parse_from_pkg("cartpole_description", "cartpole.urdf.xacro")
    assert "foot_joint" in urdf
    assert ros_urdf.urdf_parse_from_pkg("cartpole_description", "nothing.urdf") is None
    report = ros_gazebo.gazebo_spawn_urdf_string(urdf, model_name="c1", pos_x=2.0)
    success, message = report
    assert report
    assert success
    assert "Success" in message
    again = ros_gazebo.gazebo_spawn_urdf_string(urdf, model_name="c1")
    assert not again
    assert "already" in again.status_message
    package = ("cartpole_description", "cartpole.urdf.xacro")
    assert ros_gazebo.gazebo_spawn_urdf_pkg(*package, model_name="c2", pos_x=4.0)
    assert ros_urdf.urdf_load_from_pkg(*package, "robot_description", ns="/c3")
    assert ros_gazebo.gazebo_spawn_urdf_param("/c3/robot_description", "c3", pos_x=6.0)
    assert not ros_gazebo.gazebo_spawn_urdf_param("/no_such", "c4")
    for name in ("c1", "c2", "c3"):
        assert ros_gazebo.gazebo_delete_model(name)


def test_controllers_are_loaded_switched_reset_and_killed(cart):
    loaded = connection.controllers(SPACE, 1)
    assert ros_controllers.load_controller_srv(POLE, ns=SPACE)
    assert ros_controllers.load_controller_srv(POLE, ns=SPACE)  # it is there
    assert ros_controllers.start_controllers_srv([POLE], ns=SPACE)
    assert loaded.states()[POLE] == "running"
    assert ros_controllers.reset_controllers_srv([POLE, FOOT], ns=SPACE)
    assert loaded.states()[POLE] == "running"
    assert not ros_controllers.start_controllers_srv(["none"], ns=SPACE, strictness=2)
    assert ros_controllers.kill_controllers_srv([POLE], ns=SPACE)
    assert POLE not in loaded.states()
    assert not ros_controllers.unload_controller_srv(POLE, ns=SPACE)
    assert not ros_controllers.load_controller_srv("nameless", ns=SPACE)


def test_parameters_are_loaded(cart, tmp_path, monkeypatch):
    (tmp_path / "kit" / "config").mkdir(parents=True)
    (tmp_path / "kit" / "package.xml").write_text("<package><name>kit</name></package>")
    file = tmp_path / "kit" / "config" / "a.yaml"
    file.write_text("reach: {far: 2.0}\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    assert ros_params.ros_load_yaml_from_pkg("kit", "a.yaml", ns="/x")
    assert ros_params.ros_load_yaml_from_path(str(file))
    assert cart.node.get_param("/x/reach/far") == cart.node.get_param("/reach/far") == 2.0
    assert not ros_params.ros_load_yaml_from_pkg("kit", "b.yaml")
    assert not ros_params.ros_load_yaml_from_pkg("no_kit", "a.yaml")


@pytest.mark.long
def test_nodes_and_launch_files_start_and_end(cart, tmp_path):
    assert ros_spawn.init_robot_state_pub("/c9", max_pub_freq=20)
    assert cart.node.get_param("/c9/rob_st_pub/publish_frequency") == 20.0
    file = tmp_path / "l.launch"
    file.write_text('<launch><arg name="v"/><param name="from_launch" value="$(arg v)"/></launch>')
    assert ros_launch.ros_launch_from_path(str(file), args=["v:=4"])
    until(lambda: cart.node.get_param("/from_launch", None) == 4)
    assert not ros_launch.ros_launch_from_pkg("no_package", "l.launch")
    assert not ros_node.ros_node_from_pkg("no_package", "node")
    assert ros_node.ros_kill_node("/nobody")
    assert ros_launch.ros_kill_launch_process()


# -- the environment and what is around it -----------------------------------------------------


def test_a_step_is_as_many_steps_of_the_physics_as_asked_for(cart):
    env = Cart(reset_mode=2)
    observation, info = env.reset(seed=3)
    assert env.observation_space.contains(observation)
    assert info == {}
    before = cart.sim.time
    for _ in range(3):
        env.step(np.zeros(1, np.float32))
    assert cart.sim.time - before == pytest.approx(0.03)
    assert cart.sim.paused


def test_time_goes_on_while_an_action_is_sent_in_the_other_mode(cart):
    env = Cart(step_mode=1, controller_list=[FOOT], reset_controllers=True)
    env.reset()
    env._send_action = lambda action: until(lambda: cart.sim.time > before + 0.01)
    before = cart.sim.time
    assert env.step(np.zeros(1))[4] == {"is_success": 1.0}
    assert cart.sim.paused
    assert cart.sim.time > before + 0.01


@pytest.mark.parametrize("wrong", [{"reset_mode": 3}, {"step_mode": 0}])
def test_modes_that_are_none_are_said(cart, wrong):
    with pytest.raises(TaskError, match="is 1 or 2"):
        Cart(**wrong)


def test_a_robot_that_is_not_spawned_is_said(cart):
    with pytest.raises(TaskError, match="'robot' is not spawned"):
        RobotBasicEnv(spawn_robot=True, pkg_name="no_package", urdf_file="a.urdf")


def test_models_learn_save_and_predict(cart, tmp_path, monkeypatch, capsys):
    (tmp_path / "kit" / "config").mkdir(parents=True)
    (tmp_path / "kit" / "package.xml").write_text("<package><name>kit</name></package>")
    text = (ros_params_folder() / "ppo_config.yaml").read_text()
    text = text.replace("training_steps: 5000", "training_steps: 64").replace(
        "n_steps: 100", "n_steps: 32"
    )
    text = text.replace("batch_size: 100", "batch_size: 32").replace(
        "save_freq: 1000", "save_freq: 32"
    )
    (tmp_path / "kit" / "config" / "short.yaml").write_text(text)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    env = TimeLimitWrapper(NormalizeObservWrapper(NormalizeActionWrapper(Cart())), max_steps=15)
    names = {"config_file_pkg": "kit", "config_filename": "short.yaml"}
    model = PPO(env, f"{tmp_path}/models/", f"{tmp_path}/logs/", **names)
    assert model.train()
    assert (tmp_path / "models" / "trained_model.zip").is_file()
    assert (tmp_path / "models" / "ppo_model_32_steps.zip").is_file()
    assert (tmp_path / "logs" / "PPO_1" / "progress.csv").is_file()
    assert model.save_model()
    assert len(list((tmp_path / "models").glob("trained_model*.zip"))) == 2
    with pytest.raises(TaskError, match="there already"):
        PPO(env, f"{tmp_path}/models/", f"{tmp_path}/logs/", **names)
    loaded = PPO.load_trained(f"{tmp_path}/models/trained_model")
    action, _ = loaded.predict(np.zeros(2, np.float32), deterministic=True)
    assert action.shape == (1,)
    with pytest.raises(TaskError, match=r"no parameters in config/none\.yaml"):
        PPO(env, "m/", "l/", config_file_pkg="kit", config_filename="none.yaml")


def ros_params_folder():
    from gazelle import assets

    return assets.root() / "frobs_rl" / "config"


def test_policies_and_noise_are_those_of_the_parameters(cart):
    cart.rospy.set_param("/p/model_params/use_custom_policy", True)
    policy = {
        "net_arch": [8, 4],
        "activation_fn": "Tanh",
        "features_extractor_class": "FlattenExtractor",
        "optimizer_class": "SGD",
    }
    cart.rospy.set_param("/p/model_params/policy_params", policy)
    made = get_policy_kwargs("/p")
    assert made["net_arch"] == [8, 4]
    assert (made["activation_fn"].__name__, made["optimizer_class"].__name__) == ("Tanh", "SGD")
    cart.rospy.set_param("/p/model_params/policy_params/optimizer_class", "SDG")
    with pytest.raises(TaskError, match="did you mean 'SGD'"):
        get_policy_kwargs("/p")
    assert get_policy_kwargs("/nothing") is None
    assert get_action_noise((2,), "/nothing") is None
    cart.rospy.set_param("/p/model_params/use_action_noise", True)
    cart.rospy.set_param("/p/model_params/action_noise", {"mean": 0.5, "sigma": 0.0})
    assert get_action_noise((2,), "/p")().tolist() == [0.5, 0.5]


# -- wrappers, without a graph -----------------------------------------------------------------


class Numbers(gymnasium.Env):
    """Returns the action as observation."""

    action_space = spaces.Box(np.array([-2.0, 0.0], np.float32), np.array([2.0, 8.0], np.float32))
    observation_space = action_space

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        return np.array([0.0, 4.0], np.float32), {}

    def step(self, action):
        return np.asarray(action, np.float32), 1.0, False, False, {}


class OldNumbers(gym.Env):
    """The same with the old interface."""

    action_space = observation_space = Numbers.action_space

    def reset(self):
        return np.array([0.0, 4.0], np.float32)

    def step(self, action):
        return np.asarray(action, np.float32), 1.0, False, {}


@pytest.mark.parametrize("kind", [Numbers, OldNumbers])
def test_actions_and_observations_are_scaled(kind):
    env = modern(NormalizeObservWrapper(NormalizeActionWrapper(kind())))
    assert env.reset()[0].tolist() == [0.0, 0.0]
    for action in ([-1.0, 1.0], [0.0, 0.5], [1.0, -1.0]):
        observation, reward, terminated, truncated, _ = env.step(np.array(action, np.float32))
        assert observation.tolist() == pytest.approx(action)
        assert (reward, terminated, truncated) == (1.0, False, False)
    assert env.action_space == env.observation_space == spaces.Box(-1.0, 1.0, (2,), np.float32)
    with pytest.raises(ValueError, match="shape"):
        env.scale_observation([1.0])


@pytest.mark.parametrize("kind", [Numbers, OldNumbers])
def test_episodes_are_cut(kind):
    env = modern(TimeLimitWrapper(kind(), max_steps=2))
    env.reset()
    assert env.step(np.zeros(2))[2:4] == (False, False)
    *_, terminated, truncated, info = env.step(np.zeros(2))
    assert (terminated, truncated) == (True, True)
    assert info == {"is_success": 0.0, "time_limit_reached": True}
    env.reset()
    assert env.current_step == 0


def test_wrappers_of_an_old_environment_have_the_old_interface():
    env = TimeLimitWrapper(
        NormalizeObservWrapper(NormalizeActionWrapper(OldNumbers())), max_steps=1
    )
    assert isinstance(env, gym.Env)
    assert env.reset().tolist() == [0.0, 0.0]
    observation, reward, done, info = env.step(np.array([1.0, -1.0]))
    assert (observation.tolist(), reward, done) == ([1.0, -1.0], 1.0, True)
    assert info["time_limit_reached"]
    assert isinstance(env.unwrapped, gym.Env)
    assert env.max_steps == 1


def test_what_is_no_box_is_said():
    with pytest.raises(TaskError, match="box of actions"):
        NormalizeActionWrapper(gymnasium.make("CartPole-v1"))
