"""The example launch files of amcl."""

from __future__ import annotations

import pytest

from gazelle import assets
from gazelle.bridges.navigation.amcl import AmclNode
from gazelle_ros import Master, Node
from gazelle_ros.launch import load_launch


@pytest.mark.parametrize("model", ["diff", "omni"])
def test_the_examples_have_the_published_settings(model, recwarn):
    plan = load_launch(assets.root() / f"amcl/examples/amcl_{model}.launch")
    with Master(port=0, rosout=False) as master, Node("amcl", master_uri=master.uri) as node:
        for name, parameter in plan.parameters.items():
            node.set_param(name, parameter.value)
        settings = AmclNode(node).settings
    assert settings.odom_model_type == model
    assert (settings.min_particles, settings.max_particles) == (500, 5000)
    assert (settings.odom_alpha3, settings.laser_z_hit) == (0.8, 0.5)
    assert not [each for each in recwarn if "unknown" in str(each.message)]
