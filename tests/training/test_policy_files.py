"""Exported policies: the same actions as Stable-Baselines3's, in ONNX Runtime and in numpy."""

from __future__ import annotations

import dataclasses
import json
import subprocess
import sys

import numpy as np
import pytest

from gazelle.envs import PolicyContract
from gazelle.errors import FormatError, TaskError
from gazelle.training import (
    OffPolicySettings,
    PPOSettings,
    Recipe,
    export_policy,
    load_actor,
    load_policy,
    train,
)
from gazelle.training.bearing import Bearing
from gazelle.training.checkpoint import read_checkpoint
from gazelle.training.learners import build_learner
from gazelle.training.supported_values import supported_only
from gazelle.training.tasks import make_task
from gazelle.training.vecenv import VectorEnvAdapter

onnxruntime = pytest.importorskip("onnxruntime")

SMALL = OffPolicySettings(
    buffer_size=2000, batch_size=32, learning_starts=100, target_update_interval=100
)
QUICK = PPOSettings(n_steps=16, batch_size=32, n_epochs=2)


def recipe(algo, **values):
    settings = QUICK if algo == "ppo" else supported_only(algo, SMALL)
    return Recipe(algo=algo, steps=600, num_envs=4, settings=settings, **values)


def policy_of(result):
    """Return Stable-Baselines3's own policy, and 1,000 observations of its task."""
    config = result.run.config
    env = VectorEnvAdapter(make_task(config.task, config.recipe.num_envs, **config.options))
    learner = build_learner(config.recipe, env, 0)
    read_checkpoint(result.run.newest_checkpoint(), learner)
    seen, obs = [], env.reset()
    while sum(map(len, seen)) < 1000:
        seen.append(obs)
        actions = np.array([env.action_space.sample() for _ in range(env.num_envs)])
        obs, *_ = env.step(actions)
    env.close()
    return learner, np.concatenate(seen)[:1000]


def onnx_actions(file, obs):
    session = onnxruntime.InferenceSession(file)
    return session.run(["action"], {"observation": obs})[0]


CASES = [
    ("ppo", {"continuous": False}, {}),
    ("ppo", {"continuous": True}, {"net_arch": (5,)}),
    ("dqn", {"continuous": False}, {"net_arch": (40, 24, 8), "activation": "relu"}),
    ("sac", {"continuous": True}, {"net_arch": (32, 16)}),
    ("td3", {"continuous": True}, {"net_arch": (7, 9, 11), "activation": "relu"}),
    ("ddpg", {"continuous": True}, {"net_arch": (16,), "activation": "relu"}),
    ("ppo", {"continuous": False}, {"features": True, "activation": "relu"}),
    ("sac", {"continuous": True}, {"features": True}),
    ("ppo", {"continuous": False}, {"bearing": Bearing(x=0, y=1, goal=(0.3, -0.2))}),
    ("td3", {"continuous": True}, {"bearing": Bearing(x=1, y=0, yaw=1, goal=(1.0, 2.0))}),
    ("ppo", {"continuous": True, "bound": 1000.0}, {}),  # normalised by what is observed
    ("dqn", {"continuous": False, "bound": 1000.0}, {}),
    ("td3", {"continuous": True}, {"scale_observations": False}),
    ("ddpg", {"continuous": True, "bound": 1000.0}, {"cut_observations": 0.5}),
    ("ppo", {"continuous": False, "bound": 1000.0}, {"cut_observations": 1.0}),
]


@pytest.mark.long
@pytest.mark.parametrize(("algo", "options", "more"), CASES)
def test_exported_policies_act_as_the_library_predicts(tmp_path, algo, options, more):
    result = train(
        "test/Corridor-v0", recipe=recipe(algo, **more), out=tmp_path / "runs", seed=7, **options
    )
    learner, obs = policy_of(result)
    expected, _ = learner.predict(obs, deterministic=True)
    onnx = export_policy(result.run.folder, "onnx", tmp_path)
    arrays = export_policy(result.run.folder, "numpy", tmp_path)
    for found in (onnx_actions(onnx.policy, obs), load_actor(arrays.policy).act(obs)):
        assert found.shape == expected.shape
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)


@pytest.mark.long
@pytest.mark.parametrize(
    ("task", "algo"),
    [
        ("TurtleBot3Stage2", "ppo"),
        ("TurtleBot3Stage4", "dqn"),
        ("TurtleBot3Stage1Continuous", "sac"),
        ("AGVFleet", "td3"),
    ],
)
def test_bundled_tasks_too(tmp_path, task, algo):
    result = train(
        task,
        recipe=recipe(algo, features=True, net_arch=(64, 64)),
        out=tmp_path,
        engine="planar",
    )
    learner, obs = policy_of(result)
    expected, _ = learner.predict(obs, deterministic=True)
    files = export_policy(result.run.folder)
    np.testing.assert_allclose(onnx_actions(files.policy, obs), expected, rtol=0, atol=1e-6)
    contract = load_policy(files.policy)[1]
    assert contract.size == obs.shape[1]
    assert contract.action.kind == "velocity"


