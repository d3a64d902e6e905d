"""The page of a graph in a real browser: displays with status and style, frames, and tools."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from tests.ros.graph import until
from tests.viewer.graph_page import graph_page, message

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def graph(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CONFIG_HOME", str(tmp_path_factory.mktemp("config")))
        with graph_page() as made:
            fill_graph(made)
            yield made


def fill_graph(made):
    made.say_frames(odom=(0.0, 0.0), laser=(1.0, 0.0))
    made.say("/scan", "sensor_msgs/LaserScan", "laser", range_max=9.0, angle_min=-3.1,
             angle_increment=0.1, ranges=[2.0] * 62)  # fmt: skip


def middle(found):
    """Return the middle of true pixels, (x, y), or None for fewer than 30."""
    rows, columns = np.nonzero(found)
    return np.array([columns.mean(), rows.mean()]) if len(rows) >= 30 else None


def red(picture):
    return (picture[..., 0] > 150) & (picture[..., 1:].max(axis=-1) < 90)


def green(picture):
    return (picture[..., 1] > 130) & (picture[..., [0, 2]].max(axis=-1) < 90)


def blue(picture):
    return (picture[..., 2] > 150) & (picture[..., :2].max(axis=-1) < 90)


def test_the_view_fits_what_is_shown(graph):
    until(lambda: middle(red(graph.pixels())) is not None)
    graph.click("Fit view")

    def fits():
        rows, columns = np.nonzero(red(graph.pixels()))
        if len(rows) < 30:
            return False
        high, wide = graph.pixels().shape[:2]
        within = rows.min() > 5 and rows.max() < high - 5 and columns.min() > 5
        return within and np.ptp(columns) > 0.3 * wide

    until(fits)


def test_a_display_has_colour_size_and_a_switch(graph):
    until(lambda: middle(red(graph.pixels())) is not None)
    graph.page.get_by_text("/scan", exact=True).click()
    box = graph.page.locator("input.mantine-ColorInput-input").first
    box.fill("rgb(10, 20, 250)")
    box.press("Enter")
    until(lambda: middle(blue(graph.pixels())) is not None and middle(red(graph.pixels())) is None)
    thin = blue(graph.pixels()).sum()
    size = graph.page.get_by_role("textbox", name="Points [m]")
    size.fill("0.2")
    size.press("Enter")
    until(lambda: blue(graph.pixels()).sum() > 2 * thin)
    graph.page.get_by_label("Shown").click()
    until(lambda: middle(blue(graph.pixels())) is None)
    graph.page.get_by_label("Shown").click()
    until(lambda: middle(blue(graph.pixels())) is not None)
    graph.page.get_by_text("/scan", exact=True).click()


def test_frames_are_axes_with_names(graph):
    before = graph.pixels()
    graph.page.get_by_role("checkbox", name="Frames").click()
    frames = graph.view._displays._frames
    until(lambda: "laser" in frames._labels)
    assert frames._labels["laser"].position.tolist() == [1.0, 0.0, 0.0]
    assert {"map", "odom"} in [set(text.split("\n")) for text in frames._labels]  # at one place
    number = frames._names.index("laser")
    assert frames._axes.batched_positions[number].tolist() == [1.0, 0.0, 0.0]
    until(lambda: (np.abs(graph.pixels() - before).max(axis=-1) > 60).sum() > 100)
    graph.page.get_by_role("checkbox", name="Frames").click()
    until(lambda: frames._axes is None)


def test_the_fixed_frame_is_chosen_on_the_page(graph):
    graph.choose("Fixed frame", "laser")
    until(lambda: "in **laser**" in graph.view._status.content)
    anchor = graph.view._displays.topics["/scan"].anchor
    until(lambda: anchor.position.tolist() == [0.0, 0.0, 0.0])
    graph.choose("Fixed frame", "automatic")
    until(lambda: anchor.position.tolist() == [1.0, 0.0, 0.0])


def test_goals_and_estimates_are_dragged(graph):
    for tool, topic, kind in (
        ("2D Nav Goal", "/move_base_simple/goal", "geometry_msgs/PoseStamped"),
        ("2D Pose Estimate", "/initialpose", "geometry_msgs/PoseWithCovarianceStamped"),
    ):
        got = graph.heard(topic, kind)
        graph.choose("Tool", tool)
        graph.wait_text("and drag to where it")
        graph.drag((220, 280), (320, 280))
        until(lambda got=got: len(got) == 1)
        (sent,) = got
        assert sent.header.frame_id == "map"
        pose = sent.pose.pose if hasattr(sent.pose, "pose") else sent.pose
        # The camera looks along (0.45, 0.6): right of it is (0.8, -0.6).
        yaw = 2.0 * np.arctan2(pose.orientation.z, pose.orientation.w)
        assert yaw == pytest.approx(np.arctan2(-0.45, 0.6), abs=0.2)
        graph.wait_text(f"Sent to {topic}")
        assert graph.view._tools.tool == "Move camera"
    assert sent.pose.covariance[0] == 0.25


def test_points_are_published_and_distances_measured(graph):
    got = graph.heard("/clicked_point", "geometry_msgs/PointStamped")
    graph.choose("Tool", "Publish Point")
    graph.wait_text("Click on a point")
    graph.page.mouse.click(260, 280)
    until(lambda: len(got) == 1)
    assert got[0].header.frame_id == "map"
    assert got[0].point.z == pytest.approx(0.0, abs=1e-9)
    graph.choose("Tool", "Measure")
    graph.wait_text("Drag from one point")
    graph.drag((180, 300), (380, 300))
    until(lambda: graph.view._tools._hint.content.endswith("m**"))
    assert float(graph.view._tools._hint.content.strip("*m ")) > 0.5
    graph.choose("Tool", "Move camera")


def test_displays_are_removed_and_added_by_hand(graph):
    topics = graph.view._displays.topics
    graph.say("/spot", "geometry_msgs/PointStamped", "map")
    graph.page.get_by_text("/spot", exact=True).click()
    graph.click("Remove")
    until(lambda: "/spot" not in topics)
    graph.page.get_by_text("Add", exact=True).click()
    graph.choose("By topic", "/spot")
    until(lambda: "/spot" in topics)
    graph.choose("By type", "nav_msgs/Path")
    graph.fill("Its topic", "/later")
    graph.click("Add display")
    graph.wait_text("/later: it has no publisher")
    poses = [message("geometry_msgs/PoseStamped") for _ in range(2)]
    poses[1].pose.position.x = 1.0
    graph.say("/later", "nav_msgs/Path", "map", poses=poses)
    until(lambda: topics["/later"].drawing.part("path") is not None)
    graph.page.get_by_text("Add", exact=True).click()


def test_layouts_are_saved_and_loaded(graph):
    view = graph.view
    topics = view._displays.topics
    until(lambda: "/scan" in topics)
    view._displays.remove("/spot")
    view._displays.add("/never", "nav_msgs/Path")
    until(lambda: "/never" in topics and "/spot" not in topics)
    scan = view._displays.topics["/scan"]
    scan.restyle((10, 200, 20), 0.1)
    graph.choose("Open panel", "Plot")
    until(lambda: view._panels.titles == ["Plot"])
    view._panels.panel("Plot").use(["/speed/data"])
    graph.choose("Fixed frame", "laser")
    graph.page.get_by_text("Layout", exact=True).click()
    graph.fill("Name", "my robot")
    graph.click("Save")
    until(lambda: view._layouts._files.names == ["my robot"])
    scan.restyle((10, 20, 250), 0.02)
    view._displays.remove("/never")
    view._displays.add("/spot", "geometry_msgs/PointStamped")
    until(lambda: "/spot" in topics and "/never" not in topics)
    graph.choose("Fixed frame", "automatic")
    graph.click("Close")
    until(lambda: view._panels.titles == [])
    graph.choose("Load", "my robot")
    until(lambda: view._panels.titles == ["Plot"])
    until(lambda: "/never" in topics and "/spot" not in topics)
    until(lambda: view._panels.panel("Plot").settings["fields"] == ["/speed/data"])
    until(lambda: view._context.requested_frame == "laser")
    until(lambda: (scan.drawing.style.color, scan.drawing.style.size) == ((10, 200, 20), 0.1))
    until(lambda: middle(green(graph.pixels()[:, 460:])) is not None)
    graph.fill("Name", "../elsewhere")
    graph.click("Save")
    graph.wait_text("This cannot be done")
