"""Definitions: how they are read, and that their MD5 sums are those of the whole ROS world."""

import os
import random
import re
import string

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from gazelle_ros.base.errors import FormatWarning
from gazelle_ros.messages import (
    InvalidDefinitionError,
    UnknownTypeError,
    class_from_text,
    definitions,
    load_message,
    load_service,
    register,
)
from gazelle_ros.messages.parse import parse_message, parse_service
from gazelle_ros.messages.search import find_packages
from gazelle_ros.messages.spec import CONSTANT_TYPES, SCALARS

MESSAGE_MD5 = {
    "actionlib_tutorials/FibonacciAction": "f59df5767bf7634684781c92598b2406",
    "std_msgs/Header": "2176decaecbce78abc3b96ef049fabed",
    "std_msgs/String": "992ce8a1687cec8c8bd883ec73ca41d1",
    "geometry_msgs/Pose": "e45d45a5a1ce597b249e23fb30fc871f",
    "geometry_msgs/Twist": "9f195f881246fdfa2798d1d3eebca84a",
    "sensor_msgs/LaserScan": "90c7ef2dc6895d81024acba2ac42f369",
    "sensor_msgs/Image": "060021388200f6f0f447d0fcd9c64743",
    "sensor_msgs/JointState": "3066dcd76a6cfaef579bd0f34173e9fd",
    "nav_msgs/Odometry": "cd5e73d190d741a2f92e81eda573aca7",
    "tf2_msgs/TFMessage": "94810edda583a504dfda3829e70d7eec",
    "rosgraph_msgs/Log": "acffd30cd6b6de30f120938c17c593fb",
    "rosgraph_msgs/Clock": "a9c97c1d230cfc112e270351a944ee47",
    "actionlib_msgs/GoalStatusArray": "8b2b82f13216d0a8ea88bd3af735e619",
    "gazebo_msgs/LinkStates": "48c080191eb15c41858319b4d8a609c2",
    "gazebo_msgs/ModelStates": "48c080191eb15c41858319b4d8a609c2",
    "gazebo_msgs/PerformanceMetrics": "884f71fd5037b886ec5e126b83c4425a",
    "gazebo_msgs/LinkState": "0818ebbf28ce3a08d48ab1eaa7309ebe",
    "gazebo_msgs/ModelState": "9330fd35f2fcd82d457e54bd54e10593",
    "gazebo_msgs/ContactState": "48c0ffb054b8c444f870cecea1ee50d9",
    "gazebo_msgs/ContactsState": "acbcb1601a8e525bf72509f18e6f668d",
    "gazebo_msgs/ODEPhysics": "667d56ddbd547918c32d1934503dc335",
    "gazebo_msgs/ODEJointProperties": "1b744c32a920af979f53afe2f9c3511f",
    "gazebo_msgs/WorldState": "de1a9de3ab7ba97ac0e9ec01a4eb481e",
    "gazebo_msgs/SensorPerformanceMetric": "01762ded18cfe9ebc7c8222667c99547",
    "control_msgs/JointTolerance": "f544fe9c16cf04547e135dd6063ff5be",
    "control_msgs/JointControllerState": "987ad85e4756f3aef7f1e5e7fe0595d1",
    "control_msgs/JointTrajectoryControllerState": "10817c60c2486ef6b33e97dcd87f4474",
    "control_msgs/PidState": "b138ec00e886c10e73f27e8712252ea6",
    "control_msgs/FollowJointTrajectoryAction": "bc4f9b743838566551c0390c65f1a248",
    "industrial_msgs/RobotStatus": "b733cb45a38101840b75c4c0d6093d19",
    "moveit_msgs/CollisionObject": "dbba710596087da521c07564160dfccb",
    "moveit_msgs/MoveGroupAction": "33225407c32b189345eec6893a5a0da3",
    "openai_ros/RLExperimentInfo": "117729220546455cc216a7df0b6e91d0",
    "theconstruct_msgs/RLExperimentInfo": "117729220546455cc216a7df0b6e91d0",
}
SERVICE_MD5 = {
    "control_toolbox/SetPidGains": "4a43159879643e60937bf2893b633607",
    "rospy_tutorials/AddTwoInts": "6a2e34150c00229791cc89ff309fff21",
    "std_srvs/Empty": "d41d8cd98f00b204e9800998ecf8427e",
    "std_srvs/SetBool": "09fb03525b03e7ea1fd3992bafd87e16",
    "std_srvs/Trigger": "937c9679a518e3a18d831e57125ea522",
    "gazebo_msgs/SpawnModel": "9ed9c82c96abe1a00c3e8cdaeee24413",
    "gazebo_msgs/DeleteModel": "9ce56b4e9e54616de25d796dc972a262",
    "gazebo_msgs/DeleteLight": "ae11ea8100d536d5b92c2b5917abf912",
    "gazebo_msgs/GetModelProperties": "5717f7bd34ed990fa80e28b3015027a3",
    "gazebo_msgs/GetModelState": "4c515e936d3319c9610c559c60bfc3d4",
    "gazebo_msgs/GetWorldProperties": "36bb0f2eccf4d8be971410c22818ba3f",
    "gazebo_msgs/GetJointProperties": "7b30be900f50aa21efec4a0ec92d91c9",
    "gazebo_msgs/GetLinkProperties": "0e06a70386d0ee3fb880c02f23fcd821",
    "gazebo_msgs/GetLinkState": "09d6c98cce97b35f7ab9bd70300657ab",
    "gazebo_msgs/GetLightProperties": "df2cef87e13e2e6990e81e8aaa454c19",
    "gazebo_msgs/SetLightProperties": "e6f13430c57278bb364aca53a1bf5ebf",
    "gazebo_msgs/GetPhysicsProperties": "575a5e74786981b7df2e3afc567693a6",
    "gazebo_msgs/SetPhysicsProperties": "97e2057080558ce4730434b5fae75c91",
    "gazebo_msgs/SetLinkProperties": "d534ce1b36ee99de0ffa806c3a6348f0",
    "gazebo_msgs/SetModelState": "5b3ab0281d4f5445def017e3a2e4a07b",
    "gazebo_msgs/SetModelConfiguration": "10e3139d3b669c40afc057d38956fff7",
    "gazebo_msgs/SetJointProperties": "15a76e921b1410c698d82782ea5fa370",
    "gazebo_msgs/SetJointTrajectory": "88f5c10979e3f9649d5ae87a3b12aa65",
    "gazebo_msgs/SetLinkState": "8a5146eb66ae4d26b0860b08f3f271be",
    "gazebo_msgs/ApplyBodyWrench": "585b9f9618aa0581b207e2f2d90866bc",
    "gazebo_msgs/ApplyJointEffort": "c0039811b8cc919490b3cff748cdf46b",
    "gazebo_msgs/JointRequest": "0be1351618e1dc030eb7959d9a4902de",
    "gazebo_msgs/BodyRequest": "5eade9afe7f232d78005bd0cafeab755",
    "controller_manager_msgs/ListControllers": "1341feb2e63fa791f855565d0da950d8",
    "controller_manager_msgs/ListControllerTypes": "c1d4cd11aefa9f97ba4aeb5b33987f4e",
    "controller_manager_msgs/LoadController": "647e5c54b8d6468952d8d31f1efe96c0",
    "controller_manager_msgs/UnloadController": "647e5c54b8d6468952d8d31f1efe96c0",
    "controller_manager_msgs/SwitchController": "b29a7abc673b2c54c14b54e50f8d06a5",
    "controller_manager_msgs/ReloadControllerLibraries": "40e8c411fd1797d2e2c486018f846040",
    "control_msgs/QueryTrajectoryState": "ec93cdecbd8062d761aa52b7c90cd44b",
    "fetch_train/EeTraj": "28e4dd667b29bd35b516ba1d379b7529",
    "fetch_train/JointTraj": "3fc8a9e27b55b9b20a2c846f9e053a5c",
    "fetch_train/EePose": "f192399f711a48924df9a394d37edd67",
    "fetch_train/EeRpy": "cfb6f20560ab4d9cc1d682755cf3b5d4",
}


