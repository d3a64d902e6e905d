"""The camera plugins of Gazebo: names, encodings, lenses, triggers, depths and points."""

import math

import numpy as np
import pytest

import gazelle
from gazelle.errors import SimulationWarning
from gazelle.formats import load_string
from gazelle.simulation.values import Trigger

WORLD = """<sdf version="1.6"><world name="w">
<model name="red"><static>1</static><pose>3 0 0.5 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>1 1 1</size></box></geometry><material><ambient>1 0 0 1</ambient>
<diffuse>1 0 0 1</diffuse></material></visual></link></model>
<model name="robot"><static>1</static><pose>0 0 0.5 0 0 0</pose><link name="base">
<sensor type="{kind}" name="eye"><update_rate>10</update_rate>
<camera name="left"><horizontal_fov>1.0</horizontal_fov><image><width>32</width><height>24</height>
<format>{format}</format></image><clip><near>0.1</near><far>20</far></clip>
<distortion><k1>-0.1</k1><k2>0.02</k2><k3>0.003</k3><p1>0.004</p1><p2>0.005</p2></distortion>
</camera>{more}
<plugin name="p" filename="{file}"><robotNamespace>/ns</robotNamespace>
<cameraName>cam</cameraName><frameName>optical</frameName>{tags}</plugin>
</sensor></link></model></world></sdf>"""


def outputs(file, *, kind="camera", pixels="R8G8B8", tags="", more=""):
    text = WORLD.format(file=file, kind=kind, format=pixels, tags=tags, more=more)
    sim = gazelle.Simulation(load_string(text))
    return sim, sim.robots["robot"]


def heard(robot):
    """Return the received messages of each topic."""
    told = {}
    for output in robot.outputs.values():
        output.subscribe(lambda value, topic=output.topic: told.setdefault(topic, []).append(value))
    return told


def test_a_camera_tells_pictures_and_lens_at_one_moment():
    sim, robot = outputs("libgazebo_ros_camera.so")
    told = heard(robot)
    sim.run(0.25)
    assert set(told) == {
        "/ns/cam/image_raw",
        "/ns/cam/image_raw/compressed",
        "/ns/cam/camera_info",
    }
    for values in told.values():
        assert [value.stamp for value in values] == [100_000_000, 200_000_000]
    image = told["/ns/cam/image_raw"][0]
    assert (image.encoding, image.pixels.shape) == ("rgb8", (1, 24, 32, 3))
    assert robot.outputs["cam/image_raw"].frame == "optical"


def test_nothing_is_drawn_while_nobody_listens():
    sim, robot = outputs("libgazebo_ros_camera.so")
    sim.run(0.25)
    assert not robot.sensors["eye"].awake


def test_the_lens_is_that_of_the_tags_or_of_the_file():
    _, robot = outputs("libgazebo_ros_camera.so")
    info = robot.outputs["cam/camera_info"].last
    assert info.focal_length == pytest.approx(32 / (2 * math.tan(0.5)))
    assert info.center == (16.5, 12.5)
    assert info.distortion == (0.0,) * 5
    tags = (
        "<Cx>10</Cx><Cy>11</Cy><focalLength>40</focalLength><hackBaseline>0.07</hackBaseline>"
        "<distortionK1>0.1</distortionK1><distortionK2>0.2</distortionK2>"
        "<distortionK3>0.3</distortionK3><distortionT1>0.4</distortionT1>"
        "<distortionT2>0.5</distortionT2>"
    )
    info = outputs("libgazebo_ros_camera.so", tags=tags)[1].outputs["cam/camera_info"].last
    assert (info.focal_length, info.center, info.baseline) == (40.0, (10.0, 11.0), 0.07)
    assert info.distortion == (0.1, 0.2, 0.4, 0.5, 0.3)
    tags = "<autoDistortion>true</autoDistortion>"
    info = outputs("libgazebo_ros_camera.so", tags=tags)[1].outputs["cam/camera_info"].last
    assert info.distortion == (-0.1, 0.02, 0.004, 0.005, 0.003)


def test_the_rate_of_the_plugin_slows_only_what_is_told_of_the_lens():
    sim, robot = outputs("libgazebo_ros_camera.so", tags="<updateRate>5</updateRate>")
    told = heard(robot)
    sim.run(0.65)
    assert len(told["/ns/cam/image_raw"]) == 6
    assert [v.stamp for v in told["/ns/cam/camera_info"]] == [10**8, 3 * 10**8, 5 * 10**8]


