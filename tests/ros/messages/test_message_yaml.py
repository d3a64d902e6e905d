"""Messages as YAML, as rostopic prints and reads them."""

import random

import pytest
import yaml as pyyaml
from message_samples import random_message

from gazelle_ros.messages import MessageException, load_message
from gazelle_ros.messages.yaml import (
    fill_message_args,
    from_dict,
    from_yaml,
    get_printable_message_args,
    strify_message,
    to_dict,
    to_yaml,
)
from gazelle_ros.time import Duration, Time

Twist = load_message("geometry_msgs/Twist")
Header = load_message("std_msgs/Header")
Pose = load_message("geometry_msgs/PoseStamped")


def test_a_message_prints_as_rostopic_echo_prints_it():
    header = Header(seq=3, stamp=Time(1, 20), frame_id="map")
    assert to_yaml(header) == 'seq: 3\nstamp: \n  secs: 1\n  nsecs:        20\nframe_id: "map"'
    array = load_message("std_msgs/Float64MultiArray")(data=[1.0, 2.5])
    assert to_yaml(array) == "layout: \n  dim: []\n  data_offset: 0\ndata: [1.0, 2.5]"
    image = load_message("sensor_msgs/Image")(data=b"\x01\x02")
    assert to_yaml(image).endswith("data: [1, 2]")
    names = load_message("sensor_msgs/JointState")(name=["a", "b"])
    assert "name: \n  - a\n  - b\n" in to_yaml(names)


@pytest.mark.parametrize(
    "text", ["", "plain", 'a "b"', "\\", "é", "a\nb", "x " * 60, "#", "~", "1"]
)
def test_a_string_prints_so_that_yaml_reads_it_back(text):
    message = load_message("std_msgs/String")(text)
    assert pyyaml.safe_load(to_yaml(message)) == {"data": text}


def test_text_is_genpys_with_every_option(all_kinds, genpy):
    rng = random.Random(8)
    for _ in range(20):
        message = random_message(all_kinds, rng)
        theirs = genpy.copy_of(message)
        assert strify_message(message) == genpy.message.strify_message(theirs)
        assert strify_message(message, "    ") == genpy.message.strify_message(theirs, "    ")
        for options in (
            {"fixed_numeric_width": 6},
            {"field_filter": lambda each: [name for name in each.__slots__ if "s" in name]},
        ):
            assert strify_message(message, **options) == genpy.message.strify_message(
                theirs, **options
            )
    message = Header(stamp=Time(5, 1))
    assert strify_message(message, time_offset=Time(2)) == genpy.message.strify_message(
        genpy.copy_of(message), time_offset=genpy.Time(2)
    )


ARGUMENTS = [
    ("geometry_msgs/Twist", [[1, 2, 3], [4, 5, 6]]),
    ("geometry_msgs/Twist", [{"linear": {"x": 1.5}}]),
    ("geometry_msgs/Twist", [{"linear": [1, 2, 3]}]),
    ("geometry_msgs/Twist", [[1, 2], [4, 5, 6]]),
    ("geometry_msgs/Twist", [[1, 2, 3]]),
    ("geometry_msgs/Twist", [{"lineal": 3}]),
    ("geometry_msgs/Twist", [{"linear": "now"}]),
    ("geometry_msgs/Twist", [{"linear": 3}]),
    ("geometry_msgs/Twist", None),
    ("geometry_msgs/Twist", []),
    ("std_msgs/Empty", None),
    ("std_msgs/Empty", []),
    ("std_msgs/String", ["text"]),
    ("std_msgs/String", [{"data": None}]),
    ("std_msgs/Header", [3, "now", "map"]),
    ("std_msgs/Header", [3, 1500000000, "map"]),
    ("std_msgs/Header", [3, {"secs": 1, "nsecs": 2}, "map"]),
    ("std_msgs/Header", [3, [1, 2], "map"]),
    ("std_msgs/Header", [{"stamp": "then"}]),
    ("std_msgs/Duration", [-1500000000]),
    ("geometry_msgs/PoseStamped", [{"header": "auto"}]),
    ("std_msgs/Float64MultiArray", [{"data": [1, 2]}]),
    ("std_msgs/Float64MultiArray", [{"data": 1}]),
    ("std_msgs/Float64MultiArray", [{"layout": {"dim": [{"label": "x"}, ["y", 1, 2]]}}]),
    ("sensor_msgs/Imu", [{"orientation_covariance": [1] * 9}]),
    ("sensor_msgs/Imu", [{"orientation_covariance": [1] * 8}]),
    ("sensor_msgs/Image", [{"data": [1, 2, 3]}]),
    ("tf2_msgs/TFMessage", [[{"child_frame_id": "a"}, {"header": {"seq": 3}}]]),
    ("sample_msgs/AllKinds", [{"times": [1, {"secs": 3}], "durations": [-1], "two_times": [1]}]),
    ("sample_msgs/AllKinds", [{"times": [1, [3, 4]], "durations": [-1], "inner": {"when": 5}}]),
    ("geometry_msgs/Twist", "text"),
]