@pytest.mark.parametrize(("name", "md5"), MESSAGE_MD5.items())
def test_the_md5_sum_of_a_message_is_the_published_one(name, md5):
    assert load_message(name)._md5sum == md5


@pytest.mark.parametrize(("name", "md5"), SERVICE_MD5.items())
def test_the_md5_sum_of_a_service_is_the_published_one(name, md5):
    assert load_service(name)._md5sum == md5


def test_md5_sums_are_those_of_rosbags():
    typesys = pytest.importorskip("rosbags.typesys", reason="rosbags is not installed")
    store = typesys.get_typestore(typesys.Stores.ROS1_NOETIC)
    compared = 0
    for theirs in store.types:
        package, _, name = theirs.split("/")
        if package == "builtin_interfaces":
            continue
        ours = load_message(f"{package}/{name}")._md5sum
        assert ours == store.generate_msgdef(theirs, ros_version=1)[1], theirs
        compared += 1
    assert compared >= 160


@pytest.mark.slow
def test_md5_sums_are_those_of_genpy(genpy):
    for name in definitions():
        ours = load_message(name)
        assert ours._md5sum == genpy.class_of(ours)._md5sum, name


def test_the_full_text_of_every_type_gives_the_same_type_again():
    for name in definitions():
        made = load_message(name)
        again = class_from_text(name, made._full_text)
        assert (again._md5sum, again._slot_types) == (made._md5sum, made._slot_types), name
        assert again._full_text == made._full_text


