"""A ROS graph is shown: its robots where tf says, and what topics carry."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")


from gazelle.errors import Error
from gazelle.viewer.graph import GraphView
from gazelle.viewer.graph.drawing import points_of, rainbow
from gazelle.viewer.graph.motions import motion_of, robot_of
from gazelle.viewer.graph.pointing import nearest_on_ray
from gazelle_ros import Master, Node, Time, WallClock, load_message
from gazelle_ros.tf import take_transforms
from tests.ros.graph import until

BODY = '<visual><geometry><box size="1 1 1"/></geometry></visual><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
URDF = (
    f'<robot name="r"><link name="base_link">{BODY}</link><link name="tip">{BODY}</link>'
    '<joint name="j" type="revolute"><parent link="base_link"/><child link="tip"/>'
    '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>'
)


@pytest.fixture
def master():
    with Master("127.0.0.1", 0) as running:
        yield running


@pytest.fixture
def node(master):
    made = Node("talker", master_uri=master.uri, clock=WallClock())
    yield made
    made.close()


@pytest.fixture
def view(master, node):
    node.set_param("/robot_description", URDF)
    with GraphView(master.uri) as made:
        yield made


def message(kind, **fields):
    return load_message(kind)(**fields)


def transform(parent, child, x=0.0, y=0.0):
    made = message("geometry_msgs/TransformStamped")
    made.header.frame_id, made.child_frame_id = parent, child
    made.header.stamp = Time.from_sec(1.0)
    made.transform.translation.x, made.transform.translation.y = x, y
    made.transform.rotation.w = 1.0
    return made


def say(node, view, topic, sent, latch=True):
    """Publish once for all who come, and wait until the view has drawn it."""
    node.advertise(topic, type(sent), 1, latch=latch).publish(sent)

    def drawn():
        view._discover()
        display = view._displays.topics.get(topic)
        came = display is not None and display.arrivals.count > 0
        view._picture()
        return came

    until(drawn)
    return view._displays.topics[topic].drawing


def on_frame(kind, frame, **fields):
    made = message(kind, **fields)
    made.header.frame_id = frame
    return made


def put_frames(node, view, **places):
    frames = [transform("map", name, *place) for name, place in places.items()]
    sent = message("tf2_msgs/TFMessage", transforms=frames)
    publisher = node.advertise("/tf", type(sent), 10, latch=True)
    publisher.publish(sent)
    until(lambda: all(view._context.tree.has(name) for name in places))


def test_robots_stand_where_tf_says(node, view):
    put_frames(node, view, base_link=(1.0, 2.0), tip=(1.0, 5.0))
    view._discover()
    view._picture()
    (robot,) = view._displays.robots.values()
    (batch,) = robot._batches._batches
    assert batch.handle.batched_positions[:, :2].tolist() == [[1.0, 2.0], [1.0, 5.0]]
    put_frames(node, view, base_link=(1.0, 3.0))
    node.set_param("/robot_description", URDF.replace("1 1 1", "2 2 2"))
    view._discover()
    assert next(iter(view._displays.robots.values())) is not robot
    node.set_param("/robot_description", "<robot")
    view._discover()
    assert "robot_description" in view._faults.content
    node.delete_param("/robot_description")
    view._discover()
    assert "robot_description" not in view._faults.content


def test_a_robot_is_switched_off_and_a_layout_keeps_it(node, view):
    put_frames(node, view, base_link=(1.0, 2.0))
    view._discover()
    displays = view._displays
    displays._switches["/robot_description"].value = False
    view._picture()
    (robot,) = displays.robots.values()
    assert robot.extent is None
    assert not robot._batches._batches[0].handle.visible
    saved = displays.settings
    displays._switches["/robot_description"].value = True
    view._picture()
    assert robot.extent is not None
    displays.restore(saved)
    assert not robot.shown


def test_a_robot_that_tf_does_not_know_is_named(node, view):
    view._discover()
    view._picture()
    view._discover()
    expected = "/robot_description: no transform from any of its links to map"
    assert expected in view._faults.content
    put_frames(node, view, tip=(1.0, 2.0))
    view._picture()
    view._discover()
    assert expected not in view._faults.content


def test_links_that_tf_does_not_know_go_along(node, view):
    put_frames(node, view, base_link=(1.0, 2.0))
    view._discover()
    view._picture()
    (batch,) = next(iter(view._displays.robots.values()))._batches._batches
    assert batch.handle.batched_positions[:, :2].tolist() == [[1.0, 2.0], [1.0, 2.0]]


def test_scans_clouds_maps_paths_and_poses_are_drawn_in_their_frames(node, view):
    put_frames(node, view, laser=(1.0, 0.0))
    scan = on_frame("sensor_msgs/LaserScan", "laser", angle_min=0.0, angle_increment=np.pi / 2)
    scan.range_min, scan.range_max, scan.ranges = 0.1, 5.0, [2.0, 3.0, float("inf"), 0.01]
    drawn = say(node, view, "/scan", scan)
    assert drawn.part("points").points == pytest.approx(np.array([[2, 0, 0], [0, 3, 0]]), abs=1e-6)
    assert view._displays.topics["/scan"].anchor.position.tolist() == [1.0, 0.0, 0.0]
    lost = on_frame("geometry_msgs/PoseStamped", "nowhere")
    say(node, view, "/goal", lost)
    assert view._displays.topics["/scan"].anchor.visible
    assert not view._displays.topics["/goal"].anchor.visible
    view._discover()
    assert "/goal: no transform from nowhere to map" in view._faults.content
    assert "/scan: no transform" not in view._faults.content
    put_frames(node, view, nowhere=(0.0, 1.0))
    view._picture()
    view._discover()
    assert view._displays.topics["/goal"].anchor.visible
    assert "/goal: no transform" not in view._faults.content

    grid = on_frame("nav_msgs/OccupancyGrid", "map", data=[0, 100, -1, 0, 50, 0])
    grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 0.5
    grid.info.origin.position.x = -2.0
    shown = say(node, view, "/map", grid).part("map")
    assert shown.position == pytest.approx([-2.0, 0.0, -0.005])

    path = on_frame("nav_msgs/Path", "map")
    for x in (0.0, 1.0, 3.0):
        pose = message("geometry_msgs/PoseStamped")
        pose.pose.position.x = x
        path.poses.append(pose)
    lines = say(node, view, "/plan", path).part("path")
    assert lines.points[:, :, 0].tolist() == [[0, 1], [1, 3]]

    odometry = on_frame("nav_msgs/Odometry", "map")
    odometry.pose.pose.position.y = 4.0
    axes = say(node, view, "/odom", odometry).part("axes")
    assert axes.batched_positions.tolist() == [[0, 4, 0]]


def test_clicks_pick_drawn_points_before_the_ground(node, view):
    put_frames(node, view, laser=(1.0, 0.0))
    scan = on_frame("sensor_msgs/LaserScan", "laser", angle_min=0.0, angle_increment=np.pi / 2)
    scan.range_max, scan.ranges = 9.0, [2.0, 3.0]
    say(node, view, "/scan", scan)
    view._picture()
    assert view._displays.points == pytest.approx(np.array([[3, 0, 0], [1, 3, 0]]), abs=1e-6)
    origin, tools = np.array([3.0, 0.02, 4.0]), view._tools
    down = np.array([0.0, 0.0, -2.0])
    assert tools._pick(origin, down) is None
    tools.tool = "Publish Point"
    assert tools._pick(origin, down) == pytest.approx([3.0, 0.0, 0.0], abs=1e-6)
    assert tools._pick(origin, -down) is None
    assert tools._pick(np.array([3.0, 0.5, 4.0]), down) is None
    several = np.array([[3.0, 0.0, -1.0], [3.0, 0.05, 1.0], [3.0, 1.0, 2.0]])
    assert nearest_on_ray(origin, down, several).tolist() == [3.0, 0.05, 1.0]


def test_clouds_of_any_layout_are_read():
    fields = [
        message("sensor_msgs/PointField", name=name, offset=offset, datatype=7, count=1)
        for name, offset in (("x", 4), ("y", 8), ("z", 12), ("rgb", 16))
    ]
    rows = np.zeros((2, 3, 24), np.uint8)
    values = np.arange(18, dtype="<f4").reshape(2, 3, 3)
    rows[:, :, 4:16] = values.view(np.uint8).reshape(2, 3, 12)
    rows[:, :, 16:19] = [30, 20, 10]  # blue, green, red
    cloud = message("sensor_msgs/PointCloud2", height=2, width=3, fields=fields)
    cloud.point_step, cloud.row_step, cloud.data = 24, 72, rows.tobytes()
    points, colors = points_of(cloud)
    assert points.tolist() == values.reshape(6, 3).tolist()
    assert colors.tolist() == [[10, 20, 30]] * 6


@pytest.mark.parametrize(
    ("number", "kind"), [*enumerate(("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8"), 1)]
)
@pytest.mark.parametrize("order", "<>")
def test_clouds_are_coloured_by_intensities_of_any_type(number, kind, order):
    layout = np.dtype([(name, order + "f4") for name in "xyz"] + [("intensity", order + kind)])
    rows = np.zeros(3, layout)
    rows["x"], rows["intensity"] = [1.0, 2.0, 3.0], [20, 60, 100]
    fields = [
        message("sensor_msgs/PointField", name=name, offset=4 * k, datatype=7, count=1)
        for k, name in enumerate("xyz")
    ]
    fields.append(
        message("sensor_msgs/PointField", name="intensity", offset=12, datatype=number, count=1)
    )
    cloud = message("sensor_msgs/PointCloud2", height=1, width=3, fields=fields)
    cloud.point_step, cloud.row_step = layout.itemsize, 3 * layout.itemsize
    cloud.data, cloud.is_bigendian = rows.tobytes(), order == ">"
    points, colors = points_of(cloud)
    assert points[:, 0].tolist() == [1.0, 2.0, 3.0]
    assert colors.tolist() == [[0, 0, 255], [0, 255, 0], [255, 0, 0]]


def test_a_rainbow_needs_no_good_numbers():
    odd = rainbow(np.array([np.nan, 0.0, np.inf, 4.0, 1.0]))
    assert odd.tolist() == [[0, 0, 255], [0, 0, 255], [0, 0, 255], [255, 0, 0], [0, 255, 255]]
    assert rainbow(np.array([7.0, 7.0])).tolist() == [[0, 0, 255]] * 2
    assert rainbow(np.zeros(0)).shape == (0, 3)


@pytest.mark.parametrize("kind", [*range(10), 11])
def test_markers_of_every_type_come_and_go(node, view, kind):
    marker = on_frame("visualization_msgs/Marker", "map", ns="n", id=3, type=kind, text="hello")
    marker.scale.x = marker.scale.y = marker.scale.z = 0.5
    marker.color.r, marker.color.a = 1.0, 1.0
    marker.pose.orientation.w = 1.0
    marker.points = [message("geometry_msgs/Point", x=float(x)) for x in range(4)]
    markers = message("visualization_msgs/MarkerArray", markers=[marker])
    drawn = say(node, view, "/markers", markers)
    assert drawn.part("n_3") is not None
    gone = message("visualization_msgs/Marker", ns="n", id=3, action=2)
    view._displays.topics["/markers"].receive(
        message("visualization_msgs/MarkerArray", markers=[gone])
    )
    view._picture()
    assert drawn.part("n_3") is None


@pytest.mark.parametrize("embedded", [False, True])
def test_markers_show_mesh_files(node, view, tmp_path, monkeypatch, embedded):
    import trimesh

    box = trimesh.creation.box((1.0, 2.0, 3.0))
    box.visual.vertex_colors = np.tile([10, 200, 30, 255], (len(box.vertices), 1))
    folder = tmp_path / "things"
    folder.mkdir()
    (folder / "package.xml").write_text("<package><name>things</name></package>")
    (folder / "box.ply").write_bytes(box.export(file_type="ply"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    marker = on_frame("visualization_msgs/Marker", "map", ns="m", id=1, type=10)
    marker.mesh_resource = "package://things/box.ply"
    marker.mesh_use_embedded_materials = embedded
    marker.scale.x, marker.scale.y, marker.scale.z = 2.0, 1.0, 1.0
    marker.color.r = marker.color.a = marker.pose.orientation.w = 1.0
    put = []
    scene = view._context.server.viser.scene
    add = scene.add_mesh_trimesh
    monkeypatch.setattr(
        type(scene), "add_mesh_trimesh",
        lambda self, name, mesh, **place: (put.append(mesh), add(name, mesh, **place))[1],
    )  # fmt: skip
    say(node, view, "/mesh_marker", marker)
    (mesh,) = put
    assert np.ptp(mesh.vertices, axis=0).tolist() == [2.0, 2.0, 3.0]
    wanted = [10, 200, 30] if embedded else [255, 0, 0]
    assert np.abs(mesh.visual.face_colors[:, :3].astype(int) - wanted).max() <= 1


def test_triangles_have_their_colours():
    from gazelle.viewer.graph.markers import _triangles

    points = np.arange(21, dtype=float).reshape(7, 3)
    tones = np.arange(21, dtype=np.uint8).reshape(7, 3)
    color = message("std_msgs/ColorRGBA", r=1.0, a=1.0)
    mesh = _triangles(points, tones, color)
    assert len(mesh.faces) == 4  # two triangles, from both sides
    assert mesh.visual.vertex_colors[:, :3].tolist() == tones[:6].tolist()
    plain = _triangles(points, np.array([255, 0, 0], np.uint8), color)
    assert (plain.visual.vertex_colors == [255, 0, 0, 255]).all()


def plan_of(names, *rows, model="r", **start):
    """Return a DisplayTrajectory with a point every second."""
    part = message("moveit_msgs/RobotTrajectory")
    part.joint_trajectory.joint_names = list(names)
    for second, row in enumerate(rows):
        point = message("trajectory_msgs/JointTrajectoryPoint", positions=list(row))
        point.time_from_start.secs = second
        part.joint_trajectory.points.append(point)
    sent = message("moveit_msgs/DisplayTrajectory", model_id=model, trajectory=[part])
    sent.trajectory_start.joint_state.name = list(start)
    sent.trajectory_start.joint_state.position = list(start.values())
    return sent


def test_a_plan_is_shown_by_a_ghost_until_the_robot_has_made_it(node, view):
    put_frames(node, view, base_link=(1.0, 2.0), tip=(1.0, 2.0))
    say(node, view, "/move_group/display_planned_path", plan_of(["j"], [0.0], [1.0]))
    motion = view._displays.topics["/move_group/display_planned_path"].motion
    ghost = motion._ghost
    assert ghost.links == ("tip",)  # the base does not move
    assert ghost._frame.position.tolist() == [1.0, 2.0, 0.0]
    (batch,) = ghost._batches._batches
    turns = []
    for seconds in (0.0, 0.5, 1.5, 2.5):
        ghost.show(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), ghost._begun + seconds)
        turns.append(
            2.0 * np.arctan2(batch.handle.batched_wxyzs[0, 3], batch.handle.batched_wxyzs[0, 0])
        )
    assert turns == pytest.approx([0.0, 0.5, 1.0, 0.5], abs=0.06)  # it rests, and begins again
    assert not ghost.made
    there = transform("base_link", "tip")
    there.transform.rotation.z, there.transform.rotation.w = np.sin(0.5), np.cos(0.5)
    later = [transform("map", "base_link", 1.0, 2.0), there]
    for each in later:
        each.header.stamp = Time.from_sec(2.0)
    take_transforms(view._context.tree, message("tf2_msgs/TFMessage", transforms=later))
    view._picture()
    assert ghost.made
    assert not ghost._frame.visible
    say(node, view, "/move_group/display_planned_path", plan_of(["j"]))
    until(lambda: view._picture() or motion._ghost is None)


def test_plans_are_those_of_their_robots(node, view):
    node.set_param("/left/robot_description", URDF.replace('name="r"', 'name="l"'))
    node.set_param("/left/tf_prefix", "left")
    view._discover()
    robots = view._displays.robots
    assert robot_of("/move_group/plan", "r", robots) is robots["/robot_description"]
    assert robot_of("/move_group/plan", "l", robots) is robots["/left/robot_description"]
    assert robot_of("/left/move_group/plan", "", robots) is robots["/left/robot_description"]
    assert robot_of("/plan", "", {}) is None


def test_parts_of_a_plan_follow_each_other():
    sent = plan_of(["a", "b"], [0.0, 1.0], [2.0, 3.0], c=5.0)
    sent.trajectory += plan_of(["c"], [5.0], [6.0]).trajectory
    motion = motion_of(sent)
    assert motion.joints == ("a", "b", "c")
    assert motion.times.tolist() == [0.0, 1.0, 1.0, 2.0]
    assert motion.positions.tolist() == [[0, 1, 5], [2, 3, 5], [2, 3, 5], [2, 3, 6]]
    assert motion_of(plan_of([])) is None


@pytest.mark.parametrize(
    ("names", "row", "words"),
    [
        (["j"], [0.0, 1.0], "2 positions for 1 joints"),
        (["j"], [float("nan")], "not a number"),
        (["elsewhere"], [0.0], "none of the joints"),
    ],
)
def test_what_is_wrong_with_a_plan_is_said(node, view, names, row, words):
    put_frames(node, view, base_link=(1.0, 2.0))
    say(node, view, "/plan", plan_of(names, row))
    view._discover()
    view._picture()
    view._discover()
    assert words in view._faults.content


def test_a_bad_message_does_not_end_the_view(node, view, monkeypatch):
    monkeypatch.setattr(type(view._context.server), "watched", property(lambda _: True))
    view._context.server._changed.set()
    bad = message(
        "sensor_msgs/PointCloud2", height=1, width=9, point_step=4, row_step=36, data=b"x"
    )
    node.advertise("/cloud", type(bad), 1, latch=True).publish(bad)
    put_frames(node, view, base_link=(1.0, 2.0))
    until(lambda: "⚠ /cloud: a cloud of 9 x 1 points" in view._faults.content)
    until(lambda: "in **map**" in view._status.content)
    assert view._thread.is_alive()


def test_an_unknown_layout_or_panel_is_refused(view, tmp_path, monkeypatch):
    monkeypatch.setattr(view._layouts._files, "folder", tmp_path)
    (tmp_path / "robot.yaml").write_text("fixed_frame: /odom\ncamera: [1]\npanels: 3\n")
    view.load_layout("robot")
    assert view._context.requested_frame == "odom"
    for name, text in (("robt", "did you mean 'robot'"), ("../robot", "there is no layout")):
        with pytest.raises(Error, match=text):
            view.load_layout(name)
    (tmp_path / "list.yaml").write_text("- 1")
    with pytest.raises(Error, match="is not a mapping"):
        view.load_layout("list")
    with pytest.raises(Error, match="did you mean 'Plot'"):
        view.open_panel("Plod")


def test_it_leaves_the_graph_and_gives_the_port_back(master, node):
    with GraphView(master.uri) as view:
        assert not view.ended
    assert view.ended
    view.close()
    _, subscribers, _ = node.master.system_state()
    assert "gazelle_view" not in str(subscribers)
