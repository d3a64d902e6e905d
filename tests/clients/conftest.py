"""A simulation on a graph, running in the background, and a client of it."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import pytest

import gazelle
from gazelle.bridges import serve_ros
from gazelle.clients import Gazebo
from gazelle_ros import Master


@pytest.fixture
def graph():
    """Run stage 1 with a burger, in real time."""
    with Master(port=0, rosout=False) as master, gazelle.Simulation("turtlebot3_stage_1") as sim:
        sim.spawn("turtlebot3_burger", name="r1", namespace="/")
        with serve_ros(sim, master.uri) as server:
            thread = threading.Thread(target=server.run)
            thread.start()
            with Gazebo(master_uri=master.uri, timeout=60.0) as gazebo:
                yield SimpleNamespace(sim=sim, master=master, gazebo=gazebo)
            server.stop()
            thread.join()
