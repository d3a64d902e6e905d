"""Message classes behave as genpy's do."""

import copy
import pickle
import random
import subprocess
import sys
import threading

import numpy as np
import pytest
from message_samples import dumps, random_message

from gazelle_ros.messages import (
    Message,
    class_from_text,
    definitions,
    load_message,
    load_service,
    register,
)
from gazelle_ros.time import Duration, Time

Point = load_message("geometry_msgs/Point")
Pose = load_message("geometry_msgs/Pose")


def test_a_message_is_made_of_nothing_all_fields_or_some_by_name():
    assert Point() == Point(0.0, 0.0, 0.0)
    assert Point(1, 2, 3).y == 2
    assert Point(y=2) == Point(0, 2, 0)
    assert Pose(position=None) == Pose()
    assert Pose(None, None) == Pose()


@pytest.mark.parametrize(
    ("args", "kwds", "error"),
    [((1,), {}, TypeError), ((1, 2, 3, 4), {}, TypeError), ((1,), {"y": 1}, TypeError)],
)
def test_wrong_arguments_are_an_error(args, kwds, error):
    with pytest.raises(error):
        Point(*args, **kwds)


def test_unknown_fields_cannot_be_given_or_set():
    with pytest.raises(AttributeError, match="w is not an attribute of Point"):
        Point(w=1)
    with pytest.raises(AttributeError):
        Point().w = 1


def test_each_message_has_its_own_defaults():
    one, two = Pose(), Pose()
    one.position.x = 1.0
    assert two.position.x == 0.0
    path = load_message("nav_msgs/Path")
    path().poses.append(1)
    assert path().poses == []


def test_defaults_are_those_of_the_types(all_kinds):
    message = all_kinds()
    assert message.a_bool is False
    assert (message.a_string, message.a_time, message.a_duration) == ("", Time(), Duration())
    assert message.octets == b""
    assert message.five_octets == bytes(5)
    assert message.three_bools == [False] * 3
    assert message.two_strings == ["", ""]
    assert message.two_times[0] is not message.two_times[1]
    assert message.two_inners[0] is not message.two_inners[1]
    assert (message.FIRST, message.SECOND, message.RATIO, message.YES) == (-3, 7, 1500.0, True)
    assert message.TEXT == "a # b \"c\" 'd'"
    assert (message.lambda_, message.self_) == (0, 0)


def of_packages():
    """Return all messages, without those that other tests register, some of which are invalid."""
    return [name for name in definitions() if not name.startswith("sample_msgs/")]


@pytest.mark.long
def test_defaults_are_genpys(all_kinds, genpy):
    for made in (all_kinds, *map(load_message, of_packages()[::7])):
        theirs = genpy.class_of(made)()
        assert str(made()) == str(theirs)
        assert dumps(made()) == dumps(theirs)


def test_equality_is_by_value_and_messages_cannot_be_keys():
    assert Point(1, 2, 3) == Point(1, 2, 3)
    assert Point() != load_message("geometry_msgs/Vector3")()
    assert Point() != 3
    scan = load_message("sensor_msgs/LaserScan")
    assert scan(ranges=[1.0, 2.0]) == scan(ranges=(1.0, 2.0))
    assert scan(ranges=[1.0, 2.0]) == scan(ranges=np.array([1.0, 2.0]))
    assert scan(ranges=np.array([1.0, 2.0])) != scan(ranges=np.array([1.0]))
    with pytest.raises(TypeError):
        hash(Point())


def test_messages_can_be_copied_and_pickled(all_kinds):
    for made in (all_kinds, *map(load_message, of_packages()[::20])):
        message = random_message(made, random.Random(1))
        for same in (
            copy.copy(message),
            copy.deepcopy(message),
            pickle.loads(pickle.dumps(message)),
        ):
            assert type(same) is made
            assert same == message
    deep = Pose()
    copy.deepcopy(deep).position.x = 5.0
    assert deep.position.x == 0.0


def test_requests_and_messages_of_other_definitions_can_be_pickled():
    request = load_service("std_srvs/SetBool")._request_class(True)
    assert pickle.loads(pickle.dumps(request)) == request
    other = class_from_text("std_msgs/String", "string data\nint32 more\n")
    message = other("a", 3)
    again = pickle.loads(pickle.dumps(message))
    assert again == message
    assert type(again)._md5sum == other._md5sum


def test_a_subclass_reads_and_writes_as_its_base():
    def deserialize(self, data):
        return self.deserialize_numpy(data, np)

    scan = load_message("sensor_msgs/LaserScan")
    special = type("Special", (scan,), {"__slots__": scan.__slots__, "deserialize": deserialize})
    data = dumps(scan(ranges=[1.0, 2.0]))
    read = special().deserialize(data)
    assert isinstance(read.ranges, np.ndarray)
    assert dumps(read) == data
    assert special(range_max=2.0).range_max == 2.0


def test_a_service_names_its_request_and_response():
    service = load_service("std_srvs/SetBool")
    assert service._type == "std_srvs/SetBool"
    assert service._request_class(data=True).data is True
    assert service._response_class(success=True, message="x")._type == "std_srvs/SetBoolResponse"
    assert service._request_class._md5sum != service._md5sum
    assert load_message("std_srvs/SetBoolRequest") is service._request_class


def test_classes_say_what_they_are():
    made = load_message("sensor_msgs/Image")
    assert issubclass(made, Message)
    assert made._has_header
    assert not Point._has_header
    assert made.__module__ == "sensor_msgs.msg._Image"
    assert made.__name__ == "Image"
    assert made is load_message("sensor_msgs/Image")
    assert load_message("Header") is load_message("std_msgs/Header")


def test_a_class_from_a_text_is_made_once():
    text = Pose._full_text
    assert class_from_text("geometry_msgs/Pose", text) is class_from_text(
        "geometry_msgs/Pose", text
    )


def test_many_threads_may_use_a_new_class_at_once():
    for number in range(20):
        register("sample_msgs", f"Fresh{number}", "int32 a\ngeometry_msgs/Pose[] poses\n")
    failures = []

    def use():
        try:
            for number in range(20):
                made = load_message(f"sample_msgs/Fresh{number}")
                message = made(a=3, poses=[Pose()])
                assert made().deserialize(dumps(message)) == message
        except Exception as err:  # noqa: BLE001  # shown by the assertion below
            failures.append(err)

    threads = [threading.Thread(target=use) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


@pytest.mark.long
def test_importing_the_room_is_quick_and_brings_no_numpy():
    code = (
        "import sys, time; t = time.process_time(); import gazelle_ros.messages; "
        "print(time.process_time() - t, 'numpy' in sys.modules, 'yaml' in sys.modules)"
    )
    runs = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        for _ in range(5)
    ]
    seconds = min(float(run.stdout.split()[0]) for run in runs)
    assert all(run.stdout.split()[1:] == ["False", "False"] for run in runs)
    assert seconds < 0.5, "some 0.05 s; all of Gazelle takes 0.3"
