"""The bundled robots have the figures of the real ones (ROBOTIS, turtlebot3_description, noetic)."""

from __future__ import annotations

import pytest
import xacro
from lxml import etree

from gazelle import assets

ROBOTS = ("turtlebot3_burger", "turtlebot3_waffle", "turtlebot3_waffle_pi")
WAFFLES = ROBOTS[1:]

BASE = {
    "turtlebot3_burger": (
        0.82573504,
        (2.2124416e-3, -1.2294101e-5, 3.4938785e-5, 2.1193702e-3, -5.0120904e-6, 2.0064271e-3),
        ((0.140, 0.140, 0.143), (-0.032, 0, 0.070)),
    ),
    **dict.fromkeys(
        WAFFLES,
        (
            1.3729096,
            (8.7002718e-3, -4.7576583e-5, 1.1160499e-4, 8.6195418e-3, -3.5422299e-6, 1.4612727e-2),
            ((0.266, 0.266, 0.094), (-0.064, 0, 0.047)),
        ),
    ),
}
WAFFLE_JOINTS = {
    "wheel_left_joint": (0, 0.144, 0.023),
    "wheel_right_joint": (0, -0.144, 0.023),
    "caster_back_right_joint": (-0.177, -0.064, -0.004),
    "caster_back_left_joint": (-0.177, 0.064, -0.004),
    "imu_joint": (0, 0, 0.068),
    "scan_joint": (-0.064, 0, 0.122),
}
JOINTS = {
    "turtlebot3_burger": {
        "wheel_left_joint": (0, 0.080, 0.023),
        "wheel_right_joint": (0, -0.080, 0.023),
        "caster_back_joint": (-0.081, 0, -0.004),
        "imu_joint": (-0.032, 0, 0.068),
        "scan_joint": (-0.032, 0, 0.172),
    },
    "turtlebot3_waffle": WAFFLE_JOINTS
    | {"camera_joint": (0.064, -0.065, 0.094), "camera_rgb_joint": (0.005, 0.018, 0.013)},
    "turtlebot3_waffle_pi": WAFFLE_JOINTS
    | {"camera_joint": (0.073, -0.011, 0.084), "camera_rgb_joint": (0.003, 0.011, 0.009)},
}
SEPARATION = {"turtlebot3_burger": 0.160} | dict.fromkeys(WAFFLES, 0.287)


def expand(path, **arguments):
    text = xacro.process_file(str(path), mappings=arguments).toxml()
    return etree.fromstring(text.encode())


@pytest.fixture(scope="module", params=ROBOTS)
def name(request):
    return request.param


@pytest.fixture(scope="module")
def robot(name):
    return expand(assets.robot(name))


def numbers(text):
    return tuple(round(float(word), 12) for word in text.split())


def near(values):
    return pytest.approx(values, rel=1e-9, abs=1e-12)


def part(robot, kind, name):
    (found,) = robot.xpath(f"{kind}[@name='{name}']")
    return found


def inertia(link):
    element = link.find("inertial/inertia")
    return tuple(float(element.get(key)) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))


def xyz(element, attribute="xyz"):
    origin = element.find("origin")
    return numbers("0 0 0" if origin is None else origin.get(attribute, "0 0 0"))


def plugin(robot, filename):
    (found,) = robot.xpath(f".//plugin[@filename='{filename}']")
    return found


def tags(element):
    return {child.tag: child.text for child in element if isinstance(child.tag, str)}


def test_names_of_the_robots():
    assert sorted(assets.robots()) == sorted(
        [
            *ROBOTS,
            *("ackermann_base", "arm6", "cartpole", "courier", "fetch", "rrbot"),
            *("kobuki", "moving_cube", "rosbot", "summit_xl"),
            *("abb_irb120", "abb_irb140", "monoped", "parrot_ardrone", "ur5", "wamv"),
        ]
    )


def test_a_robot_is_named_as_its_file(robot, name):
    assert robot.get("name") == name