@pytest.mark.parametrize(("name", "arguments"), ARGUMENTS)
def test_arguments_fill_a_message_as_genpys(name, arguments, all_kinds, genpy):
    made = load_message(name)
    outcomes = []
    for message, fill, time in (
        (made(), fill_message_args, Time),
        (genpy.class_of(made)(), genpy.message.fill_message_args, genpy.Time),
    ):
        keys = {"now": time(7, 8)}
        if name == "geometry_msgs/PoseStamped":
            keys["auto"] = type(message.header)(frame_id="base")
        try:
            fill(message, arguments, keys)
        except Exception as err:  # noqa: BLE001  # the kind is what is compared
            outcomes.append(type(err).__name__)
        else:
            outcomes.append(str(message))
    assert outcomes[0] == outcomes[1]


def test_a_message_is_read_from_yaml_and_from_dicts():
    twist = from_yaml(Twist, "{linear: {x: 1.0}, angular: {z: -2}}")
    assert (twist.linear.x, twist.angular.z) == (1.0, -2)
    assert from_yaml(Twist, "[[1, 2, 3], [4, 5, 6]]").angular.z == 6
    assert from_yaml(load_message("std_msgs/Int32"), "3").data == 3
    assert from_yaml(load_message("std_msgs/Empty"), "") == load_message("std_msgs/Empty")()
    pose = from_yaml(Pose, "header: {stamp: now}", {"now": Time(9)})
    assert pose.header.stamp == Time(9)
    assert from_dict(Pose, to_dict(pose)) == pose
    assert from_dict(pose, {"pose": {"position": {"x": 1.0}}}).pose.position.x == 1.0
    frames = from_dict(
        load_message("tf2_msgs/TFMessage"), {"transforms": [{"child_frame_id": "a"}]}
    )
    assert frames.transforms[0].child_frame_id == "a"


@pytest.mark.parametrize("text", ["{", "linear: 3", "{linera: {x: 1}}", "now", "[1, 2, 3]"])
def test_wrong_yaml_is_an_error(text):
    with pytest.raises((MessageException, ValueError)):
        from_yaml(Twist, text)


def test_every_message_comes_back_from_its_dict(all_kinds):
    rng = random.Random(2)
    for _ in range(20):
        message = random_message(all_kinds, rng)
        assert to_dict(from_dict(all_kinds, to_dict(message))) == to_dict(message)


def test_durations_are_read_from_nanoseconds():
    assert from_yaml(load_message("std_msgs/Duration"), "data: 1500000000").data == Duration(1.5)


def test_argument_names_have_dots_between():
    assert get_printable_message_args(Header()) == "seq stamp frame_id"
    assert get_printable_message_args(Pose()).split()[0] == "header.seq"
    assert get_printable_message_args(Pose()).split()[-1] == "pose.orientation.w"
