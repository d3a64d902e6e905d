"""PyKDL, tf_conversions, tf2_kdl, tf2_sensor_msgs, laser_geometry and sensor_msgs.point_cloud2."""

import importlib
import json
import math
import subprocess

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros import real

import gazelle_ros as ros
from gazelle_ros.compat import PyKDL
from gazelle_ros.messages import load_message

NUMBERS = st.floats(-4.0, 4.0)
VECTORS = st.builds(PyKDL.Vector, NUMBERS, NUMBERS, NUMBERS)
ROTATIONS = st.builds(PyKDL.Rotation.RPY, NUMBERS, NUMBERS, NUMBERS)
FRAMES = st.builds(PyKDL.Frame, ROTATIONS, VECTORS)
TWISTS = st.builds(PyKDL.Twist, VECTORS, VECTORS)


@pytest.fixture(autouse=True)
def installed():
    with ros.install():
        yield


def load(name):
    return importlib.import_module(name)


@given(FRAMES, FRAMES)
def test_a_frame_times_its_inverse_is_none(f, g):
    assert f * f.Inverse() == PyKDL.Frame()
    assert f.Inverse(f * g) == g


@given(ROTATIONS)
def test_a_rotation_is_what_its_angles_and_its_quaternion_say(r):
    assert PyKDL.Rotation.RPY(*r.GetRPY()) == r
    assert PyKDL.Rotation.EulerZYX(*r.GetEulerZYX()) == r
    assert PyKDL.Rotation.EulerZYZ(*r.GetEulerZYZ()) == r
    assert PyKDL.Rotation.Quaternion(*r.GetQuaternion()) == r
    angle, axis = r.GetRotAngle()
    assert PyKDL.Rotation.Rot(axis, angle) == r


@given(FRAMES, FRAMES)
def test_the_difference_leads_from_one_frame_to_the_other(f, g):
    reached = PyKDL.addDelta(f, PyKDL.diff(f, g))
    assert all(abs(reached[i, j] - g[i, j]) < 1e-4 for i in range(3) for j in range(4))


@given(FRAMES, TWISTS)
def test_power_is_the_same_in_all_frames(f, twist):
    wrench = PyKDL.Wrench(PyKDL.Vector(1, 2, 3), PyKDL.Vector(4, 5, 6))
    power = PyKDL.dot(twist.vel, wrench.force) + PyKDL.dot(twist.rot, wrench.torque)
    seen, pushed = f * twist, f * wrench
    again = PyKDL.dot(seen.vel, pushed.force) + PyKDL.dot(seen.rot, pushed.torque)
    assert again == pytest.approx(power, abs=1e-9)


def test_kdl_values_can_be_indexed_set_and_shown():
    vector = PyKDL.Vector(1, 2, 3)
    vector[1] = 5
    assert [*vector] == [1, 5, 3]
    assert vector.y() == 5
    assert str(vector) == "[           1,           5,           3]"
    frame = PyKDL.Frame(PyKDL.Vector(1, 2, 3))
    assert (frame[0, 3], frame[3, 3], frame[0, 1]) == (1.0, 1.0, 0.0)
    assert PyKDL.Vector(3, 4, 0).Norm() == 5.0
    assert PyKDL.Twist(vector, vector) != PyKDL.Twist()


KDL_SCRIPT = """
import json, random, sys
import PyKDL as K
random.seed(5)
R = lambda: random.uniform(-4, 4)
V = lambda: K.Vector(R(), R(), R())
six = lambda t: [t[i] for i in range(6)]
frame = lambda f: [f[i, j] for i in range(3) for j in range(4)]
out = []
for _ in range(100):
    r, s = K.Rotation.RPY(R(), R(), R()), K.Rotation.EulerZYZ(R(), R(), R())
    f, g = K.Frame(r, V()), K.Frame(s, V())
    t, w = K.Twist(V(), V()), K.Wrench(V(), V())
    out += [frame(f * g), frame(f.Inverse()), six(f * t), six(g * w), six(K.diff(f, g))]
    out += [[*r.GetQuaternion()], [*r.GetRPY()], [*s.GetEulerZYZ()], [r.GetRotAngle()[0]]]
    out += [six(t.RefPoint(V())), six(w.RefPoint(V())), frame(K.Frame.DH(R(), R(), R(), R()))]
json.dump(out, sys.stdout)
"""


