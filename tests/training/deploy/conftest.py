from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def master():
    from gazelle_ros import Master

    with Master(port=0, rosout=False) as running:
        yield running


@pytest.fixture(scope="session")
def straight_on(tmp_path_factory):
    """Return a policy file that always drives straight on, with the contract of stage 1."""
    import numpy as np

    from gazelle.training.actor import Actor

    weight = np.zeros((26, 5), np.float32)
    bias = np.array([0, 0, 1, 0, 0], np.float32)
    return write(tmp_path_factory.mktemp("policy"), Actor((weight,), (bias,), "tanh", "greedy"))


@pytest.fixture(scope="session")
def homing(tmp_path_factory):
    """Return a policy file that turns to the goal and drives there, blind to obstacles."""
    import numpy as np

    from gazelle.training.actor import Actor

    weight = np.zeros((26, 5), np.float32)
    # Values are lines over the heading that cross at 0.15 and 0.6 rad to either side.
    weight[24] = [6.0, 2.0, 0.0, -2.0, -6.0]
    bias = np.array([-2.7, -0.3, 0.0, -0.3, -2.7], np.float32)
    return write(tmp_path_factory.mktemp("policy"), Actor((weight,), (bias,), "tanh", "greedy"))


def write(folder, actor):
    import json

    from gazelle.training.tasks import make_task

    env = make_task("TurtleBot3Stage1", 1, engine="planar")
    actor.save(folder / "robot.npz")
    (folder / "robot.json").write_text(json.dumps(env.unwrapped.contract.to_dict()))
    env.close()
    return folder / "robot.npz"
