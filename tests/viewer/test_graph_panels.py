"""Panels of the page of a graph in a real browser: what rqt's plugins do, by clicking."""

import io
import logging
import re
from contextlib import contextmanager
from types import SimpleNamespace

import pytest
from PIL import Image

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.viewer.graph.panels.reconfigure import choices_of
from gazelle_ros import Time, load_service
from gazelle_ros.bags import Bag
from gazelle_ros.msgs import controller_manager_msgs
from gazelle_ros.reconfigure import ReconfigureServer
from tests.ros.graph import until
from tests.viewer.graph_page import graph_page, message

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def graph():
    with graph_page() as made:
        made.say_frames(odom=(0.0, 0.0), laser=(1.0, 0.0))
        yield made


@contextmanager
def opened_panel(graph, title):
    """Open a panel by the page's list, and close it by its button."""
    graph.choose("Open panel", title)
    until(lambda: graph.view._panels.panel(title) is not None)
    try:
        yield graph.view._panels.panel(title)
        graph.click("Close")
    except BaseException:
        graph.view._panels.close_panel(title)
        raise
    finally:
        until(lambda: graph.view._panels.titles == [])


def test_the_console_filters_by_level_node_and_text(graph):
    with opened_panel(graph, "Console"):

        def log(level, name, text):
            graph.say("/rosout", "rosgraph_msgs/Log", level=level, name=name, msg=text)

        until(lambda: graph.view._context.node.subscription("/rosout") is not None)
        log(2, "/planner", "ready for <b>goals</b>")
        graph.wait_text("ready for <b>goals</b>")
        log(8, "/driver", "the motor is hot")
        graph.wait_text("the motor is hot")
        graph.choose("At least", "Error")
        until(lambda: graph.page.get_by_text("ready for").count() == 0)
        graph.wait_text("the motor is hot")
        graph.choose("At least", "Debug")
        graph.fill("Node", "plan")
        until(lambda: graph.page.get_by_text("the motor is hot").count() == 0)
        graph.wait_text("ready for")


def test_the_topic_monitor_shows_types_rates_and_messages(graph):
    with opened_panel(graph, "Topic monitor"):
        graph.fill("Topics", "speed")

        def measured():
            graph.say("/speed", "std_msgs/Float64", data=0.25)
            row = graph.page.locator("tr", has_text="/speed")
            cells = row.locator("td").all_inner_texts() if row.count() else []
            return len(cells) == 6 and cells[1] == "std_msgs/Float64" and float(cells[4] or 0) > 1

        until(measured)
        graph.choose("Last message", "/speed")
        graph.wait_text("data: 0.25")


def test_the_node_graph_has_a_box_for_each_node_and_topic(graph):
    with opened_panel(graph, "Node graph"):
        graph.node.subscribe("/chatter", type(message("std_msgs/String")), lambda _: None)
        graph.say("/chatter", "std_msgs/String", data="hello")
        picture = graph.page.locator("svg", has_text="/chatter")
        picture.wait_for()
        texts = picture.locator("text").all_text_contents()
        assert sorted(texts)[:2] == ["/chatter", "/talker"]
        assert picture.locator("path[marker-end]").count() >= 2
        graph.choose("Show", "nodes only")
        until(lambda: graph.page.locator("svg", has_text="/talker").locator("rect").count() == 1)


def test_the_tf_tree_names_broken_transforms(graph):
    with opened_panel(graph, "tf tree"):
        graph.page.locator("svg", has_text="laser").wait_for()
        lost = message("geometry_msgs/TransformStamped", child_frame_id="arm")
        lost.header.frame_id, lost.header.stamp = "table", Time.from_sec(1.0)
        lost.transform.rotation.w = 1.0
        graph.say("/tf", "tf2_msgs/TFMessage", transforms=[lost])
        graph.wait_text("2 trees that no transform connects: map, table")


def test_a_field_is_plotted(graph):
    with opened_panel(graph, "Plot") as panel:
        graph.say("/joint_states", "sensor_msgs/JointState", position=[0.5, 1.5])
        graph.fill("Field", "/joint_states/position/1")
        graph.click("Add")

        def drawn():
            graph.say("/joint_states", "sensor_msgs/JointState", position=[0.5, 1.5])
            return panel._chart is not None and len(panel._chart.data[0]) > 3

        until(drawn)
        assert set(panel._chart.data[1]) == {1.5}
        graph.page.locator(".u-legend", has_text="/joint_states/position/1").wait_for()
        graph.choose("Remove", "/joint_states/position/1")
        until(lambda: panel._chart is None)


