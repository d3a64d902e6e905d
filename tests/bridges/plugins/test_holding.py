"""Harnesses and slipping wheels, as a client on the graph handles them."""

from __future__ import annotations

from models import GROUND, base
from plugin_graph import running, send, wait
from test_harness import harness
from test_wheel_slip import LATERAL, LONGITUDINAL, wheels

from gazelle_ros import load_message


def test_a_winch_is_told_its_speed_and_to_let_go():
    with running(harness(), GROUND) as graph:
        robot = graph.sim.robots["cube"]
        send(graph, "/cube/harness/velocity", "std_msgs/Float32", data=1.0)
        wait(lambda: robot.position[0, 2] > 0.8)
        send(graph, "/cube/harness/detach", "std_msgs/Bool", data=True)
        wait(lambda: robot.position[0, 2] < 0.15)


def test_the_slip_of_wheels_is_reconfigured():
    with running(base(wheels(lateral=0.1)), GROUND) as graph:
        double = load_message("dynamic_reconfigure/DoubleParameter")
        config = load_message("dynamic_reconfigure/Config")(
            doubles=[double(name=LATERAL, value=30.0)]
        )
        answer = graph.client.call(
            "/base/wheel_slip/set_parameters", "dynamic_reconfigure/Reconfigure", config=config
        )
        values = {each.name: each.value for each in answer.config.doubles}
        assert values == {LATERAL: 20.0, LONGITUDINAL: -1.0}
        (tuning,) = graph.sim.robots["base"].tunings.values()
        assert tuning.values == values
