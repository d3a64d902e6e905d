"""The RealSense plugin: four cameras of one model under its names."""

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.errors import PluginWarning

SENSOR = """<sensor name='{}' type='{}'><update_rate>30</update_rate><camera>
<horizontal_fov>1.2</horizontal_fov><image><width>64</width><height>48</height>
<format>{}</format></image></camera></sensor>"""
ROBOT = """<sdf version='1.6'><model name='r'><static>true</static><link name='l'>
<pose>0 0 0.5 0 0 0</pose>{}</link>
<plugin name='{}' filename='librealsense_gazebo_plugin.so'>{}</plugin></model></sdf>"""
WALL = """<sdf version='1.6'><world name='w'><light name='s' type='directional'/>
<model name='wall'><static>true</static><pose>3 0 0 0 0 0</pose><link name='l'>
<collision name='c'><geometry><box><size>0.2 9 9</size></box></geometry></collision>
<visual name='v'><geometry><box><size>0.2 9 9</size></box></geometry></visual>
</link></model></world></sdf>"""
KINDS = {"color": ("camera", "R8G8B8"), "ired1": ("camera", "L8"), "ired2": ("camera", "L8"), "depth": ("depth", "R8G8B8")}  # fmt: skip


def robot(tags="", parts=tuple(KINDS), prefix="front_", name="front"):
    sensors = "".join(SENSOR.format(prefix + part, *KINDS[part]) for part in parts)
    tags = f"<prefix>{prefix}</prefix>{tags}" if prefix else tags
    return formats.load_model_string(ROBOT.format(sensors, name, tags))


def seen_by(model):
    """Return the messages of each topic, by its name."""
    found = {}
    with gazelle.Simulation(formats.load_string(WALL)) as sim:
        spawned = sim.spawn(model, namespace="/")
        for output in spawned.outputs.values():
            output.subscribe(lambda value, output=output: found.setdefault(output.topic, value))
        sim.run(seconds=0.1)
        frames = {output.topic: output.frame for output in spawned.outputs.values()}
    return found, frames


@pytest.mark.long
def test_all_cameras_publish_below_the_plugins_name():
    found, frames = seen_by(robot("<pointCloud>true</pointCloud>"))
    pictures = {topic: value.encoding for topic, value in found.items() if topic.endswith("raw")}
    assert pictures == {
        "/front/color/image_raw": "rgb8",
        "/front/infra1/image_raw": "8UC1",
        "/front/infra2/image_raw": "8UC1",
        "/front/depth/image_raw": "16UC1",
    }
    depth = found["/front/depth/image_raw"].pixels
    middle = int(np.asarray(depth).reshape(48, 64)[20, 32])
    assert middle == pytest.approx(2900, abs=30)
    points = found["/front/depth/color/points"].points.reshape(48, 64, 3)
    assert points[20, 32, 2] == pytest.approx(2.9, abs=0.03)
    assert {f"/front/{part}/camera_info" for part in ("color", "infra1", "infra2", "depth")} <= {
        *found
    }
    assert frames["/front/color/image_raw"] == "color_optical_frame"


@pytest.mark.long
def test_names_frames_and_limits_are_those_of_the_file():
    tags = (
        "<depthTopicName>depth/image_rect_raw</depthTopicName>"
        "<depthOpticalframeName>front_depth</depthOpticalframeName>"
        "<rangeMaxDepth>2.0</rangeMaxDepth>"
    )
    found, frames = seen_by(robot(tags, parts=("depth",), prefix=""))
    assert frames["/front/depth/image_rect_raw"] == "front_depth"
    assert not np.any(found["/front/depth/image_rect_raw"].pixels)
    assert not any(topic.endswith("points") for topic in frames)


@pytest.mark.long
@pytest.mark.parametrize(
    ("tags", "depth", "point"),
    [
        ("<rangeMaxDepth>2.0</rangeMaxDepth>", 0, 2.9),
        ("<pointCloudCutoffMax>2.0</pointCloudCutoffMax>", 2900, np.nan),
        ("<pointCloudCutoff>3.5</pointCloudCutoff>", 2900, np.nan),
        ("<rangeMinDepth>3.5</rangeMinDepth><pointCloudCutoff>0.5</pointCloudCutoff>", 0, 2.9),
        ("<depthUpdateRate>1</depthUpdateRate>", 2900, 2.9),
    ],
)
def test_depths_and_points_have_limits_of_their_own(tags, depth, point):
    found, _ = seen_by(robot(f"<pointCloud>true</pointCloud>{tags}", parts=("depth",)))
    depths = np.asarray(found["/front/depth/image_raw"].pixels).reshape(48, 64)
    points = found["/front/depth/color/points"].points.reshape(48, 64, 3)
    assert int(depths[20, 32]) == pytest.approx(depth, abs=30)
    assert points[20, 32, 2] == pytest.approx(point, abs=0.03, nan_ok=True)


def test_a_model_without_its_sensors_is_told():
    with (
        gazelle.Simulation(formats.load_string(WALL)) as sim,
        pytest.warns(PluginWarning, match="no sensor 'front_color'"),
    ):
        sim.spawn(robot(parts=()), namespace="/")