def test_body_has_the_published_mass_inertia_and_box(robot, name):
    mass, moments, (size, middle) = BASE[name]
    base = part(robot, "link", "base_link")
    assert float(base.find("inertial/mass").get("value")) == near(mass)
    assert inertia(base) == near(moments)
    assert numbers(base.find("collision/geometry/box").get("size")) == near(size)
    assert xyz(base.find("collision")) == near(middle)


def test_joints_are_where_the_published_ones_are(robot, name):
    expected = {"base_joint": (0, 0, 0.010), **JOINTS[name]}
    found = {joint.get("name"): xyz(joint) for joint in robot.findall("joint")}
    assert set(expected) <= set(found)
    for joint, place in expected.items():
        assert found[joint] == near(place), joint


@pytest.mark.parametrize("side", ["left", "right"])
def test_wheels(robot, side):
    joint = part(robot, "joint", f"wheel_{side}_joint")
    assert joint.get("type") == "continuous"
    assert numbers(joint.find("axis").get("xyz")) == (0, 0, 1)
    assert numbers(joint.find("origin").get("rpy")) == (-1.57, 0, 0)
    wheel = part(robot, "link", f"wheel_{side}_link")
    cylinder = wheel.find("collision/geometry/cylinder")
    assert float(cylinder.get("radius")) == near(0.033)
    assert float(cylinder.get("length")) == near(0.018)
    assert float(wheel.find("inertial/mass").get("value")) == near(0.028498940)
    assert inertia(wheel) == near(
        (1.1175580e-5, -4.2369783e-11, -5.9381719e-9, 1.1192413e-5, -1.4400107e-11, 2.0712558e-5)
    )


def test_casters_are_small_boxes_and_just_clear_of_the_floor(robot):
    casters = [link for link in robot.findall("link") if link.get("name").startswith("caster")]
    assert len(casters) == (1 if robot.get("name") == "turtlebot3_burger" else 2)
    for caster in casters:
        assert numbers(caster.find("collision/geometry/box").get("size")) == near(
            (0.030, 0.009, 0.020)
        )
        assert float(caster.find("inertial/mass").get("value")) == near(0.005)
        assert inertia(caster) == near((0.001, 0, 0, 0.001, 0, 0.001))
        joint = robot.find(f"joint/child[@link='{caster.get('name')}']").getparent()
        bottom = 0.010 + xyz(joint)[2] - xyz(caster.find("collision"))[1] - 0.009 / 2
        assert 0.0 <= bottom < 0.003


def test_lidar_body(robot):
    scan = part(robot, "link", "base_scan")
    cylinder = scan.find("collision/geometry/cylinder")
    assert (float(cylinder.get("radius")), float(cylinder.get("length"))) == near((0.055, 0.0315))
    assert xyz(scan.find("collision")) == near((0.015, 0, -0.0065))
    assert float(scan.find("inertial/mass").get("value")) == near(0.114)
    assert inertia(scan) == near((0.001, 0, 0, 0.001, 0, 0.001))


def test_lidar_measures_as_the_lds_does(robot):
    sensor = robot.find("gazebo[@reference='base_scan']/sensor")
    assert (sensor.get("name"), sensor.get("type")) == ("lds_lfcd_sensor", "ray")
    values = {
        path: float(sensor.findtext(path))
        for path in (
            "update_rate",
            "ray/scan/horizontal/samples",
            "ray/scan/horizontal/min_angle",
            "ray/scan/horizontal/max_angle",
            "ray/range/min",
            "ray/range/max",
            "ray/range/resolution",
            "ray/noise/mean",
            "ray/noise/stddev",
        )
    }
    assert list(values.values()) == [5, 360, 0, 6.28319, 0.12, 3.5, 0.015, 0, 0.01]
    assert sensor.findtext("ray/noise/type") == "gaussian"
    assert tags(plugin(robot, "libgazebo_ros_laser.so")) == {
        "topicName": "scan",
        "frameName": "base_scan",
    }