@pytest.mark.ros
@real.needs_ros
def test_frames_are_those_of_the_real_kdl(capsys):
    done = subprocess.run(
        [real.PYTHON, "-c", KDL_SCRIPT], capture_output=True, text=True, check=False
    )
    if done.returncode:
        pytest.skip("PyKDL is not installed (Debian: python3-pykdl)")
    exec(KDL_SCRIPT, {})  # the script above, with our PyKDL
    ours, theirs = json.loads(capsys.readouterr().out), json.loads(done.stdout)
    for mine, other in zip(ours, theirs, strict=True):
        assert mine == pytest.approx(other, abs=1e-9)


@pytest.mark.long
@given(FRAMES)
def test_posemath_goes_there_and_back(f):
    posemath = load("tf_conversions.posemath")
    assert posemath.fromMsg(posemath.toMsg(f)) == f
    assert posemath.fromTf(posemath.toTf(f)) == f
    assert posemath.fromMatrix(posemath.toMatrix(f)) == f


def test_posemath_reads_a_camera():
    conversions = load("tf_conversions")
    found = conversions.fromCameraParams(None, [[0], [0], [math.pi / 2]], [1, 2, 3])
    assert found == PyKDL.Frame(PyKDL.Rotation.RotZ(math.pi / 2), PyKDL.Vector(1, 2, 3))
    assert conversions.transformations.quaternion_from_euler(0, 0, 0)[3] == 1.0


def turned():
    """Return a quarter turn about z, and one metre along x."""
    made = load_message("geometry_msgs/TransformStamped")()
    made.header.frame_id = "target"
    made.transform.translation.x = 1.0
    made.transform.rotation.z = made.transform.rotation.w = math.sqrt(0.5)
    return made


def test_kdl_values_are_moved_between_frames():
    tf2_kdl = load("tf2_kdl")
    moved = tf2_kdl.do_transform_vector(PyKDL.Vector(1, 0, 0), turned())
    assert moved == PyKDL.Vector(1, 1, 0)
    assert moved.header.frame_id == "target"
    message = tf2_kdl.to_msg_vector(moved)
    assert tf2_kdl.from_msg_vector(message) == moved
    assert load("tf2_ros").convert(moved, PyKDL.Vector) == moved


POINTS = [(1.0, 2.0, 3.0), (4.0, math.nan, 6.0), (7.0, 8.0, 9.0)]


@pytest.fixture
def clouds():
    return load("sensor_msgs.point_cloud2")