def test_definitions_of_public_packages_are_those_that_come_with_gazelle(corpus):
    compared = 0
    for path in sorted(corpus.glob("*/**/*.msg")) + sorted(corpus.glob("*/**/*.srv")):
        package = path.parent.parent.name.rpartition("__")[2]
        name, text = f"{package}/{path.stem}", path.read_text()
        if path.suffix == ".msg":
            if name not in definitions():
                continue
            theirs, ours = [parse_message(name, text)], [load_message(name)]
        else:
            if name not in definitions("srv"):
                continue
            service, spec = load_service(name), parse_service(name, text)
            theirs = [spec.request, spec.response]
            ours = [service._request_class, service._response_class]
        for spec, made in zip(theirs, ours, strict=True):
            assert made._spec.fields == spec.fields, name
            assert made._spec.constants == spec.constants, name
        compared += 1
    assert compared > 50


@pytest.mark.parametrize(
    "line",
    [
        "int32",
        "int32 a b",
        "int32 1a",
        "int32 a-b",
        "int32[ a",
        "int32[x] a",
        "int32[2][2] a",
        "int32[-1] a",
        "a/b/c d",
        "/a b",
        "int32[99999999999] a",
        "time T=3",
        "Point P=3",
        "int8 A=128",
        "uint8 A=-1",
        "int8 A=1.5",
        "int8 A=",
        "int8 A=1=2",
        "float32 A=x",
        "bool A=maybe",
        "int32 a\nint8 a",
        "int32 a\nint8 a=1",
        "=",
        "int32 é",
    ],
)
def test_a_malformed_definition_is_an_error_that_names_the_line(line):
    with pytest.raises(InvalidDefinitionError) as caught:
        parse_message("sample_msgs/Wrong", "# first\n" + line, file="Wrong.msg")
    assert "Wrong.msg" in str(caught.value)


@given(st.text(alphabet=string.ascii_letters + string.digits + " \n\t#=[]/-_.'\"", max_size=60))
def test_any_text_is_a_definition_or_an_error(text):
    try:
        spec = parse_message("sample_msgs/Any", text)
    except InvalidDefinitionError:
        return
    assert all(field.name.isidentifier() for field in spec.fields)


def random_definition(rng: random.Random) -> str:
    lines = []
    for index in range(rng.randint(0, 8)):
        brackets = rng.choice(["", "", "[]", "[3]"])
        base = rng.choice([*sorted(SCALARS), "string", "time", "duration", "Header"])
        base = rng.choice([base, "geometry_msgs/Pose", "Vector3"])
        gap = " " * rng.randint(1, 3)
        comment = rng.choice(["", "# text", " # int32 x=3"])
        lines.append(f"{base}{brackets if base != 'Header' else ''}{gap}field_{index}{comment}")
    for index in range(rng.randint(0, 4)):
        type_ = rng.choice(sorted(CONSTANT_TYPES))
        value = {"string": " a # b ", "bool": "True", "float32": " 1.50", "float64": "-2e3 "}
        lines.append(f"{type_} NAME_{index}={value.get(type_, ' 7 ')}")
    rng.shuffle(lines)
    return rng.choice(["", "\n", "# start\n"]) + "\n".join(lines) + rng.choice(["", "\n"])


@pytest.mark.long
@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_the_md5_sum_of_any_definition_is_genpys(genpy, seed):
    text = random_definition(random.Random(seed))
    package, name = "geometry_msgs", f"Random{seed}"
    register(package, name, text, "msg")
    ours = load_message(f"{package}/{name}")
    theirs = genpy.class_of(ours)
    assert ours._md5sum == theirs._md5sum
    assert ours._full_text == theirs._full_text
    assert (ours.__slots__, ours._slot_types) == (theirs.__slots__, theirs._slot_types)
    assert ours._has_header == theirs._has_header
    for each in ours._spec.constants:
        assert getattr(ours, each.name) == getattr(theirs, each.name)


def test_a_full_text_has_each_type_once_under_its_line():
    text = load_message("nav_msgs/Odometry")._full_text
    heads = re.findall(r"^={80}\nMSG: (\S+)$", text, re.MULTILINE)
    assert len(set(heads)) == len(heads)
    assert "geometry_msgs/Quaternion" in heads


