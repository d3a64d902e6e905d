"""Contents of Stage files, beside the models that are made of them."""

import copy
import json
import pickle

import pytest
from stage_samples import write

import gazelle
from gazelle.simulation.encoding import decode, encode
from gazelle.stage import StageModel, StageWorld, stage_model, stage_world
from gazelle.stage.description import StagePlugin

FILES = {
    "empty": "resolution 0.5",
    "robots": 'position ( name "a" pose [1 2 0 90] ranger ( sensor ( noise [.1 0 0] ) ) ctrl "wander" )'
    'position ( name "b" drive "car" camera ( ) )',
    "devices": 'position ( name "a" gripper ( ) actuator ( axis [1 0 0] ) blobfinder ( ) fiducial ( ) '
    "bumper ( bcount 1 blength 0.4 ) blinkenlight ( ) )"
    'model ( name "m" color "random" )',
}


@pytest.fixture(params=FILES)
def world(request, tmp_path):
    return gazelle.load(write(tmp_path, FILES[request.param]))


def contents(world):
    """Return all that Stage's files say of a world; models compare without it."""
    return stage_world(world), [stage_model(model) for model in world.models]


def test_the_world_and_its_models_have_it(world):
    own, models = contents(world)
    assert isinstance(own, StageWorld)
    assert world.kind == "stage"
    assert models == [None, *own.models]  # the ground is not in the file
    assert all(isinstance(each, StageModel) for each in models[1:])
    assert [model.kind for model in world.models] == ["", *["stage"] * len(own.models)]


@pytest.mark.parametrize(
    "through",
    [
        lambda value: decode(json.loads(json.dumps(encode(value)))),
        copy.deepcopy,
        lambda value: pickle.loads(pickle.dumps(value)),
    ],
    ids=["recording", "copy", "pickle"],
)
def test_it_comes_back_whole(world, through):
    back = through(world)
    assert back == world
    assert contents(back) == contents(world)
    plugins = [type(plugin) for model in back.models for plugin in model.plugins]
    assert set(plugins) <= {StagePlugin}
    pose = back.content.models[-1].pose if back.content.models else None
    assert pose is None or pose.then(pose) is not None


def test_worlds_of_other_files_have_none():
    world = gazelle.load("empty")
    assert world.content is None
    assert (world.kind, stage_world(world)) == ("", None)
    assert [stage_model(model) for model in world.models] == [None] * len(world.models)