def test_number_of_rays_is_an_argument(name):
    robot = expand(assets.robot(name), lidar_samples="24")
    assert robot.findtext(".//samples") == "24"


@pytest.mark.parametrize(("argument", "sensor"), [("laser_visual", "ray"), ("imu_visual", "imu")])
def test_rays_and_imu_are_drawn_on_request(name, argument, sensor):
    path = f".//sensor[@type='{sensor}']/visualize"
    assert expand(assets.robot(name)).findtext(path) == "false"
    assert expand(assets.robot(name), **{argument: "true"}).findtext(path) == "true"


def test_contact_of_wheels_and_casters(robot):
    wheel = {
        "mu1": 0.1,
        "mu2": 0.1,
        "kp": 5e5,
        "kd": 10.0,
        "minDepth": 0.001,
        "maxVel": 0.1,
    }
    caster = wheel | {"kp": 1e6, "kd": 100.0, "maxVel": 1.0}
    links = [link.get("name") for link in robot.findall("link")]
    for link in links:
        if not link.startswith(("wheel", "caster")):
            continue
        values = tags(robot.find(f"gazebo[@reference='{link}']"))
        assert ("fdir1" in values) == link.startswith("wheel")
        assert values.pop("fdir1", "1 0 0") == "1 0 0"
        expected = wheel if link.startswith("wheel") else caster
        assert {key: float(value) for key, value in values.items()} == expected


def test_drive(robot, name):
    drive = plugin(robot, "libgazebo_ros_diff_drive.so")
    assert drive.get("name") == f"{name}_controller"
    values = tags(drive)
    assert float(values.pop("wheelSeparation")) == SEPARATION[name]
    assert values == {
        "leftJoint": "wheel_left_joint",
        "rightJoint": "wheel_right_joint",
        "wheelDiameter": "0.066",
        "wheelAcceleration": "1",
        "wheelTorque": "10",
        "updateRate": "30",
        "legacyMode": "false",
        "commandTopic": "cmd_vel",
        "odometryTopic": "odom",
        "odometryFrame": "odom",
        "odometrySource": "world",
        "robotBaseFrame": "base_footprint",
        "publishTf": "true",
        "publishOdomTF": "true",
        "publishWheelTF": "false",
        "publishWheelJointState": "true",
        "rosDebugLevel": "na",
    }


def test_imu(robot):
    assert robot.find("gazebo[@reference='imu_link']/sensor").get("type") == "imu"
    values = tags(plugin(robot, "libgazebo_ros_imu.so"))
    assert values["bodyName"] == values["frameName"] == "imu_link"
    assert (values["topicName"], values["serviceName"]) == ("imu", "imu_service")
    assert (float(values["gaussianNoise"]), float(values["updateRate"])) == (0, 0)


def camera(name, filename):
    robot = expand(assets.robot(name))
    sensor = robot.find("gazebo[@reference='camera_rgb_frame']/sensor")
    figures = [
        float(sensor.findtext(f"camera/{path}"))
        for path in ("horizontal_fov", "image/width", "image/height", "clip/near", "clip/far")
    ]
    return sensor, figures, tags(plugin(robot, filename))


def test_waffle_has_a_depth_camera():
    sensor, figures, values = camera("turtlebot3_waffle", "libgazebo_ros_openni_kinect.so")
    assert (sensor.get("type"), sensor.get("name")) == ("depth", "realsense_R200")
    assert figures == [1.3439, 1920, 1080, 0.03, 100]
    assert values["cameraName"] == "camera"
    assert values["frameName"] == "camera_rgb_optical_frame"
    assert values["depthImageTopicName"] == "depth/image_raw"
    assert values["pointCloudTopicName"] == "depth/points"
    assert float(values["pointCloudCutoff"]) == 0.4