def test_a_cloud_gives_back_its_points(clouds):
    cloud = clouds.create_cloud_xyz32(load_message("std_msgs/Header")(frame_id="a"), POINTS)
    assert (cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (1, 3, 12, 36)
    assert list(clouds.read_points(cloud, skip_nans=True)) == [POINTS[0], POINTS[2]]
    assert list(clouds.read_points(cloud, ("z", "x"), uvs=[(2, 0), (0, 0)])) == [(7, 9), (1, 3)]
    assert clouds.read_points_list(cloud, skip_nans=True)[1].y == 8.0
    assert type(cloud)().deserialize(ros_bytes(cloud)) == cloud


def ros_bytes(message):
    import io

    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def test_a_cloud_keeps_types_counts_gaps_and_rows(clouds):
    field = clouds.PointField
    fields = [
        field("x", 0, field.FLOAT32, 1),
        field("n", 8, field.UINT16, 2),
        field("d", 16, field.FLOAT64, 1),
    ]
    cloud = clouds.create_cloud(load_message("std_msgs/Header")(), fields, [(1.5, 2, 3, 1e9)] * 4)
    assert cloud.point_step == 24
    cloud.height, cloud.width, cloud.row_step = 2, 2, 48
    assert list(clouds.read_points(cloud)) == [(1.5, 2, 3, 1e9)] * 4
    assert list(clouds.read_points(cloud, ["n"])) == [(2, 3)] * 4


def test_a_cloud_that_is_too_short_or_lacks_a_field_is_refused(clouds):
    cloud = clouds.create_cloud_xyz32(load_message("std_msgs/Header")(), POINTS)
    with pytest.raises(ValueError, match="no field 'rgb'"):
        clouds.read_points(cloud, ["rgb"])
    cloud.width = 4
    with pytest.raises(ValueError, match="too short"):
        clouds.read_points(cloud)
    with pytest.raises(TypeError):
        clouds.read_points(load_message("std_msgs/Header")())
    with pytest.raises(ValueError, match="values"):
        clouds.create_cloud_xyz32(load_message("std_msgs/Header")(), np.zeros((2, 4)))


def test_an_empty_cloud_has_no_points(clouds):
    cloud = clouds.create_cloud_xyz32(load_message("std_msgs/Header")(), [])
    assert list(clouds.read_points(cloud)) == []
    assert load("tf2_sensor_msgs").do_transform_cloud(cloud, turned()).width == 0


def scan():
    return load_message("sensor_msgs/LaserScan")(
        angle_min=-1.0,
        angle_increment=0.5,
        time_increment=0.01,
        range_min=0.1,
        range_max=5.0,
        ranges=[1.0, 0.05, 2.0, math.inf, 4.0],
        intensities=[1.0, 2.0, 3.0, 4.0, 5.0],
    )


def test_a_scan_becomes_a_cloud_without_what_is_out_of_range(clouds):
    projection = load("laser_geometry").LaserProjection
    cloud = projection().projectLaser(scan(), channel_options=projection.ChannelOption.DEFAULT | 4)
    assert [field.name for field in cloud.fields] == [
        "x",
        "y",
        "z",
        "intensity",
        "index",
        "distances",
    ]
    points = list(clouds.read_points(cloud))
    assert [point[4] for point in points] == [0, 2, 4]
    assert [math.hypot(*point[:2]) for point in points] == pytest.approx([1.0, 2.0, 4.0])
    assert math.atan2(points[2][1], points[2][0]) == pytest.approx(1.0)
    assert projection().projectLaser(scan(), 3.0).width == 2


def test_a_cloud_moves_between_frames_with_its_other_values(clouds):
    cloud = load("laser_geometry").LaserProjection().projectLaser(scan())
    moved = load("tf2_sensor_msgs").do_transform_cloud(cloud, turned())
    for (x, y, *rest), (u, v, *others) in zip(
        clouds.read_points(cloud), clouds.read_points(moved), strict=True
    ):
        assert (u, v) == pytest.approx((1.0 - y, x), abs=1e-6)
        assert rest == others


CLOUD_SCRIPT = """
import json, random, sys
import sensor_msgs.point_cloud2 as pc2
from sensor_msgs.msg import LaserScan
from geometry_msgs.msg import TransformStamped
from laser_geometry import LaserProjection
from tf2_sensor_msgs.tf2_sensor_msgs import do_transform_cloud
random.seed(2)
scan = LaserScan(angle_min=-1.0, angle_max=1.0, angle_increment=.1, time_increment=.01, range_min=.1,
    range_max=5.0, ranges=[random.uniform(0, 6) for _ in range(21)], intensities=[1.0] * 21)
moved = TransformStamped()
moved.transform.translation.x, moved.transform.rotation.w, moved.transform.rotation.x = 1, .8, .6
out = []
for options in (0, 1, 3, 15, 31):
    cloud = LaserProjection().projectLaser(scan, channel_options=options)
    out.append([cloud.width, cloud.point_step, bytes(cloud.data).hex()])
    out.append(repr(pc2.read_points_list(cloud)))
    out.append(repr([f.name for f in cloud.fields]))
    for point in pc2.read_points(do_transform_cloud(cloud, moved)):
        out.append([round(v, 5) for v in point])
json.dump(out, sys.stdout)
"""


@pytest.mark.ros
@real.needs_ros
def test_clouds_are_those_of_the_real_packages(capsys):
    done = subprocess.run(
        [real.PYTHON, "-c", CLOUD_SCRIPT], capture_output=True, text=True, check=False
    )
    if done.returncode:
        pytest.skip("needs Debian's python3-laser-geometry and python3-tf2-sensor-msgs")
    exec(CLOUD_SCRIPT, {})  # the script above, with our modules
    assert json.loads(capsys.readouterr().out) == json.loads(done.stdout)
