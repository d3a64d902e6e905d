"""Plugins of users on a graph: any message, any service, and what cannot be there."""

import warnings
from types import SimpleNamespace

import pytest
from models import block
from plugin_graph import first, running, send, wait

from gazelle.errors import SimulationWarning
from gazelle.simulation import Input, ModelPlugin, Output, Service, register
from gazelle_ros import load_message, load_service

String = load_message("std_msgs/String")
PoseStamped = load_message("geometry_msgs/PoseStamped")
SetBool = load_service("std_srvs/SetBool")


class Speaker(ModelPlugin):
    """Speaks ROS messages."""

    update_rate = 50.0

    def load(self, robot, parameters):
        self.robot, self.said, self.on = robot, "", False
        name = robot.name
        robot.inputs["word"] = Input(f"/{name}/word", String, self.hear)
        self.pose = robot.outputs["pose"] = Output(f"/{name}/pose", PoseStamped, self.tell)
        self.word = robot.outputs["said"] = Output(f"/{name}/said", String, self.repeat)
        robot.services["switch"] = Service(
            f"/{name}/switch", SetBool._request_class, SetBool._response_class, self.switch
        )

    def hear(self, message, worlds):
        if message.data == "fail":
            raise ValueError("told to")
        self.said = message.data

    def repeat(self):
        return [String(data=self.said)]

    def tell(self):
        message = PoseStamped()
        message.header.frame_id = "world"
        message.pose.position.z = self.robot.pose.z
        return message

    def switch(self, request, worlds):
        self.on = request.data
        return SetBool._response_class(success=True, message=f"on: {request.data}")

    def on_update(self, time):
        self.pose.publish()
        self.word.publish()


register("libspeaker.so", Speaker)
SPEAKER = block(plugin='<plugin name="p" filename="libspeaker.so"/>', gravity=False)


def test_ports_may_carry_any_message():
    with running(SPEAKER) as graph:
        message = first(graph, "/cube/pose", "geometry_msgs/PoseStamped")
        assert (message.header.frame_id, message.pose.position.z) == ("world", 0.5)
        heard = graph.client.listen("/cube/said", "std_msgs/String")
        send(graph, "/cube/word", "std_msgs/String", data="hello")
        wait(lambda: any(each.data == "hello" for each in heard))
        answer = graph.client.call("/cube/switch", "std_srvs/SetBool", data=True)
        assert (answer.success, answer.message) == (True, "on: True")


def test_what_an_input_raises_ends_neither_the_simulation_nor_the_topic():
    with running(SPEAKER) as graph:
        heard = graph.client.listen("/cube/said", "std_msgs/String")
        publisher = send(graph, "/cube/word", "std_msgs/String", data="fail")
        publisher.publish(String(data="again"))
        wait(lambda: any(each.data == "again" for each in heard))


class Tired(ModelPlugin):
    """Tells its height until it is told to stop."""

    update_rate = 50.0
    tired = False

    def load(self, robot, parameters):
        robot.inputs["stop"] = Input("/stop", String, self.stop)
        self.height = robot.outputs["height"] = Output("/height", float, self.tell)

    def stop(self, message, worlds):
        self.tired = True

    def tell(self):
        return 1.0 / (not self.tired)

    def on_update(self, time):
        self.height.publish()


register("libtired.so", Tired)


def test_a_reset_does_not_wait_for_a_topic_that_failed():
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        with running(block(plugin='<plugin name="p" filename="libtired.so"/>')) as graph:
            first(graph, "/height", "std_msgs/Float64")
            send(graph, "/stop", "std_msgs/String")
            wait(lambda: told)
            for _ in range(2):
                graph.client.call("reset_simulation", "std_srvs/Empty")
            wait(lambda: graph.sim.time > 0.1)
    texts = [str(each.message) for each in told]
    assert [text.partition(" failed")[0] for text in texts] == [
        "plugin 'p' of 'cube'",
        "the topic '/height'",
    ]


class Odd(ModelPlugin):
    """Opens ports that cannot be on a graph."""

    def load(self, robot, parameters):
        robot.outputs["odd"] = Output("/odd", SimpleNamespace, SimpleNamespace)
        robot.inputs["bad"] = Input("/not a name", String, lambda message, worlds: None)
        robot.outputs["good"] = Output("/good", String, String)


register("libodd.so", Odd)


def test_a_port_that_cannot_be_on_the_graph_stays_away_alone():
    odd = block(plugin='<plugin name="p" filename="libodd.so"/>')
    with pytest.warns(SimulationWarning) as told:
        topics = topics_of(odd)
    assert "/good" in topics
    assert "/odd" not in topics
    texts = [str(each.message) for each in told]
    assert any("'/odd' stays off" in text and "load_message" in text for text in texts)
    assert any("'/not a name' stays off" in text for text in texts)


def topics_of(model):
    """Return the topics of a graph with a model."""
    with running(model) as graph:
        first(graph, "/clock", "rosgraph_msgs/Clock")
        return dict(graph.client.node.master.published_topics())
