"""Parameters that plugins find on the parameter server, and those they let others change."""

import contextlib

import pytest
from graph_client import Client
from kobuki_model import kobuki
from models import GROUND, base, block, plugin
from plugin_graph import first, running

import gazelle
from gazelle.bridges import serve_ros
from gazelle.errors import SimulationWarning
from gazelle.simulation import Setting, Tunable, Tuning, WorldPlugin
from gazelle_ros import Master, load_message


class Tuned(WorldPlugin):
    """A plugin with a setting of each kind that matters, and a tuning."""

    def load(self, simulation, parameters):
        del parameters
        self.held = {"speed": 1.0, "on": True}
        ports = simulation.ports
        ports.settings["gains"] = Setting("/r/gains", {})
        ports.settings["rate"] = Setting("/r/rate", 5.0)
        ports.tunings["drive"] = Tuning(
            "/r/drive",
            (Tunable("speed", 1.0, 0.0, 2.0, "how fast"), Tunable("on", True, False, True, "")),
            self.held.update,
            lambda: self.held,
        )


@pytest.fixture
def graph():
    with Master(port=0, rosout=False) as master, gazelle.Simulation("empty") as sim:
        Tuned().load(sim, None)
        client = Client(master.uri)
        yield master, sim, client
        client.node.close()


def test_settings_are_looked_up_when_a_graph_is_joined(graph):
    master, sim, client = graph
    client.node.set_param("/r/gains/p", 3.0)
    with serve_ros(sim, master.uri):
        assert sim.ports.settings["gains"].value == {"p": 3.0}
        assert sim.ports.settings["rate"].value == 5.0


def test_a_parameter_of_another_type_is_left_with_a_warning(graph):
    master, sim, client = graph
    client.node.set_param("/r/rate", "quick")
    with pytest.warns(SimulationWarning, match="/r/rate"), serve_ros(sim, master.uri):
        assert sim.ports.settings["rate"].value == 5.0


def test_tunings_are_changed_by_dynamic_reconfigure_and_stand_on_the_parameter_server(graph):
    master, sim, client = graph
    double = load_message("dynamic_reconfigure/DoubleParameter")
    with serve_ros(sim, master.uri):
        assert client.node.get_param("/r/drive") == {"speed": 1.0, "on": True}
        config = load_message("dynamic_reconfigure/Config")()
        config.doubles = [double("speed", 9.0), double("nonsense", 1.0)]
        kind = "dynamic_reconfigure/Reconfigure"
        answer = client.call("/r/drive/set_parameters", kind, config=config).config
        assert [(each.name, each.value) for each in answer.doubles] == [("speed", 2.0)]
        assert [(each.name, each.value) for each in answer.bools] == [("on", True)]
        assert sim.ports.tunings["drive"].values["speed"] == 2.0
        assert client.node.get_param("/r/drive/speed") == 2.0
    assert "/r/drive/set_parameters" not in dict(client.node.master.system_state()[2])


def test_a_kobukis_base_topics_are_where_its_parameter_says():
    with running(kobuki(), GROUND, parameters={"/base_prefix": "base"}) as graph:
        assert first(graph, "/base/sensors/imu_data", "sensor_msgs/Imu")
        topics = dict(graph.client.node.master.topic_types())
        assert "/base/commands/velocity" in topics
        assert not any(name.startswith("/mobile_base") for name in topics)


def test_the_gains_of_a_mimic_joint_come_from_the_parameter_server():
    tags = plugin("libmimic_joint_plugin.so", joint="joint0", mimicJoint="joint1", hasPID="1")
    gains = {"/gazebo_ros_control/pid_gains/joint1": {"p": 4.0, "d": 0.1}}
    with running(base(tags), GROUND, parameters=gains) as graph:
        setting = graph.sim.robots["base"].settings["gazebo_ros_control/pid_gains/joint1"]
        assert setting.value == {"p": 4.0, "d": 0.1}


def test_frames_on_tf_get_the_prefix_of_their_plugins_own_namespace():
    tags = plugin("libgazebo_ros_planar_move.so", robotNamespace="r1")
    with running(base(tags), GROUND, parameters={"/r1/tf_prefix": "one"}) as graph:
        assert first(graph, "/r1/odom", "nav_msgs/Odometry").header.frame_id == "one/odom"
        transform = first(graph, "/tf", "tf2_msgs/TFMessage").transforms[0]
        assert (transform.header.frame_id, transform.child_frame_id) == (
            "one/odom",
            "one/base_footprint",
        )


def test_two_models_with_the_same_names_are_tuned_one_at_a_time():
    tags = plugin("libhector_gazebo_ros_magnetic.so", bodyName="core")
    one = block(plugin=tags, gravity=False)
    two = one.replace('"cube"', '"other"').replace("0 0 0.5", "1 0 0.5")
    with contextlib.ExitStack() as stack:
        with pytest.warns(SimulationWarning, match="/magnetic/set_parameters is offered"):
            graph = stack.enter_context(running(one, two))
        config = load_message("dynamic_reconfigure/Config")()
        config.doubles = [load_message("dynamic_reconfigure/DoubleParameter")("offset", 0.5)]
        kind = "dynamic_reconfigure/Reconfigure"
        graph.client.call("/magnetic/set_parameters", kind, config=config)
        offsets = {
            name: robot.tunings["magnetic"].values["offset"]
            for name, robot in graph.sim.robots.items()
        }
        assert offsets == {"cube": 0.5, "other": 0.0}
