"""Files are found where the tools of ROS and Gazebo find them, and nowhere else."""

import os
import shutil
import subprocess

import pytest

from gazelle import FormatError, ResolveError, formats
from gazelle.formats import Resolver
from gazelle_ros.launch.packages import Packages


def model(folder, name):
    place = folder / name
    place.mkdir(parents=True)
    (place / "model.config").write_text(
        "<model><name>x</name><sdf version='1.6'>model.sdf</sdf></model>"
    )
    (place / "model.sdf").write_text(
        f"<sdf version='1.6'><model name='{name}'><link name='l'/></model></sdf>"
    )
    (place / "a.stl").write_bytes(b"")
    return place


def package(folder, name, export=""):
    place = folder / name
    place.mkdir(parents=True)
    (place / "package.xml").write_text(
        f"<package><name>{name}</name><export>{export}</export></package>"
    )
    return place


@pytest.mark.parametrize("variable", ["GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"])
def test_models_are_found_through_the_environment(tmp_path, variable):
    place = model(tmp_path / "far", "thing")
    resolver = Resolver(environ={variable: f"/none:{tmp_path / 'far'}"})
    assert resolver.find("model://thing/a.stl") == place / "a.stl"
    assert Resolver(environ={}).find("model://thing/a.stl") is None


def test_given_paths_go_before_the_environment(tmp_path):
    first, second = model(tmp_path / "1", "thing"), model(tmp_path / "2", "thing")
    environ = {"GAZEBO_MODEL_PATH": str(tmp_path / "2")}
    assert Resolver(environ=environ).model("thing") == second
    assert Resolver([tmp_path / "1"], environ).model("thing") == first


def test_packages_are_found_through_ros_package_path(tmp_path):
    place = package(tmp_path / "ws" / "src" / "stack", "robot")
    (place / "m.stl").write_bytes(b"")
    resolver = Resolver(environ={"ROS_PACKAGE_PATH": str(tmp_path / "ws")})
    assert resolver.find("package://robot/m.stl") == place / "m.stl"
    assert resolver.find("model://robot/m.stl") == place / "m.stl"


def test_packages_are_called_as_their_package_xml_says(tmp_path):
    place = package(tmp_path, "folder")
    (place / "package.xml").write_text("<package><name>real</name></package>")
    resolver = Resolver([tmp_path], {})
    assert resolver.package("real") == place
    assert resolver.package("folder") is None


def tree(root, layout):
    """Create packages of one name at places; ``CATKIN_IGNORE`` and the like are files."""
    for place in layout:
        folder, _, last = place.rpartition("/")
        if last.isupper() or last == "rospack_nosubdirs":
            (root / folder).mkdir(parents=True, exist_ok=True)
            (root / place).touch()
        else:
            package(root / folder, last)


CRAWLS = {
    "the first root wins, however deep": (["a/src/deep/er/robot", "b/robot"], "a:b"),
    "of the other order too": (["a/src/deep/er/robot", "b/robot"], "b:a"),
    "a root may be the package": (["a/x/robot", "b/robot"], "b/robot:a"),
    "ignored folders": (["a/x/robot", "a/x/CATKIN_IGNORE", "b/robot"], "a:b"),
    "an ignored package": (["a/robot", "a/robot/CATKIN_IGNORE", "b/robot"], "a:b"),
    "an ignored root": (["a/robot", "a/CATKIN_IGNORE", "b/robot"], "a:b"),
    "no deeper": (["a/x/y/robot", "a/x/rospack_nosubdirs", "b/robot"], "a:b"),
    "hidden folders": (["a/.x/robot", "b/robot"], "a:b"),
    "not inside of another package": (["a/other", "a/other/in/robot", "b/robot"], "a:b"),
    "folders that build": (["a/build/robot", "b/robot"], "a:b"),
    "a root that is not there": (["b/robot"], "a:b"),
    "nowhere": (["a/x/robot", "a/x/CATKIN_IGNORE"], "a:b"),
}


@pytest.mark.parametrize(("layout", "path"), CRAWLS.values(), ids=CRAWLS)
def test_packages_are_found_alike_by_files_launch_files_and_folders(tmp_path, layout, path):
    tree(tmp_path, layout)
    roots = [str(tmp_path / root) for root in path.split(":")]
    environ = {"ROS_PACKAGE_PATH": ":".join(roots)}
    found = Resolver(environ=environ).package("robot")
    assert found == Packages(environ).find("robot")  # $(find) means the same
    assert Resolver(roots, {}).package("robot") == found


@pytest.mark.ros
@pytest.mark.parametrize(("layout", "path"), CRAWLS.values(), ids=CRAWLS)
def test_packages_are_those_that_rospack_finds(tmp_path, layout, path):
    tree(tmp_path, layout)
    environ = {"ROS_PACKAGE_PATH": ":".join(str(tmp_path / root) for root in path.split(":"))}
    found = Resolver(environ=environ).package("robot")
    if shutil.which("rospack") is None:
        pytest.skip("the real rospack is not installed (Debian: rospack-tools)")
    command = ["rospack", "find", "robot"]
    home = {"PATH": os.environ["PATH"], "ROS_HOME": str(tmp_path / "home")}
    run = subprocess.run(
        command, capture_output=True, text=True, check=False, env={**environ, **home}
    )
    assert run.stdout.strip() == ("" if found is None else str(found))