def test_topics_have_the_names_of_the_tags():
    tags = "<imageTopicName>a/b</imageTopicName><cameraInfoTopicName>/lens</cameraInfoTopicName>"
    _, robot = outputs("libgazebo_ros_camera.so", tags=tags)
    topics = {output.topic for output in robot.outputs.values()}
    assert topics == {"/ns/cam/a/b", "/ns/cam/a/b/compressed", "/lens"}


@pytest.mark.parametrize(
    ("name", "encoding", "shape", "kind"),
    [
        ("L8", "mono8", (24, 32), np.uint8),
        ("L_INT16", "mono16", (24, 32), np.uint16),
        ("RGB_INT8", "rgb8", (24, 32, 3), np.uint8),
        ("B8G8R8", "bgr8", (24, 32, 3), np.uint8),
        ("R16G16B16", "rgb16", (24, 32, 3), np.uint16),
        ("BAYER_RGGB8", "bayer_rggb8", (24, 32), np.uint8),
        ("BAYER_GBRG8", "bayer_gbrg8", (24, 32), np.uint8),
    ],
)
def test_formats_become_encodings(name, encoding, shape, kind):
    _, robot = outputs("libgazebo_ros_camera.so", pixels=name)
    image = robot.outputs["cam/image_raw"].last
    seen = robot.sensors["eye"].reading(robot.sensors["eye"].current()).color[0]
    assert image.encoding == encoding
    assert image.pixels.shape == (1, *shape)
    assert image.pixels.dtype == kind
    pixel = seen[12, 16]
    wanted = {
        "rgb8": pixel,
        "bgr8": pixel[::-1],
        "rgb16": pixel.astype(int) * 257,
        "bayer_rggb8": pixel[0],
        "bayer_gbrg8": pixel[1],
        "mono8": round(0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2]),
        "mono16": round(0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2]) * 257,
    }
    assert np.array_equal(image.pixels[0][12, 16], wanted[encoding])


def test_a_format_that_is_not_known_is_bgr8_as_in_gazebo():
    with pytest.warns(SimulationWarning, match="'YUYV'.*bgr8"):
        _, robot = outputs("libgazebo_ros_camera.so", pixels="YUYV")
    assert robot.outputs["cam/image_raw"].last.encoding == "bgr8"


def test_a_triggered_camera_tells_one_picture_for_each_trigger():
    sim, robot = outputs("libgazebo_ros_triggered_camera.so")
    told = heard(robot)
    sim.run(0.35)
    assert told == {}
    trigger = robot.inputs["image_trigger"]
    assert trigger.topic == "/ns/cam/image_trigger"
    trigger.send(Trigger())
    sim.run(0.5)
    assert len(told["/ns/cam/image_raw"]) == len(told["/ns/cam/camera_info"]) == 1
    trigger.send(Trigger())
    trigger.send(Trigger())
    sim.run(0.5)
    stamps = [value.stamp for value in told["/ns/cam/image_raw"]]
    assert len(stamps) == 3
    assert stamps == [value.stamp for value in told["/ns/cam/camera_info"]]


RIGHT = """<camera name="my_right_eye"><pose>0 -0.1 0 0 0 0</pose><horizontal_fov>1.0
</horizontal_fov><image><width>32</width><height>24</height></image></camera>"""


def test_several_cameras_tell_under_their_sides_at_one_moment():
    sim, robot = outputs("libgazebo_ros_multicamera.so", kind="multicamera", more=RIGHT)
    told = heard(robot)
    sim.run(0.15)
    left, right = told["/ns/cam/left/image_raw"], told["/ns/cam/right/image_raw"]
    assert left[0].stamp == right[0].stamp
    assert not np.array_equal(left[0].pixels, right[0].pixels)


DEPTHS = ["libgazebo_ros_depth_camera.so", "libgazebo_ros_openni_kinect.so"]


@pytest.mark.parametrize("file", DEPTHS)
def test_depths_and_points_agree(file):
    sim, robot = outputs(file, kind="depth")
    told = heard(robot)
    sim.run(0.15)
    assert set(told) == {
        "/ns/cam/ir/image_raw",
        "/ns/cam/ir/image_raw/compressed",
        "/ns/cam/ir/camera_info",
        "/ns/cam/depth/image_raw",
        "/ns/cam/depth/camera_info",
        "/ns/cam/points",
    }
    assert {value.stamp for values in told.values() for value in values} == {100_000_000}
    depth, points = told["/ns/cam/depth/image_raw"][0], told["/ns/cam/points"][0].points[0]
    assert depth.encoding == "32FC1"
    assert depth.pixels[0, 12, 16] == pytest.approx(2.5, abs=1e-4)
    assert np.isnan(depth.pixels[0, 0, 0])
    assert np.array_equal(points[..., 2], depth.pixels[0], equal_nan=True)
    # The box is 1 m wide and 2.5 m away, seen face on.
    front = points[np.abs(points[..., 2] - 2.5) < 1e-3]
    pixel = 2.5 / (32 / (2 * math.tan(0.5)))
    assert np.ptp(front[:, 0]) == pytest.approx(1.0, abs=2 * pixel)
    assert np.abs(front[:, 0]).max() <= 0.5 + pixel