def test_messages_are_published(graph):
    with opened_panel(graph, "Publisher"):
        got = []
        graph.node.subscribe("/goal_id", type(message("std_msgs/String")), got.append)
        graph.fill("Topic", "/goal_id")
        kind = graph.box("Type")
        until(lambda: kind.input_value() == "std_msgs/String")
        graph.fill("Message", "data: abc")
        graph.click("Publish once")
        until(lambda: [each.data for each in got] == ["abc"])
        graph.fill("Message", "dada: abc")
        graph.click("Publish once")
        graph.wait_text("This cannot be done")


def test_services_are_called(graph):
    add = load_service("roscpp_tutorials/TwoInts")
    server = graph.node.serve("/add", add, lambda asked: {"sum": asked.a + asked.b})
    with opened_panel(graph, "Service caller"):
        graph.fill("Filter", "/add")
        graph.choose("Service", "/add")
        request = graph.box("Request")
        until(lambda: request.input_value() == "a: 0\nb: 0")
        graph.fill("Request", "{a: 40, b: 2}")
        graph.click("Call")
        graph.wait_text("sum: 42")
    server.close()


def test_a_robot_is_steered_and_stops_with_the_panel(graph):
    got = []
    graph.node.subscribe("/cmd_vel", type(message("geometry_msgs/Twist")), got.append)
    with opened_panel(graph, "Robot steering"):
        # What is filled in while a panel is still being drawn may be lost.
        until(lambda: graph.fill("Linear [m/s]", "0.4") or len(got) > 3)
        assert {(each.linear.x, each.angular.z) for each in got} == {(0.4, 0.0)}
    until(lambda: got[-1].linear.x == 0.0)


STANDARD = """(() => {
window.pad = {id: "A *pad*", mapping: "standard", axes: [0.525, -1.0, 0.02, 0.0],
              buttons: Array.from({length: 17}, () => ({value: 0}))};
navigator.getGamepads = () => [null, window.pad];
})()"""


def test_a_gamepad_of_the_browser_is_published_as_by_joy_node(graph):
    got = []
    graph.node.subscribe("/joy", type(message("sensor_msgs/Joy")), got.append)
    graph.page.evaluate(STANDARD)
    with opened_panel(graph, "Joystick"):
        graph.wait_text("A pad")
        until(lambda: got)
        # Left and up are positive, there is a dead zone, and triggers are 1 until they are pulled.
        axes = [-0.5, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0]
        assert got[-1].axes == pytest.approx(axes, abs=1e-3)
        assert list(got[-1].buttons) == [0] * 11
        graph.page.evaluate("window.pad.buttons[3].value = window.pad.buttons[12].value = 1")
        graph.page.evaluate("window.pad.buttons[6].value = 1")
        until(lambda: got[-1].axes[7] == 1.0)
        assert list(got[-1].buttons) == [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0]
        assert got[-1].axes[2] == -1.0
        graph.page.evaluate("window.pad.mapping = ''")
        until(lambda: len(got[-1].buttons) == 17)
        assert got[-1].axes == pytest.approx([-0.5, 1.0, 0.0, 0.0], abs=1e-3)
        graph.page.evaluate("navigator.getGamepads = () => []")
        until(lambda: not any((*got[-1].axes, *got[-1].buttons)))  # a silent page lets go
        graph.wait_text("No gamepad")


ARM = """<robot name="arm"><link name="base"/><link name="tip"/><link name="end"/>
<joint name="elbow" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
<limit lower="0.5" upper="1.5" effort="1" velocity="1"/></joint>
<joint name="copy" type="continuous"><parent link="tip"/><child link="end"/>
<mimic joint="elbow"/></joint></robot>"""