def test_a_package_that_is_a_link_in_a_workspace_can_be_read(tmp_path):
    place = package(tmp_path / "elsewhere" / "deep", "robot")
    (place / "m.stl").write_bytes(b"")
    (tmp_path / "ws" / "src").mkdir(parents=True)
    (tmp_path / "ws" / "src" / "mine").symlink_to(place)
    resolver = Resolver(environ={"ROS_PACKAGE_PATH": str(tmp_path / "ws" / "src")})
    assert resolver.find("package://robot/m.stl").samefile(place / "m.stl")
    resolver.look_around(tmp_path / "far" / "a.urdf")
    assert resolver.find("package://robot/m.stl").samefile(place / "m.stl")


def test_exports_of_packages_name_folders_of_models(tmp_path):
    place = package(tmp_path / "ws", "sim", "<gazebo_ros gazebo_model_path='${prefix}/deep/er'/>")
    thing = model(place / "deep" / "er", "thing")
    worlds = place / "worlds"
    worlds.mkdir()
    assert Resolver(environ={}, file=worlds / "a.world").model("thing") == thing


def test_siblings_of_the_file_are_found(tmp_path):
    thing = model(tmp_path / "repo" / "models", "thing")
    worlds = tmp_path / "repo" / "worlds"
    worlds.mkdir()
    assert Resolver(environ={}, file=worlds / "a.world").model("thing") == thing


def test_relative_and_absolute_paths_stay_in_the_neighbourhood(tmp_path):
    repo = tmp_path / "a" / "b" / "c" / "d" / "e"
    (repo / "urdf").mkdir(parents=True)
    (repo / "mesh.stl").write_bytes(b"")
    (tmp_path / "far.stl").write_bytes(b"")
    resolver = Resolver(environ={}, file=repo / "urdf" / "r.urdf")
    base = repo / "urdf"
    assert resolver.find("../mesh.stl", base).samefile(repo / "mesh.stl")
    assert resolver.find(f"file://{repo}/mesh.stl") == repo / "mesh.stl"
    assert resolver.find("file:///etc/passwd") is None
    assert resolver.find("/etc/passwd") is None
    assert resolver.find(str(tmp_path / "far.stl")) is None
    assert resolver.find("../../../../../../far.stl", base) is None


def test_links_out_of_the_neighbourhood_are_not_followed(tmp_path):
    repo = tmp_path / "a" / "b" / "c" / "d" / "e"
    repo.mkdir(parents=True)
    (tmp_path / "secret.stl").write_bytes(b"")
    (repo / "link.stl").symlink_to(tmp_path / "secret.stl")
    assert Resolver(environ={}, file=repo / "r.urdf").find("link.stl", repo) is None


@pytest.mark.parametrize("uri", ["model://../x", "package://..", "model://", "\0", "file://\0", ""])
def test_odd_uris_lead_nowhere_or_to_a_folder_that_may_be_read(tmp_path, uri):
    resolver = Resolver([tmp_path], {})
    found = resolver.find(uri, tmp_path)
    assert found is None or resolver.readable(found)


def test_sun_and_ground_plane_are_always_there():
    resolver = Resolver(environ={})
    for name in ("sun", "ground_plane"):
        assert (resolver.find(f"model://{name}") / "model.config").is_file()


def test_a_model_on_disk_stands_in_for_one_on_a_network(tmp_path):
    place = model(tmp_path, "Thing")
    resolver = Resolver([tmp_path], {})
    assert resolver.find("https://fuel.example.org/1.0/me/models/Thing") == place
    assert resolver.find("https://fuel.example.org/1.0/me/models/Thing/tip/files/a.stl") == (
        place / "a.stl"
    )


def test_a_model_folder_is_loaded_as_its_model_config_says(tmp_path):
    place = model(tmp_path, "thing")
    assert formats.load_model(place).name == "thing"
    world = tmp_path / "w.world"
    world.write_text(
        "<sdf version='1.6'><world name='w'><include><uri>model://thing</uri><name>mine</name>"
        "<pose>1 0 0 0 0 0</pose><static>1</static></include></world></sdf>"
    )
    found = formats.load(world).models[0]
    assert (found.name, found.static, found.pose.x) == ("mine", True, 1.0)


def test_of_several_versions_the_newest_is_loaded(tmp_path):
    place = model(tmp_path, "thing")
    (place / "old.sdf").write_text("<sdf version='1.4'><model name='old'/></sdf>")
    (place / "model.config").write_text(
        "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.10'>model.sdf</sdf></model>"
    )
    assert formats.load_model(place).name == "thing"