def test_an_action_stands_for_seven_messages():
    text = "int32 order\n---\nint32[] sequence\n---\nint32[] partial\n"
    register("sample_msgs", "Count", text)
    kinds = ("Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback", "Action")
    made = {kind: load_message(f"sample_msgs/Count{kind}") for kind in kinds}
    assert made["Goal"].__slots__ == ["order"]
    assert made["ActionResult"]._slot_types == [
        "std_msgs/Header",
        "actionlib_msgs/GoalStatus",
        "sample_msgs/CountResult",
    ]
    assert "sample_msgs/Count" in definitions("action")


def test_a_definition_on_the_package_path_is_found_and_wins(tmp_path, monkeypatch):
    package = tmp_path / "deep" / "kobuki_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "srv").mkdir()
    (package / "package.xml").write_text("<package><name>kobuki_msgs</name></package>")
    (package / "msg" / "Horn.msg").write_text("float64 volume  # dB\r\n")
    (package / "srv" / "Blow.srv").write_text("Horn horn\n---\nbool heard\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    assert load_message("kobuki_msgs/Horn")(3.0).volume == 3.0
    assert load_service("kobuki_msgs/Blow")._response_class.__slots__ == ["heard"]
    assert load_message("kobuki_msgs/Led").__slots__ == ["value"]
    assert "kobuki_msgs/Horn" in definitions()


def test_the_package_path_may_lead_in_circles_and_hold_malformed_actions(tmp_path, monkeypatch):
    package = tmp_path / "odd_msgs"
    (package / "action").mkdir(parents=True)
    (package / "msg").mkdir()
    (package / "package.xml").write_text("no xml")
    (package / "action" / "Half.action").write_text("int32 a\n---\n")
    (package / "msg" / "Good.msg").write_text("int32 a")
    (tmp_path / "circle").symlink_to(tmp_path)
    (tmp_path / "shut").mkdir()
    (tmp_path / "shut" / "CATKIN_IGNORE").touch()
    (tmp_path / "shut" / "package.xml").touch()
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path}{os.pathsep}{tmp_path / 'missing'}")
    assert find_packages() == {"odd_msgs": package}
    with pytest.warns(FormatWarning, match="Half.action"):
        assert load_message("odd_msgs/Good")(3).a == 3


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("std_msgs/Sring", "did you mean 'String'"),
        ("nowhere_msgs/String", "ROS_PACKAGE_PATH"),
        ("String", "write the package too"),
        ("", "write the package too"),
        ("a/b/c", "a"),
    ],
)
def test_an_unknown_type_is_an_error_with_a_hint(name, said):
    with pytest.raises(UnknownTypeError, match=said):
        load_message(name)


def test_a_message_that_contains_itself_is_an_error():
    register("sample_msgs", "Snake", "Tail tail")
    register("sample_msgs", "Tail", "Snake[] snakes")
    with pytest.raises(InvalidDefinitionError, match="Snake > sample_msgs/Tail"):
        load_message("sample_msgs/Snake")


def test_registering_a_type_again_changes_it_and_those_that_contain_it():
    register("sample_msgs", "Part", "int32 a")
    register("sample_msgs", "Whole", "Part part")
    register("sample_msgs", "Ask", "Part part\n---\n")
    before = load_message("sample_msgs/Whole"), load_service("sample_msgs/Ask")
    register("sample_msgs", "Part", "int32 a\nint32 b")
    after = load_message("sample_msgs/Whole"), load_service("sample_msgs/Ask")
    assert before[0]._md5sum != after[0]._md5sum
    assert before[1]._md5sum != after[1]._md5sum
    assert after[0]().part.b == 0


@pytest.mark.long
@given(name=st.text(min_size=1).filter(lambda text: not text.isprintable()))
@example(name="\0")
@example(name="std_msgs/Str\0ing")
@example(name="std_msgs/\ud800")
@example(name="std_msgs/Int\n")
def test_a_name_that_cannot_be_printed_is_no_name(name):
    """Python makes no class of it; damaged bags and odd peers have such names."""
    with pytest.raises((InvalidDefinitionError, UnknownTypeError)):
        class_from_text(name, "int32 a\n")


@pytest.mark.parametrize("name", ["std_msgs/Str ing", "p-q/R", "straße/Maß"])
def test_odd_names_that_can_be_printed_are_read(name):
    made = class_from_text(name, "int32 a\n")
    assert made._type == name
    assert made().deserialize(b"\1\0\0\0").a == 1


def test_fixed_arrays_within_fixed_arrays_are_limited():
    """A new message has all of their elements, which is more than memory holds."""
    for place in range(9):
        inner = f"Nest{place + 1}[10] inner\n" if place < 8 else "int32 x\n"
        register("nests", f"Nest{place}", inner)
    assert len(load_message("nests/Nest4")().inner) == 10
    with pytest.raises(InvalidDefinitionError, match=r"nests/Nest0 has 100,000,000 elements"):
        load_message("nests/Nest0")