@pytest.mark.parametrize("file", DEPTHS)
def test_what_is_too_near_or_too_far_is_not_told(file):
    near = "<pointCloudCutoff>2.6</pointCloudCutoff>"
    _, robot = outputs(file, kind="depth", tags=near)
    assert np.isnan(robot.outputs["cam/depth/image_raw"].last.pixels).all()
    far = "<pointCloudCutoffMax>2.0</pointCloudCutoffMax>"
    _, robot = outputs(file, kind="depth", tags=far)
    hidden = np.isnan(robot.outputs["cam/depth/image_raw"].last.pixels).all()
    assert hidden == ("kinect" in file)


def test_depths_may_be_millimetres():
    tags = "<useDepth16UC1Format>true</useDepth16UC1Format>"
    _, robot = outputs(DEPTHS[0], kind="depth", tags=tags)
    depth = robot.outputs["cam/depth/image_raw"].last
    assert (depth.encoding, depth.pixels.dtype) == ("16UC1", np.uint16)
    assert depth.pixels[0, 12, 16] in (2499, 2500)
    assert depth.pixels[0, 0, 0] == 0


@pytest.mark.parametrize(
    ("file", "kind", "words"),
    [
        (DEPTHS[0], "camera", "needs a sensor of type depth"),
        ("libgazebo_ros_camera.so", "ray", "needs a sensor of type camera"),
    ],
)
def test_a_plugin_on_a_sensor_of_another_kind_is_told(file, kind, words):
    text = WORLD.format(file=file, kind=kind, format="L8", tags="", more="<ray></ray>")
    with pytest.warns(SimulationWarning, match=words):
        gazelle.Simulation(load_string(text))


def test_only_the_right_camera_of_a_pair_is_a_baseline_away():
    tags = "<hackBaseline>0.07</hackBaseline>"
    sim, robot = outputs("libgazebo_ros_multicamera.so", kind="multicamera", more=RIGHT, tags=tags)
    told = heard(robot)
    sim.run(0.15)
    assert told["/ns/cam/left/camera_info"][0].baseline == 0.0
    assert told["/ns/cam/right/camera_info"][0].baseline == 0.07


def test_each_camera_of_a_triggered_pair_has_a_trigger_of_its_own():
    sim, robot = outputs("libgazebo_ros_triggered_multicamera.so", kind="multicamera", more=RIGHT)
    told = heard(robot)
    sim.run(0.15)
    assert not told
    trigger = robot.inputs["right/image_trigger"]
    assert trigger.topic == "/ns/cam/right/image_trigger"
    trigger.send(Trigger())
    sim.run(0.3)
    assert set(told) == {
        f"/ns/cam/right/{name}" for name in ("image_raw", "image_raw/compressed", "camera_info")
    }
    assert len(told["/ns/cam/right/image_raw"]) == 1


@pytest.mark.parametrize(
    ("file", "kind"),
    [
        ("libgazebo_ros_thermal_camera.so", "camera"),
        ("libgazebo_ros_thermal_depth_camera.so", "depth"),
    ],
)
@pytest.mark.parametrize(("emissive", "warmth"), [("1 0 0", 255), ("1 0.4 0", (255 + 102) // 8)])
def test_pure_red_is_hot(file, kind, emissive, warmth):
    text = WORLD.format(file=file, kind=kind, format="R8G8B8", tags="", more="")
    text = text.replace("<ambient>1 0 0 1</ambient>", f"<emissive>{emissive} 1</emissive>")
    text = text.replace("<diffuse>1 0 0 1</diffuse>", "<diffuse>0 0 0 1</diffuse>")
    sim = gazelle.Simulation(load_string(text))
    told = heard(sim.robots["robot"])
    sim.run(0.15)
    image = told["/ns/cam/image_raw"][0]
    assert image.encoding == "mono8"
    assert image.pixels[0, 12, 16] == pytest.approx(warmth, abs=1)
