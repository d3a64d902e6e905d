"""Messages as modules, `gazelle_ros.msgs`, and their stubs."""

import subprocess
import sys

import message_stubs
import pytest

import gazelle_ros.msgs
from gazelle_ros import load_message, load_service
from gazelle_ros.messages import register
from gazelle_ros.messages.library import bundled, bundled_packages
from gazelle_ros.msgs import geometry_msgs, std_msgs, std_srvs


def test_classes_are_those_of_load_message():
    assert geometry_msgs.msg.Twist is load_message("geometry_msgs/Twist")
    assert std_srvs.srv.SetBool is load_service("std_srvs/SetBool")
    assert std_srvs.srv.SetBoolRequest is std_srvs.srv.SetBool._request_class


def test_import_lines_of_scripts_work_with_the_prefix():
    from gazelle_ros.msgs.geometry_msgs.msg import Pose, PoseStamped
    from gazelle_ros.msgs.std_srvs.srv import Trigger, TriggerResponse

    assert PoseStamped().pose == Pose()
    assert Trigger._response_class is TriggerResponse


def test_foreign_names_are_left_alone():
    code = (
        "import sys; from gazelle_ros.msgs import std_msgs; std_msgs.msg.String();"
        "assert 'std_msgs' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("folder", ["msg", "msg/generated/arm"])
def test_packages_on_the_path_can_be_imported(tmp_path, monkeypatch, folder):
    (tmp_path / "my_msgs" / folder).mkdir(parents=True)
    (tmp_path / "my_msgs" / "package.xml").write_text("<package><name>my_msgs</name></package>")
    (tmp_path / "my_msgs" / folder / "Ping.msg").write_text("int32 count\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    from gazelle_ros.msgs import my_msgs

    assert my_msgs.msg.Ping(count=3).count == 3


def test_modules_follow_new_definitions():
    register("freshly_msgs", "Part", "int32 a")
    register("freshly_msgs", "Whole", "Part part")
    register("freshly_msgs", "Ask", "Part part\n---\n")
    from gazelle_ros.msgs import freshly_msgs

    assert freshly_msgs.msg.Whole().part == freshly_msgs.msg.Part(a=0)
    old = freshly_msgs.srv.AskRequest
    register("freshly_msgs", "Part", "int32 a\nint32 b")
    assert freshly_msgs.msg.Part(a=1, b=2).b == 2
    assert freshly_msgs.msg.Whole(part=freshly_msgs.msg.Part(b=3)).part.b == 3
    assert freshly_msgs.srv.AskRequest is not old
    assert freshly_msgs.srv.AskRequest is load_service("freshly_msgs/Ask")._request_class
    register("freshly_msgs", "Later", "int32 c")
    assert freshly_msgs.msg.Later(c=1).c == 1


def test_importing_a_package_reads_no_definitions():
    code = (
        "from gazelle_ros.messages.library import bundled;"
        "from gazelle_ros.msgs import geometry_msgs, std_srvs;"
        "assert bundled.cache_info().currsize == 0; geometry_msgs.msg.Twist();"
        "assert bundled.cache_info().currsize == 1"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("geometri_msgs", "geometry_msgs"),
        ("geometry_msgs.msgs", "No module"),
        ("std_srvs.msg", "No module"),
    ],
)
def test_unknown_modules_are_not_found(name, hint):
    with pytest.raises(ModuleNotFoundError, match=hint):
        __import__(f"gazelle_ros.msgs.{name}")


def test_unknown_classes_are_no_attributes():
    with pytest.raises(AttributeError, match="Twst"):
        _ = geometry_msgs.msg.Twst
    with pytest.raises(AttributeError, match="srv"):
        _ = geometry_msgs.srv


def test_names_complete():
    assert {"geometry_msgs", "std_srvs"} <= set(dir(gazelle_ros.msgs))
    assert {"Header", "String"} <= set(dir(std_msgs.msg))


def test_stubs_are_up_to_date():
    written = {
        path.relative_to(message_stubs.FOLDER).as_posix(): path.read_text()
        for path in message_stubs.FOLDER.glob("*/*.pyi")
    }
    assert written == message_stubs.stubs(), "run tools/message_stubs.py"


def test_every_bundled_message_has_a_stub():
    stubs = message_stubs.stubs()
    for package in bundled_packages():
        for kind, known in (("msg", "messages"), ("srv", "services")):
            text = stubs.get(f"{package}/{kind}.pyi", "")
            names = getattr(bundled(package), known)
            assert [name for name in names if f"class {name}(" not in text] == []


SCRIPT = """
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs
from gazelle_ros.msgs.std_srvs.srv import Trigger

twist = geometry_msgs.msg.Twist()
twist.linear.x = 0.5
reveal_type(twist.linear.x)
reveal_type(nav_msgs.msg.Path().poses[0].pose.position)
reveal_type(sensor_msgs.msg.LaserScan(angle_min=1.0).header.stamp.secs)
reveal_type(Trigger._response_class().success)
twist.linear.w = 1.0
geometry_msgs.msg.Point(t=1.0)
"""


@pytest.mark.slow
def test_type_checkers_see_fields(tmp_path):
    mypy = pytest.importorskip("mypy.api")
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    output, _, _ = mypy.run(["--strict", "--cache-dir", str(tmp_path / "cache"), str(script)])
    lines = [line.partition(": ")[2] for line in output.splitlines() if "script.py" in line]
    assert [line for line in lines if "defined in" not in line] == [
        'note: Revealed type is "float"',
        'note: Revealed type is "gazelle_ros.msgs.geometry_msgs.msg.Point"',
        'note: Revealed type is "int"',
        'note: Revealed type is "bool"',
        'error: "Vector3" has no attribute "w"  [attr-defined]',
        'error: Unexpected keyword argument "t" for "Point"  [call-arg]',
    ]