def test_bundled_models_worlds_and_robots_load_by_name():
    assert formats.load_model("ground_plane").static
    assert next(m.name for m in formats.load("turtlebot3_stage_1").models) == "ground_plane"
    assert formats.load_model("turtlebot3_burger").links


def test_bundled_files_load_by_the_file_name_too(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert len(formats.load("fleet.world").content.robots) == 72
    assert formats.load_model("turtlebot3_burger.urdf.xacro").links
    (tmp_path / "fleet.world").write_text("position ( )")
    assert len(formats.load("fleet.world").content.robots) == 1


def test_a_folder_that_is_no_model_does_not_hide_what_is_bundled(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    (tmp_path / "own").mkdir()
    assert formats.load("empty").models
    with pytest.raises(FormatError, match=r"has no model\.config"):
        formats.load("own")
    (tmp_path / "empty" / "model.config").write_text("<model/>", encoding="utf-8")
    with pytest.raises(FormatError, match="<sdf> element"):
        formats.load("empty")


@pytest.mark.long
def test_every_bundled_name_loads_without_a_warning():
    names = formats.loader.bundled_names(Resolver().assets)
    assert {"turtlebot3_burger", "turtlebot3_stage_4", "empty"} <= set(names)
    for name in names:
        assert formats.load(name).source is not None


def test_an_unknown_name_is_an_error_with_a_suggestion():
    with pytest.raises(ResolveError) as caught:
        formats.load("ground_plan")
    assert caught.value.hint == "did you mean 'ground_plane'?"


def test_a_path_to_nothing_says_what_is_there(tmp_path):
    (tmp_path / "hall.world").touch()
    with pytest.raises(ResolveError, match=r"did you mean 'hall\.world'"):
        formats.load(tmp_path / "hal.world")
    with pytest.raises(ResolveError, match=r"there is no folder .*nowhere"):
        formats.load(tmp_path / "nowhere" / "hall.world")


def test_a_file_that_includes_itself_is_an_error(tmp_path):
    place = model(tmp_path, "thing")
    (place / "model.sdf").write_text(
        "<sdf version='1.6'><model name='m'><include><uri>model://thing</uri></include>"
        "</model></sdf>"
    )
    with pytest.raises(formats.loader.FormatError, match="includes itself"):
        formats.load(place)


def test_the_folder_of_a_user_there_is_not_is_no_file(tmp_path):
    assert Resolver().find("~no_such_user_here/map.png", tmp_path) is None


def test_packages_beside_a_deeply_nested_one_are_found(tmp_path):
    place = package(tmp_path / "ws" / "src" / "family" / "arms", "arm")
    meshes = package(tmp_path / "ws" / "src" / "shared meshes", "meshes")
    (meshes / "Größe 1.STL").write_bytes(b"")
    file = place / "urdf" / "parts" / "arm.urdf"
    file.parent.mkdir(parents=True)
    resolver = Resolver(environ={}, file=file)
    assert resolver.find("package://meshes/Größe 1.STL") == meshes / "Größe 1.STL"
    assert resolver.find("model://meshes/Gr%C3%B6%C3%9Fe%201.STL") == meshes / "Größe 1.STL"


@pytest.mark.parametrize(
    ("uri", "hint"),
    [
        ("package://robo/Meshes/a.stl", "did you mean 'meshes/A.STL'?"),
        ("package://robo/meshs/A.STL", "did you mean 'meshes'?"),
        ("package://robo/meshes/wheel.dae", "there is no such file in "),
        ("model://rbo/meshes/A.STL", "did you mean 'robo'?"),
        ("rbo", "did you mean 'robo'?"),
        ("robo/Meshes/A.STL", "did you mean 'robo/meshes/A.STL'?"),
        ("file://{folder}/robo/meshes/a.STL", "meshes/A.STL'?"),
        ("package:///rbo/meshes/A.STL", "write package://NAME/FILE"),
        ("file://$(find robo)/meshes/A.STL", "only xacro and launch files expand $(...)"),
        ("https://example.org/A.STL", "network addresses are never fetched"),
        ("zzyzx.qqq", "looked beside the file"),
    ],
)
def test_what_is_not_found_is_named_with_what_is_close(tmp_path, uri, hint):
    place = package(tmp_path, "robo")
    (place / "meshes").mkdir()
    (place / "meshes" / "A.STL").write_bytes(b"")
    resolver = Resolver(environ={}, file=tmp_path / "robot.urdf")
    uri = uri.replace("{folder}", str(tmp_path))
    assert resolver.find(uri, tmp_path) is None
    assert hint in resolver.looked_in(uri, tmp_path)


def test_a_file_that_may_not_be_read_is_said_to_be_there(tmp_path):
    (tmp_path / "far" / "off").mkdir(parents=True)
    (tmp_path / "far" / "off" / "a.stl").write_bytes(b"")
    resolver = Resolver([tmp_path / "near"], environ={})
    hint = resolver.looked_in(f"file://{tmp_path}/far/off/a.stl")
    assert "lies outside of the folders that may be read" in hint
