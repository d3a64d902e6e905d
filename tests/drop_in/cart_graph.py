"""openai_ros' cart and pole on a graph that runs, and rospy's node in this process."""

from __future__ import annotations

import contextlib
import importlib
import sys
from types import SimpleNamespace

import pytest

import gazelle
import gazelle_ros as ros
from gazelle import assets
from gazelle.bridges import serve_ros
from gazelle.clients import load_parameters
from gazelle.description import World


@contextlib.contextmanager
def cart_graph(space="/cartpole_v0"):
    """Yield ``sim``, ``node`` (another one than rospy's), ``rospy``."""
    from gazelle_ros.compat.rospy import client

    with (
        pytest.MonkeyPatch.context() as patch,
        ros.Master(port=0, rosout=False) as master,
        ros.Node("tester", master_uri=master.uri) as node,
        gazelle.Simulation(World("w")) as sim,
    ):
        path, arguments = assets.robot("cartpole"), {"ros_control": "true"}
        (model,) = gazelle.formats.load(path, xacro_args=arguments).models
        sim.spawn(model, name=space.strip("/"))
        load_parameters(node, "config/cartpole_control.yaml", package="cartpole_description")
        patch.setenv("ROS_MASTER_URI", master.uri)
        patch.setattr(sys, "argv", ["train"])
        with serve_ros(sim, master.uri) as server, ros.install():
            server.start()
            client.reset()
            rospy = importlib.import_module("rospy")
            rospy.init_node("train", disable_signals=True)
            yield SimpleNamespace(sim=sim, node=node, rospy=rospy, master=master)
            client.reset()
