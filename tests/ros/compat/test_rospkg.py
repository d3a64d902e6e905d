"""Interfaces of rospkg and rosgraph that programs use."""

import importlib
import os
from pathlib import Path

import pytest
from whole import needs_gazelle

import gazelle_ros as ros
from gazelle_ros.builtin.rospack import main as rospack
from gazelle_ros.messages import search

MANIFEST = """<package format="2"><name>{name}</name><version>1.2.3</version>
<description>A robot</description><license>BSD</license><author>Ann</author>
{depends}<export><robot plugin="x.xml"/></export></package>"""


@pytest.fixture
def rospkg(tmp_path, monkeypatch):
    for name, needs in {"arm": ["hand", "boost"], "hand": ["finger"], "finger": []}.items():
        folder = tmp_path / "src" / name
        folder.mkdir(parents=True)
        depends = "".join(f"<depend>{each}</depend>" for each in needs)
        (folder / "package.xml").write_text(MANIFEST.format(name=name, depends=depends))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.delenv("ROS_ROOT", raising=False)
    with ros.install():
        yield importlib.import_module("rospkg")


def test_packages_are_listed_and_found(rospkg, tmp_path):
    pack = rospkg.RosPack()
    assert {"arm", "finger", "hand"} <= set(pack.list())
    assert pack.get_path("arm") == str(tmp_path / "src" / "arm")
    assert rospkg.RosPack.get_instance().get_path("hand") == pack.get_path("hand")
    assert rospkg.RosPack(ros_paths=[str(tmp_path / "none")]).list() == []
    assert sorted(rospkg.RosPack(ros_paths=[str(tmp_path)]).list()) == ["arm", "finger", "hand"]
    assert rospkg.RosStack().list() == []