def test_joints_have_sliders_where_a_node_takes_them(graph):
    got = []
    kind = type(message("sensor_msgs/JointState"))
    sliders = graph.node.subscribe("/left/arm/gui/sliders", kind, got.append)
    graph.node.set_param("/left/robot_description", ARM)
    try:
        with opened_panel(graph, "Joint sliders") as panel:
            until(lambda: "elbow" in panel._sliders)
            until(lambda: graph.box("Topic").input_value() == "/left/arm/gui/sliders")
            assert (list(panel._sliders), panel._sliders["elbow"].value) == (["elbow"], 1.0)
            until(lambda: sliders.num_connections)
            label, slider = (graph.page.get_by_text("elbow", exact=True).last.bounding_box(),
                             graph.page.get_by_role("slider").last.bounding_box())  # fmt: skip
            assert label["y"] + label["height"] <= slider["y"]  # above it, where long names fit
            graph.fill("elbow", "1.25")
            until(lambda: got)
            assert (list(got[-1].name), list(got[-1].position)) == (["elbow"], [1.25])
    finally:
        graph.node.delete_param("/left/robot_description")
        sliders.close()


class Gains:
    """Two settings, as dynamic_reconfigure wants them."""

    def __init__(self):
        self.values = {"gain": 1.0, "inverted": False}
        self.tunables = {
            name: SimpleNamespace(name=name, default=value, least=type(value)(0),
                                  most=type(value)(10), description=f"the {name}")
            for name, value in self.values.items()
        }  # fmt: skip

    def send(self, **wanted):
        self.values.update(wanted)
        return self.values


def test_parameters_are_reconfigured(graph):
    gains = Gains()
    server = ReconfigureServer(graph.node, "/driver", gains)
    with opened_panel(graph, "Reconfigure") as panel:
        graph.choose("Node", "/driver")
        until(lambda: set(panel._controls) == {"gain", "inverted"})
        graph.fill("gain", "2.5")
        until(lambda: gains.values["gain"] == 2.5)
        graph.page.get_by_label("inverted").click()
        until(lambda: gains.values["inverted"] is True)
        server._publish_values(gains.send(gain=4.0))
        until(lambda: graph.box("gain").input_value() == "4")
    server.close()


def test_a_bag_is_played(graph, tmp_path):
    file = tmp_path / "drive.bag"
    with Bag(str(file), "w") as bag:
        for tenth in range(20):
            bag.write(
                "/count", message("std_msgs/Int32", data=tenth), Time.from_sec(5 + tenth / 10)
            )
    got = []
    graph.node.subscribe("/count", type(message("std_msgs/Int32")), got.append)
    with opened_panel(graph, "Bag player"):
        graph.fill("Bag", str(tmp_path / "none.bag"))
        graph.wait_text("This cannot be done")
        graph.fill("Bag", str(file))
        graph.page.locator("td", has_text="/count").wait_for()
        graph.fill("Start [s]", "0.95")
        graph.click("Play")
        graph.wait_text("of 1.9 s, running")
        until(lambda: got and got[-1].data == 19)
        assert min(each.data for each in got) >= 10


def test_a_bag_is_recorded(graph, tmp_path):
    file = tmp_path / "talk.bag"
    with opened_panel(graph, "Bag player") as panel:
        graph.fill("Topics", "/talk /more")
        graph.fill("File", str(file))
        until(lambda: panel._recording.inputs["recorded"].value == str(file))
        graph.click("Record")
        graph.wait_text("recording for")
        graph.say("/talk", "std_msgs/Int32", data=7)
        graph.say("/more", "std_msgs/Int32", data=8)
        until(lambda: sum(panel._recording._recorder._counts.values()) == 2)
        graph.click("End")
        graph.wait_text(f"recorded in {file}")
    with Bag(str(file)) as bag:
        found = sorted((topic, each.data) for topic, each, _ in bag.read_messages())
    assert found == [("/more", 8), ("/talk", 7)]


def test_levels_of_loggers_are_changed(graph):
    logger = logging.getLogger("gazelle.viewer")
    before = logger.level
    try:
        with opened_panel(graph, "Logger levels"):
            graph.choose("Node", "/rosout")
            graph.choose("Logger", "gazelle.viewer")
            graph.choose("Level", "DEBUG")
            until(lambda: logger.level == logging.DEBUG)
    finally:
        logger.setLevel(before)


