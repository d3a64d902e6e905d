"""AGVs on the graph of a Stage world move and tell the simulated time it took."""

import math
import threading

import numpy as np
import pytest

from gazelle.clients import AGV, AGVFleet, ClientError
from gazelle.description import World
from gazelle.formats import load
from gazelle.navigation import Limits
from gazelle.simulation import Simulation
from gazelle.stage import stage_of
from gazelle.stage.bridge import serve_stage
from gazelle_ros import Master, Node
from gazelle_ros.messages import UnknownTypeError, register

WORLD = """
interval_sim 100
define agv position ( size [.5 .5 .5] drive "diff" localization "gps" )
agv ( name "a" pose [0 0 0 0] )
agv ( name "b" pose [0 3 0 90] )
agv ( name "c" pose [0 -3 0 -90] )
"""
SERVICE = "---\nfloat64 x\nfloat64 y\nfloat64 angle\n"


@pytest.fixture
def running(tmp_path):
    """Run a Stage world twenty times as fast as time, and a node beside it."""
    register("sim_agv", "AgvPose", SERVICE)
    file = tmp_path / "agv.world"
    file.write_text(WORLD)
    world = load(file)
    assert isinstance(world, World)
    with (
        Master(port=0) as master,
        Simulation(world, "planar") as simulation,
        serve_stage(simulation, master.uri, rate=20.0) as server,
    ):
        thread = threading.Thread(target=server.run, args=(1e9,))
        thread.start()
        with Node("client", master_uri=master.uri) as node:
            yield simulation, node
        server.stop()
        thread.join()


@pytest.mark.long
@pytest.mark.parametrize("poses", ["topic", "service"])
def test_an_agv_moves_and_tells_how_long_it_took(running, poses):
    simulation, node = running
    with AGV(node, "/robot_0", poses=poses, limits=Limits(linear=1.0)) as agv:
        agv.wait()
        # In the world's time, of which a pause of this process lasts twenty times as much.
        took = agv.move_l(4.0, 0.0, timeout=4000.0)
        assert 4.0 <= took <= 4000.0
        x, y, heading = stage_of(simulation).poses[0, 0]
        assert math.hypot(x - 4.0, y) < 0.03
        assert agv.move_c(math.pi / 2) >= 1.5
        agv.move_ofsc(-math.pi / 2)
        heading = stage_of(simulation).poses[0, 0, 2]
        assert abs(heading + math.pi / 2) < 0.02


def test_a_fleet_moves_all_at_once(running):
    simulation, node = running
    spaces = [f"/robot_{number}" for number in range(3)]
    with AGVFleet(node, spaces, limits=Limits(linear=1.0)) as fleet:
        fleet.wait()
        took = fleet.move_l([3.0, 3.0, 3.0], [0.0, 3.0, -3.0], timeout=4000.0)
        assert (took > 3.0).all()
        away = stage_of(simulation).poses[0, :, :2] - [[3.0, 0.0], [3.0, 3.0], [3.0, -3.0]]
        assert np.hypot(*away.T).max() < 0.1


def test_moves_time_out_and_can_be_cancelled(running):
    _, node = running
    with AGV(node, "/robot_0") as agv:
        agv.wait()
        with pytest.raises(ClientError, match="in time"):
            agv.move_l(9.0, 0.0, timeout=1.0)
        over = threading.Event()

        def cancel():
            while not over.wait(0.2):
                agv.cancel()

        canceller = threading.Thread(target=cancel)
        canceller.start()
        try:
            with pytest.raises(ClientError, match="the motion of /robot_0 was cancelled"):
                agv.move_l(-900.0, 0.0, timeout=6000.0)
        finally:
            over.set()
            canceller.join()


@pytest.mark.long
def test_what_is_not_there_is_told(running):
    _, node = running
    with pytest.raises(ClientError, match="topic or a service"):
        AGV(node, poses="topics")
    with pytest.raises(UnknownTypeError):
        AGV(node, poses="service", service_type="sim_agv/AgvPlace")
    with AGV(node, "/robt_1") as agv, pytest.raises(ClientError, match="/robt_1 has no") as caught:
        agv.wait(0.3)
    assert "did you mean '/robot_1'" in caught.value.hint
    with (
        AGV(node, "/robot_0", pose_name="base_pose") as agv,
        pytest.raises(ClientError, match="/robot_0 has no base_pose within"),
    ):
        agv.wait(0.3)