def test_all_that_is_listed_is_found_and_rospack_lists_the_same(rospkg, capsys):
    pack = rospkg.RosPack()
    listed = pack.list()
    assert {"arm", "std_msgs", "tf", "topic_tools", "twist_mux"} <= set(listed)
    assert listed == sorted(listed)
    assert rospack(["list-names"]) == 0
    assert capsys.readouterr().out.split() == listed
    assert rospack(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines == [f"{name} {pack.get_path(name)}" for name in listed]
    for name in listed:
        assert pack.get_manifest(name).name == name


def test_a_missing_package_is_named_with_the_places(rospkg, tmp_path):
    with pytest.raises(rospkg.ResourceNotFound) as raised:
        rospkg.RosPack().get_path("leg")
    assert str(raised.value) == f"leg\nROS path [0]={tmp_path / 'src'}"
    common = importlib.import_module("rospkg.common")
    assert common.ResourceNotFound is rospkg.ResourceNotFound


def test_a_manifest_tells_what_it_holds(rospkg):
    manifest = rospkg.RosPack().get_manifest("arm")
    assert (manifest.name, manifest.version, manifest.license) == ("arm", "1.2.3", "BSD")
    assert [each.name for each in manifest.depends] == ["hand", "boost"]
    assert manifest.get_export("robot", "plugin") == ["x.xml"]


def test_a_broken_manifest_is_an_error(rospkg, tmp_path):
    (tmp_path / "src/arm/package.xml").write_text("<package><name>arm</name>")
    with pytest.raises(rospkg.InvalidManifest, match=r"package\.xml"):
        importlib.import_module("rospkg.manifest").parse_manifest_file(str(tmp_path / "src/arm"))


def test_dependencies_are_followed(rospkg):
    pack = rospkg.RosPack()
    assert pack.get_depends("arm") == ["hand", "boost", "finger"]
    assert pack.get_depends("arm", implicit=False) == ["hand", "boost"]
    assert sorted(pack.get_depends_on("finger")) == ["arm", "hand"]
    assert pack.get_depends_on("finger", implicit=False) == ["hand"]
    assert pack.get_rosdeps("arm") == ["boost"]


def test_the_package_of_a_file_is_found(rospkg, tmp_path):
    file = tmp_path / "src/arm/scripts/run.py"
    file.parent.mkdir()
    file.touch()
    assert rospkg.get_package_name(str(file)) == "arm"
    assert rospkg.get_package_name(str(tmp_path)) is None
    assert rospkg.on_ros_path(str(file))
    assert not rospkg.on_ros_path(str(tmp_path / "elsewhere"))


def test_names_are_told_from_packages(rospkg, tmp_path):
    pack = rospkg.RosPack()
    assert rospkg.expand_to_packages(["arm", "leg"], pack, rospkg.RosStack()) == (["arm"], ["leg"])
    cache = {}
    assert sorted(rospkg.list_by_path("package.xml", str(tmp_path), cache)) == sorted(cache)
    assert cache["arm"] == str(tmp_path / "src" / "arm")


def test_folders_follow_the_environment(rospkg, monkeypatch):
    environment = importlib.import_module("rospkg.environment")
    monkeypatch.delenv("ROS_HOME", raising=False)
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    assert rospkg.get_ros_home() == str(Path.home() / ".ros")
    assert environment.get_log_dir() == str(Path.home() / ".ros" / "log")
    given = {"ROS_HOME": "/h", "ROS_ROOT": "/r", "ROS_PACKAGE_PATH": os.pathsep.join(["/a", "/b"])}
    assert rospkg.get_ros_home(given) == "/h"
    assert rospkg.get_log_dir(given) == str(Path("/h/log"))
    assert rospkg.get_test_results_dir(given) == str(Path("/h/test_results"))
    assert rospkg.get_ros_paths(given) == ["/r", "/a", "/b"]
    assert rospkg.get_ros_root({}) is None


@pytest.fixture
def rosgraph(rospy):
    return importlib.import_module("rosgraph")


def test_the_master_can_be_asked(rosgraph, master):
    assert rosgraph.is_master_online()
    asked = rosgraph.Master("/asker")
    assert asked.getUri() == master.uri
    assert asked.getPid() == os.getpid()
    asked.setParam("/x", [1, "two"])
    assert asked.getParam("/x") == [1, "two"]
    assert asked.hasParam("/x")
    assert asked.searchParam("x") == "/x"
    asked.deleteParam("/x")
    with pytest.raises(rosgraph.masterapi.MasterError):
        asked.getParam("/x")
    assert asked.is_online()


def test_an_absent_master_is_told(rosgraph):
    assert not rosgraph.is_master_online("http://127.0.0.1:1/")


def test_graph_names_are_judged_and_resolved(rosgraph):
    names = importlib.import_module("rosgraph.names")
    assert names.is_global("/a")
    assert names.is_private("~a")
    assert names.is_legal_name("a/b_c")
    assert not names.is_legal_name("1a")
    assert not names.is_legal_base_name("a/b")
    assert names.ns_join("/a", "b") == "/a/b"
    assert names.ns_join("/a", "~b") == "~b"
    assert names.namespace("/a/b/c") == "/a/b/"
    assert names.canonicalize_name("/a//b/") == "/a/b"
    assert names.resolve_name("b", "/a/n") == "/a/b"
    assert names.resolve_name("~b", "/a/n") == "/a/n/b"
    assert names.make_global_ns("a") == "/a/"
    assert names.load_mappings(["x:=y", "z", "_p:=1"]) == {"x": "y"}
    assert names.anonymous_name("n").startswith("n_")


def test_addresses_are_read(rosgraph, monkeypatch):
    network = importlib.import_module("rosgraph.network")
    assert network.parse_http_host_and_port("http://there:123/") == ("there", 123)
    assert network.parse_http_host_and_port("http://there") == ("there", 80)
    with pytest.raises(ValueError, match="not a valid URL"):
        network.parse_http_host_and_port("nonsense")
    monkeypatch.setenv("ROS_IP", "127.0.0.5")
    monkeypatch.delenv("ROS_HOSTNAME", raising=False)
    assert network.get_host_name() == "127.0.0.5"
    assert rosgraph.get_master_uri({"ROS_MASTER_URI": "http://a:1"}) == "http://a:1"


@pytest.mark.parametrize(
    "name",
    [
        "robot_state_publisher", "map_server", "tf", "tf2_ros", "controller_manager", "rospy",
        "roscpp", "std_msgs", "sensor_msgs", "gazebo_msgs", "gazebo_plugins", "xacro",
        "joint_state_publisher", "actionlib", "rostopic", "roslaunch", "topic_tools",
        "effort_controllers", "joint_trajectory_controller",
        *(
            pytest.param(name, marks=needs_gazelle)
            for name in ("gazebo_ros", "stage_ros", "turtlebot3_description")
        ),
    ],
)  # fmt: skip
def test_what_is_built_in_has_a_folder_with_its_manifest(rospkg, name, monkeypatch, tmp_path):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    pack = rospkg.RosPack()
    folder = pack.get_path(name)
    assert Path(folder, "package.xml").is_file()
    assert pack.get_manifest(name).name == name
    mine = tmp_path / "deep" / name
    mine.mkdir(parents=True)
    (mine / "package.xml").write_text(f"<package><name>{name}</name></package>")
    search.forget()
    assert rospkg.RosPack().get_path(name) == str(mine)
    search.forget()


@pytest.mark.parametrize("name", ["", ".", "..", "../xacro", "no_such_package"])
def test_what_nobody_has_is_not_found(rospkg, name):
    with pytest.raises(rospkg.ResourceNotFound):
        rospkg.RosPack().get_path(name)
