"""Interactive markers are seen, moved and clicked on the page of a graph."""

import math

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.viewer.graph.interactive.marker import allowed
from tests.ros.graph import until
from tests.viewer.graph_page import graph_page, message

UP = {"w": math.sqrt(0.5), "y": math.sqrt(0.5)}  # turns x to z
SIDE = {"w": math.sqrt(0.5), "z": math.sqrt(0.5)}  # turns x to y


def control(mode, orientation, *markers, name="c"):
    made = message("visualization_msgs/InteractiveMarkerControl", name=name, interaction_mode=mode)
    for key, value in orientation.items():
        setattr(made.orientation, key, value)
    made.markers = list(markers)
    return made


@pytest.mark.parametrize(
    ("controls", "moves", "turns"),
    [
        ([(3, {"w": 1.0})], "x", ""),
        ([(3, SIDE), (5, UP)], "y", "z"),
        ([(4, UP)], "xy", ""),
        ([(6, UP)], "xy", "z"),
        ([(7, {}), (8, {})], "xyz", "xyz"),
        ([(9, {})], "xyz", "xyz"),
        ([(2, {}), (1, {})], "", ""),
    ],
)
def test_modes_of_controls_are_motions(controls, moves, turns):
    found = allowed([control(mode, turn) for mode, turn in controls])
    named = [
        "".join(name for name, flag in zip("xyz", axes, strict=True) if flag) for axes in found
    ]
    assert named == [moves, turns]


def box(red):
    made = message("visualization_msgs/Marker", type=1, id=int(red))
    made.scale.x = made.scale.y = made.scale.z = 1.0
    made.color.r, made.color.g, made.color.a = (1.0, 0.0, 1.0) if red else (0.0, 0.6, 1.0)
    made.pose.orientation.w = 1.0
    return made


def interactive(name, x, *controls):
    made = message("visualization_msgs/InteractiveMarker", name=name, scale=2.0)
    made.header.frame_id, made.pose.position.x, made.pose.orientation.w = "map", x, 1.0
    made.controls = list(controls)
    return made


def red_middle(picture):
    rows, columns = np.nonzero((picture[..., 0] > 120) & (picture[..., 1:].max(axis=-1) < 80))
    return (columns.mean(), rows.mean()) if len(rows) > 30 else None


def on_screen(graph, camera, point):
    """Return where a point of the scene is on the page, in pixels."""
    forward = np.subtract(camera.look_at, camera.position)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    away = np.subtract(point, camera.position)
    depth = away @ forward * math.tan(camera.fov / 2.0)
    box = graph.page.locator("canvas").first.bounding_box()
    half = box["height"] / 2.0
    x, y = away @ right / depth, away @ np.cross(right, forward) / depth
    return box["x"] + box["width"] / 2.0 + x * half, box["y"] + half - y * half


@pytest.mark.long
def test_markers_are_clicked_moved_by_their_server_and_erased():
    with graph_page() as graph:
        graph.say_frames(map2=(0.0, 0.0))
        button = interactive("go", 0.0, control(2, {}, box(red=True), name="press"))
        knob = interactive("knob", 3.0, control(6, UP, box(red=False)))
        graph.say("/menu/update_full", "visualization_msgs/InteractiveMarkerInit",
                  server_id="s", seq_num=1, markers=[button, knob])  # fmt: skip
        servers = graph.view._interactive._servers
        until(lambda: "/menu" in servers and set(servers["/menu"].markers) == {"go", "knob"})
        got = graph.heard("/menu/feedback", "visualization_msgs/InteractiveMarkerFeedback")
        until(lambda: red_middle(graph.pixels()) is not None)
        graph.page.mouse.click(*red_middle(graph.pixels()))
        until(lambda: got)
        assert (got[0].marker_name, got[0].control_name, got[0].event_type) == ("go", "press", 3)
        assert got[0].header.frame_id == "map"

        shown = servers["/menu"].markers["knob"]
        assert {name.rpartition("/")[2] for name in shown._gizmos} == {"move", "turn2"}
        del got[:]
        (client,) = graph.view._context.page.get_clients().values()
        tip = on_screen(graph, client.camera, (4.0, 0.0, 0.0))
        graph.drag(tip, on_screen(graph, client.camera, (5.0, 0.0, 0.0)))
        until(lambda: got and got[-1].event_type == 5)
        assert got[0].event_type == 4
        assert {each.marker_name for each in got} == {"knob"}
        assert got[-1].pose.position.x == pytest.approx(4.0, abs=0.15)
        assert got[-1].pose.position.y == pytest.approx(0.0, abs=1e-3)
        assert shown._body.position[0] == pytest.approx(got[-1].pose.position.x)

        moved = message("visualization_msgs/InteractiveMarkerPose", name="go")
        moved.header.frame_id, moved.pose.position.y = "map", -2.0
        before = red_middle(graph.pixels())
        graph.say("/menu/update", "visualization_msgs/InteractiveMarkerUpdate", server_id="s",
                  seq_num=2, type=1, poses=[moved], latch=False)  # fmt: skip

        def elsewhere():
            now = red_middle(graph.pixels())
            return now is not None and np.hypot(*np.subtract(now, before)) > 20

        until(elsewhere)
        graph.say("/menu/update", "visualization_msgs/InteractiveMarkerUpdate", server_id="s",
                  seq_num=3, type=1, erases=["go"])  # fmt: skip
        until(lambda: red_middle(graph.pixels()) is None)