def test_waffle_pi_has_a_camera():
    sensor, figures, values = camera("turtlebot3_waffle_pi", "libgazebo_ros_camera.so")
    assert (sensor.get("type"), sensor.get("name")) == ("camera", "Pi Camera")
    assert figures == [1.085595, 640, 480, 0.03, 100]
    assert float(values["updateRate"]) == 30
    assert (values["imageTopicName"], values["cameraInfoTopicName"]) == (
        "rgb/image_raw",
        "rgb/camera_info",
    )


def test_optical_frames_look_ahead(robot):
    for joint in robot.findall("joint"):
        if joint.find("child").get("link").endswith("optical_frame"):
            assert numbers(joint.find("origin").get("rpy")) == (-1.57, 0, -1.57)


def test_only_primitive_shapes(robot):
    shapes = {shape.tag for shape in robot.iterfind(".//geometry/*")}
    assert shapes <= {"box", "cylinder", "sphere"}


def test_what_is_seen_is_about_as_large_as_the_robot(robot, name):
    """Against the sizes in the maker's manual: 178 mm and 306 mm wide, 192 and 141 mm high."""
    wide, high = (0.178, 0.192) if name == "turtlebot3_burger" else (0.306, 0.141)
    joints = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}
    width = 2 * (xyz(joints["wheel_left_link"])[1] + 0.018 / 2)
    assert width == pytest.approx(wide, abs=0.002)
    top = max(
        0.010 + xyz(joints["base_scan"])[2] + xyz(visual)[2] + float(cylinder.get("length")) / 2
        for visual in part(robot, "link", "base_scan").findall("visual")
        for cylinder in visual.iterfind("geometry/cylinder")
    )
    assert top == pytest.approx(high, abs=0.004)


def skeleton(robot):
    """Return links, joints and colliding shapes of a robot."""
    links = {}
    for link in robot.findall("link"):
        collision = link.find("collision")
        shape = None if collision is None else collision.find("geometry")[0]
        links[link.get("name")] = (
            None if link.find("inertial") is None else inertia(link),
            None if shape is None else {key: numbers(shape.get(key)) for key in shape.attrib},
            None if collision is None else xyz(collision),
        )
    joints = {
        joint.get("name"): (
            joint.get("type"),
            joint.find("parent").get("link"),
            joint.find("child").get("link"),
            xyz(joint),
            xyz(joint, "rpy"),
        )
        for joint in robot.findall("joint")
    }
    return links, joints


@pytest.mark.corpus
def test_same_links_joints_and_shapes_as_the_published_robot(corpus, robot, name, tmp_path):
    folder = corpus / "ROBOTIS-GIT__turtlebot3" / "turtlebot3_description"
    for file in (folder / "urdf").glob("*.xacro"):
        text = file.read_text().replace("$(find turtlebot3_description)/urdf", str(tmp_path))
        (tmp_path / file.name).write_text(text)
    links, joints = skeleton(robot)
    assert (links, joints) == skeleton(expand(tmp_path / f"{name}.urdf.xacro"))


@pytest.mark.corpus
def test_rrbot_has_the_links_joints_shapes_and_motors_of_the_published_one(corpus, tmp_path):
    folder = corpus / "ros-simulation__gazebo_ros_demos" / "rrbot_description" / "urdf"
    for file in folder.iterdir():
        text = file.read_text().replace("$(find rrbot_description)/urdf", str(tmp_path))
        (tmp_path / file.name).write_text(text)
    ours, published = expand(assets.robot("rrbot")), expand(tmp_path / "rrbot.xacro")
    links, joints = skeleton(ours)
    links_wanted, joints_wanted = skeleton(published)
    assert joints == joints_wanted
    assert links.keys() == links_wanted.keys()
    for name, (moments, size, middle) in links_wanted.items():
        assert links[name] == (moments and near(moments), size, middle)
    for path in ("link/inertial/mass/@value", "joint/dynamics/@damping", "joint/axis/@xyz"):
        assert set(map(numbers, ours.xpath(path))) == set(map(numbers, published.xpath(path)))
    for path in ("transmission/@name", "transmission/joint/@name", ".//hardwareInterface/text()"):
        assert ours.xpath(path) == published.xpath(path)