@pytest.fixture(scope="module")
def stage4(tmp_path_factory):
    """Return a hardly trained policy of stage 4."""
    result = train(
        "TurtleBot3Stage4", recipe=recipe("ppo"), out=tmp_path_factory.mktemp("runs"), seed=2
    )
    return result.run.folder


@pytest.mark.long
def test_the_contract_tells_layout_units_rates_and_limits(stage4, tmp_path):
    files = export_policy(stage4, "numpy", tmp_path / "robot.npz")
    assert files.contract == tmp_path / "robot.json"
    told = json.loads(files.contract.read_text())
    parts = [(p["name"], p["kind"], p["start"], p["size"], p["unit"]) for p in told["observation"]]
    assert parts == [
        ("ranges", "scan", 0, 24, "m"),
        ("heading", "goal_heading", 24, 1, "rad"),
        ("distance", "goal_distance", 25, 1, "m"),
        ("nearest", "nearest_range", 26, 1, "m"),
        ("nearest_ray", "nearest_ray", 27, 1, "1"),
    ]
    assert told["control_period"] == 0.2
    assert told["scan"]["no_return"] == 3.5
    assert told["scan"]["last_angle"] == pytest.approx(2 * np.pi, abs=1e-4)
    assert told["action"]["choices"] == [[0.15, 1.5 - 0.75 * i] for i in range(5)]
    assert told["collision_range"] == 0.13
    assert told["time_limit"] == pytest.approx(100.2)
    assert told["training"]["seed"] == 2
    assert "torch" in told["versions"]
    assert PolicyContract.from_dict(told) == load_policy(stage4)[1]


def test_the_contract_is_inside_the_onnx_file_too(stage4, tmp_path):
    files = export_policy(stage4, "onnx", tmp_path)
    session = onnxruntime.InferenceSession(files.policy)
    inside = json.loads(session.get_modelmeta().custom_metadata_map["gazelle_contract"])
    assert inside == json.loads(files.contract.read_text())


def test_a_run_without_contract_asks_its_task_again(stage4):
    told = load_policy(stage4)[1]
    (stage4 / "contract.json").unlink()
    assert dataclasses.replace(load_policy(stage4)[1]) == told


@pytest.mark.long
def test_numpy_policies_act_without_torch(stage4, tmp_path):
    files = export_policy(stage4, "numpy", tmp_path)
    script = (
        "import sys; sys.modules['torch'] = None; sys.modules['stable_baselines3'] = None\n"
        "import numpy as np\n"
        "from gazelle.training import load_actor, load_policy\n"
        "file, contract = load_policy(sys.argv[1])\n"
        "print(load_actor(file).act(np.ones((3, contract.size), np.float32)).shape)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(files.policy)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.strip() == "(3,)", done.stderr


def test_a_task_that_tells_nothing_has_its_spaces_told(tmp_path):
    result = train("test/Corridor-v0", recipe=recipe("ppo"), out=tmp_path)
    contract = load_policy(result.run.folder)[1]
    (part,) = contract.observation
    assert (part.kind, part.size, part.low) == ("other", 3, pytest.approx((-1.2,) * 3))
    assert contract.control_period == 0.2
    assert contract.action.kind == "other"


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"format": "x"}, "the format is 'x'"),
        ({"observation": [{"name": "a", "kind": "scann"}]}, "unknown kind 'scann'"),
        ({"observation": [{"name": "a", "start": 1}]}, "expected one or more from 0"),
        ({"observation": [{"name": "a", "sise": 1}]}, "'sise' is not part"),
        ({"actions": {}}, "'actions' is not part"),
        ({"scan": {"first_angle": 0.0}}, "last_angle"),
    ],
)
def test_a_wrong_contract_is_one_clear_error(stage4, tmp_path, change, complaint):
    files = export_policy(stage4, "numpy", tmp_path)
    files.contract.write_text(json.dumps(json.loads(files.contract.read_text()) | change))
    with pytest.raises(FormatError, match=complaint):
        load_policy(files.policy)


def test_wrong_wishes_are_refused(stage4, tmp_path):
    with pytest.raises(TaskError, match=r"no format 'onx'.*did you mean 'onnx'"):
        export_policy(stage4, "onx")
    with pytest.raises(TaskError, match=r"end in \.onnx"):
        export_policy(stage4, "onnx", tmp_path / "a.npz")
    with pytest.raises(FormatError, match="no run here"):
        export_policy(tmp_path)
    np.savez(tmp_path / "alone.npz")
    with pytest.raises(FormatError, match="no contract"):
        load_policy(tmp_path / "alone.npz")


@pytest.mark.parametrize("name", ["nothing", "nothing.npz", "runs/nothing", "nothing.onnx"])
def test_a_policy_that_is_not_there_is_said_so(name, tmp_path):
    with pytest.raises(FormatError, match="no such file or folder"):
        load_policy(tmp_path / name)