def test_images_are_viewed(graph):
    with opened_panel(graph, "Image view") as panel:
        row = bytes([250, 10, 20] * 8)
        graph.say("/camera", "sensor_msgs/Image", height=4, width=8, encoding="rgb8",
                  step=24, data=row * 4)  # fmt: skip
        graph.choose("Topic", "/camera")
        graph.wait_text("8 x 4, rgb8")
        shown = graph.page.locator("img[src^='blob:']")
        shown.first.wait_for()
        assert panel.views[0].image.image[0, 0].tolist() == [250, 10, 20]
        graph.click("Another topic")
        packed = io.BytesIO()
        Image.new("RGB", (6, 2), (10, 250, 20)).save(packed, "PNG")
        graph.say("/packed", "sensor_msgs/CompressedImage", format="png", data=packed.getvalue())
        panel.use(["/packed"])
        graph.wait_text("6 x 2, png")
        until(lambda: shown.count() == 2)
        assert set(panel.settings["topics"]) == {"/camera", "", "/packed"}
        graph.say("/packed", "sensor_msgs/CompressedImage", format="png", data=b"none")
        graph.wait_text("cannot")


def test_controllers_are_started_and_stopped(graph):
    names = controller_manager_msgs.srv
    arm = message("controller_manager_msgs/ControllerState", name="arm", state="stopped", type="t")

    def switch(asked):
        arm.state = "running" if asked.start_controllers == ["arm"] else "stopped"
        return {"ok": asked.strictness == 2}

    servers = [
        graph.node.serve("/cm/list_controllers", names.ListControllers, lambda _: {"controller": [arm]}),
        graph.node.serve("/cm/switch_controller", names.SwitchController, switch),
    ]  # fmt: skip
    with opened_panel(graph, "Controller manager"):
        row = graph.page.locator("tr", has_text="arm")
        row.wait_for()
        graph.choose("Controller", "arm")
        graph.click("Start")
        until(lambda: "running" in row.inner_text())
        graph.click("Stop")
        until(lambda: "stopped" in row.inner_text())
    for server in servers:
        server.close()


def test_joints_are_moved_by_trajectories(graph):
    got = []
    graph.node.subscribe(
        "/arm/command", type(message("trajectory_msgs/JointTrajectory")), got.append
    )
    actual = message("trajectory_msgs/JointTrajectoryPoint", positions=[0.25, -0.5])
    graph.say("/arm/state", "control_msgs/JointTrajectoryControllerState",
              joint_names=["shoulder", "elbow"], actual=actual)  # fmt: skip
    until(lambda: not graph.view._context.robots)
    with opened_panel(graph, "Joint trajectory") as panel:
        graph.choose("Controller", "/arm")
        until(
            lambda: graph.box("elbow").count() == 1 and graph.box("elbow").input_value() == "-0.5"
        )
        until(lambda: panel._publisher.num_connections)
        graph.page.get_by_label("Send").click()
        graph.fill("shoulder", "1.25")
        until(lambda: len(got) >= 1)
        assert got[-1].joint_names == ["shoulder", "elbow"]
        (point,) = got[-1].points
        assert list(point.positions) == [1.25, -0.5]
        assert point.time_from_start.to_sec() == pytest.approx(2.0)  # 1 rad at 0.5 rad/s


def test_enumerations_are_read():
    method = "{'enum': [{'name': 'Low', 'value': 0}, {'name': 'High', 'value': 1}]}"
    assert choices_of(method) == {"Low": 0, "High": 1}
    assert choices_of("") == choices_of("{'enum'") == choices_of("[1]") == {}


def test_layouts_of_diagrams_lead_downwards():
    from gazelle.viewer.graph.panels.diagram import DiagramBox, diagram, layers_of

    arrows = [("a", "b", ""), ("b", "c", ""), ("a", "c", ""), ("d", "c", ""), ("c", "c", "")]
    layers = layers_of(list("abcd"), arrows)
    assert layers == [["a", "d"], ["b"], ["c"]]
    picture = diagram({each: DiagramBox((f"<{each}>",)) for each in "abcd"}, arrows)
    assert re.findall("&lt;(.)&gt;", picture) == list("abcd")
    assert layers_of([], []) == []
    assert diagram({}, []).startswith("<svg")
