"""Files saved as SDF are the same when loaded: exactly, in all fields."""

import math
import re
import warnings
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import corpus_table
import libsdformat
import pytest
from hypothesis import HealthCheck, given, settings

from gazelle import Error, FormatError, formats
from gazelle.description import (
    Box,
    Collision,
    Cone,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Light,
    Link,
    Material,
    Mesh,
    Mimic,
    Model,
    Parameters,
    Plugin,
    Pose,
    Sensor,
    Source,
    Visual,
    World,
)
from gazelle.errors import FormatWarning
from gazelle.formats import loader, xml
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver
from tests.formats.strategies import models, poses, worlds

# files of the corpus that miss so much that a model has no link, and is saved as static
LINKLESS = {
    "gazebosim__sdformat/test/sdf/merge_include_with_interface_api_frame_semantics.sdf",
    "gazebosim__sdformat/test/sdf/model_include_with_interface_api.sdf",
    "gazebosim__sdformat/test/sdf/placement_frame.sdf",
    "gazebosim__sdformat/test/sdf/model_invalid_frame_only.sdf",
    "gazebosim__sdformat/test/sdf/model_without_links.sdf",
    "gazebosim__sdformat/test/sdf/nested_without_links_invalid.sdf",
    "elysia-best__gazebo-classic/worlds/iris_arducopter_demo.world",
    "elysia-best__gazebo-classic/worlds/population.world",
    "elysia-best__gazebo-classic/worlds/variable_gearbox_plugin.world",
}
ASSETS = Path(formats.__file__).parents[1] / "assets"
quiet = pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")


def again(content, folder=None):
    return formats.load_string(formats.to_string(content, "sdf", folder=folder))


@pytest.mark.long
@quiet
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(worlds())
def test_every_world_is_the_same_when_loaded_again(world):
    assert again(world) == world


@pytest.mark.long
@quiet
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(models())
def test_every_model_is_the_same_when_loaded_again(model):
    assert again(model).models == (model,)


@settings(max_examples=300, deadline=None)
@given(poses())
def test_poses_keep_their_last_bit(pose):
    found = again(Model("m", pose, links=(Link("l"),))).models[0].pose
    assert (found.position, found.quaternion) == (pose.position, pose.quaternion)


def same_after_saving(path):
    """Return whether a file of the corpus is the same after saving and loading it."""
    world = formats.load(path)
    text = formats.to_string(world, "sdf", folder=path.parent)
    reading = Reading(Resolver())
    with reading.inside(path):
        found = loader.read_root(xml.parse(text, name="again"), reading)
    # SDF does not know package://
    return found == world or repr(found) == repr(world).replace("package://", "model://")


@pytest.mark.long
@quiet
@pytest.mark.corpus
def test_every_sdf_and_urdf_of_the_corpus_is_the_same(corpus):
    paths = corpus_table.files(corpus, "sdf", "world", "urdf")
    different, count = set(), 0
    for path in paths:
        name = str(path.relative_to(corpus))
        if formats_refuses(path):
            continue
        count += 1
        if not same_after_saving(path):
            different.add(name)
    assert count > 400
    assert different == LINKLESS


def formats_refuses(path):
    try:
        formats.load(path)
    except Error:
        return True
    return False


# Stage's worlds are read only: there is no writer for that language.
BUNDLED = sorted(
    path
    for path in (*ASSETS.glob("worlds/*.world"), *ASSETS.glob("models/*/model.sdf"))
    if "<sdf" in path.read_text(encoding="utf-8")
)


@quiet
@pytest.mark.parametrize("path", BUNDLED, ids=str)
def test_bundled_files_are_the_same(path):
    assert same_after_saving(path)


@quiet
@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "turtlebot3_waffle_pi"])
def test_a_robot_from_xacro_is_the_same_as_sdf(name, tmp_path):
    robot = formats.load_model(name)
    formats.save(robot, tmp_path / "robot.sdf")
    assert formats.load_model(tmp_path / "robot.sdf", paths=[ASSETS]) == robot


def test_it_asks_for_no_newer_version_than_it_needs():
    def version(model):
        return xml.parse(formats.to_string(model, "sdf"), name="x").attributes["version"]

    plain = Link("l", Pose(yaw=1.57))
    turned = Link("l", Pose.from_quaternion((0, 0, 0), (0.1, 0.2, 0.3, 0.4)))
    cone = Link("l", collisions=(Collision("c", Cone(1.0, 2.0)),))
    mimic = Joint("j", "revolute", "world", "l", axes=(JointAxis(mimic=Mimic("k")),))
    assert version(Model("m", links=(plain,))) == "1.7"
    assert version(Model("m", links=(turned,))) == "1.7"
    assert version(Model("m", links=(plain,), joints=(mimic,))) == "1.7"
    assert version(Model("m", links=(cone,))) == "1.12"


@pytest.mark.parametrize("suffix", ["sdf", "urdf"])
def test_an_armature_that_no_format_has_is_left_out_with_a_warning(tmp_path, suffix):
    axis = JointAxis(armature=0.2)
    joint = Joint("elbow", "continuous", "a", "b", axes=(axis,))
    model = Model("m", links=(Link("a"), Link("b")), joints=(joint,))
    with pytest.warns(FormatWarning, match="no format has an armature: that of 'elbow'"):
        formats.save(model, tmp_path / f"m.{suffix}")


@quiet
def test_gazebo_classic_can_create_what_is_written():
    """It has no continuous, floating or planar joints, no quaternions and no %20."""
    turned = Pose.from_quaternion((0, 0, 0), (0.1, 0.2, 0.3, 0.4))
    script = Visual("v", Box((1.0, 1.0, 1.0)), material=Material(script="Gazebo/Grey"))
    own = Visual("w", Box((1.0, 1.0, 1.0)), material=Material(script="My/Paint"))
    kinds = ("continuous", "floating", "planar")
    wheel = Mesh("wheel.stl", Path("/some where/wheel.stl"))
    links = (
        Link("a", turned, visuals=(script, own), collisions=(Collision("c", wheel),)),
        *(Link(f"l{n}") for n in range(len(kinds))),
    )
    joints = tuple(
        Joint(kind, kind, "a", f"l{n}", axes=(JointAxis(),) if kind != "floating" else ())
        for n, kind in enumerate(kinds)
    )
    model = Model("m", links=links, joints=joints)
    with pytest.warns(FormatWarning, match="SDF has no"):
        text = formats.to_string(model, "sdf", folder="/elsewhere")
    root = ET.fromstring(text)
    assert [joint.get("type") for joint in root.iter("joint")] == ["revolute"]
    assert not any("rotation_format" in pose.attrib for pose in root.iter("pose"))
    assert all(len(pose.text.split()) == 6 for pose in root.iter("pose"))
    assert root.findtext(".//mesh/uri") == "file:///some where/wheel.stl"
    assert all(node.findtext("uri") for node in root.iter("script"))
    found = formats.load_model_string(text.replace("wheel.stl", "none"))
    assert (found.joints, found.links[0].pose) == (joints, turned)


@pytest.mark.parametrize("changed", [False, True])
def test_angles_changed_by_hand_count_more_than_the_saved_quaternion(changed):
    turned = Pose.from_quaternion((0, 0, 0), (0.1, 0.2, 0.3, 0.4))
    text = formats.to_string(Model("m", links=(Link("l", turned),)), "sdf")
    angles = re.search(r"<pose[^>]*>([^<]*)</pose>", text)[1]
    new = text.replace(angles, "1 2 3 0 0 .5") if changed else text
    found = formats.load_model_string(new).links[0].pose
    assert found == (Pose(1, 2, 3, 0, 0, 0.5) if changed else turned)


def test_colours_changed_by_hand_count_more_than_the_saved_one():
    urdf = (
        "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' "
        "ixy='0' ixz='0' iyz='0'/></inertial><visual><geometry><sphere radius='1'/></geometry>"
        "<material name='m'><color rgba='.4 .2 .8 1'/></material></visual></link></robot>"
    )
    robot = formats.load_model_string(urdf)
    text = formats.to_string(robot, "sdf")
    assert "<diffuse>0.5 0.25 1 1</diffuse>" in text
    assert again(robot).models[0].links[0].visuals[0].material.diffuse == (0.4, 0.2, 0.8, 1.0)
    new = text.replace("<diffuse>0.5 0.25 1 1<", "<diffuse>1 0 0 1<")
    assert formats.load_model_string(new).links[0].visuals[0].material.diffuse == (1, 0, 0, 1)


def test_relative_mesh_names_lead_to_the_same_file_from_elsewhere(tmp_path):
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    (here / "part.stl").write_bytes(bytes(84))
    link = Link("l", collisions=(Collision("c", Mesh("part.stl", here / "part.stl")),))
    model = Model("m", links=(link,))
    for folder, uri in ((here, "part.stl"), (there, f"file://{here}/part.stl")):
        formats.save(model, folder / "m.sdf")
        found = formats.load_model(folder / "m.sdf").links[0].collisions[0].geometry
        assert (found.uri, found.path) == (uri, here / "part.stl")


def test_a_state_that_no_longer_fits_is_left_out_with_a_warning():
    text = (
        "<sdf version='1.7'><world name='w'><model name='m'><link name='l'/></model>"
        "<state world_name='w'><model name='m'><pose>1 0 0 0 0 0</pose></model></state>"
        "</world></sdf>"
    )
    world = formats.load_string(text)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert again(world) == world
    moved = replace(world, models=(replace(world.models[0], pose=Pose(2.0)),))
    with pytest.warns(FormatWarning, match="<state>"):
        assert again(moved).models[0].pose == Pose(2.0)


def test_what_joints_hold_to_the_world_is_static_again_but_not_for_gazebo():
    """Of a static model Gazebo has no joints."""
    text = "<link name='world'/>{0}<joint name='j' type='{1}'><parent link='world'/><child link='a'/></joint>"
    body = (
        "<link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
        "ixz='0' iyz='0'/></inertial></link>"
    )
    for kind, flag, tags in (
        ("fixed", "", {"{urn:gazelle}static"}),
        ("continuous", "", set()),
        ("continuous", "<gazebo><static>true</static></gazebo>", {"static"}),
    ):
        robot = f"<robot name='r'>{text.format(body, kind)}{flag}</robot>"
        found = formats.load_model_string(robot)
        written = formats.to_string(found, "sdf")
        assert formats.load_model_string(written) == found
        children = {child.tag for child in ET.fromstring(written).find("model")}
        assert {tag for tag in children if tag.endswith("static")} == tags


@pytest.mark.parametrize("kind", ["ray", "gpu_ray", "lidar", "gpu_lidar"])
@pytest.mark.parametrize("tag", ["ray", "lidar"])
def test_the_rays_of_a_sensor_keep_the_name_of_their_element(kind, tag):
    """Both are legal in both families, and readers look for one first."""
    world = formats.load_string(
        "<sdf version='1.7'><world name='w'><model name='m'><link name='l'>"
        f"<sensor name='s' type='{kind}'><{tag}><range><min>0.3</min><max>7</max></range>"
        f"<scan><horizontal><samples>5</samples></horizontal></scan></{tag}></sensor>"
        "</link></model></world></sdf>"
    )
    assert again(world) == world
    sensor = ET.fromstring(formats.to_string(world, "sdf")).find("world/model/link/sensor")
    assert {"ray", "lidar"} & {child.tag for child in sensor} == {tag}
    assert sensor.findtext(f"{tag}/range/max") == "7"


@quiet
def test_a_heightmap_keeps_what_it_looks_like():
    looks = (
        "<texture><size>10</size><diffuse>a.png</diffuse><normal>b.png</normal></texture>" * 2
        + "<blend><min_height>2</min_height><fade_dist>5</fade_dist></blend>"
    )
    world = formats.load_string(
        "<sdf version='1.7'><world name='w'><model name='m'><static>1</static><link name='l'>"
        "<visual name='v'><geometry><heightmap><uri>file://none.png</uri><size>1 2 3</size>"
        f"{looks}</heightmap></geometry></visual></link></model></world></sdf>",
        name="w.world",
    )
    written = ET.fromstring(formats.to_string(world, "sdf")).find(".//heightmap")
    assert [each.findtext("diffuse") for each in written.findall("texture")] == ["a.png"] * 2
    assert written.findtext("blend/min_height") == "2"


def test_what_has_lost_its_links_is_saved_as_static():
    """A world around includes that were not found is saved; Gazebo, too, goes on with it."""
    lost = Model("lost", Pose(1.0, yaw=0.5), source=Source("a.world", 7, "model"))
    nested = Model("nested", models=(Model("inner"),))
    world = World("w", models=(lost, nested, Model("m", links=(Link("l"),))))
    with pytest.warns(FormatWarning, match="has no link and is saved as static") as said:
        found = again(world)
    assert [model.static for model in found.models] == [True, True, False]
    assert found.models[0].pose == lost.pose
    assert any("a.world:7" in str(each.message) for each in said)


def test_an_error_names_the_place_the_part_came_from():
    source = Source("robot.sdf", 7, "model[@name='m']/link[@name='l']")
    inertial = Inertial(1.0, inertia=Inertia(math.inf, 1.0, 1.0))
    with pytest.raises(FormatError) as caught:
        formats.to_string(Model("m", links=(Link("l", inertial=inertial, source=source),)), "sdf")
    assert (caught.value.file, caught.value.line) == ("robot.sdf", 7)
    with pytest.raises(FormatError, match=r"link\[@name='l'\].*finite"):
        formats.to_string(Model("m", links=(Link("l", Pose(math.inf)),)), "sdf")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (Model("m"), "no link"),
        (Model("", links=(Link("l"),)), "needs a name"),
        (Model("m", links=(Link("l"), Link("l"))), "two with the name"),
        (World(models=(Model("m", links=(Link("l"),)),) * 2), "two with the name"),
        (Model("m", links=(Link("l", Pose(math.inf)),)), "finite"),
        (Model("m", links=(Link("l", inertial=Inertial(0.0)),)), "mass"),
        (Model("a\x00b", links=(Link("l"),)), "cannot stand in XML"),
        (
            Model(
                "m",
                links=(Link("l"),),
                plugins=(
                    Plugin("p", "f", Parameters("plugin", children=(Parameters("no name"),))),
                ),
            ),
            "cannot be a name",
        ),
    ],
)
def test_what_no_reader_takes_is_not_written(content, message):
    with pytest.raises(FormatError, match=message):
        formats.to_string(content, "sdf")


def test_by_code_descriptions_need_no_kept_elements():
    sensor = Sensor("s", "camera")
    world = World(
        "w",
        (Model("m", links=(Link("l", sensors=(sensor,)),), plugins=(Plugin("p", "f.so"),)),),
        camera=Pose(1.0),
        lights=(Light("sun"),),
    )
    assert again(world) == world


def test_a_file_is_whole_or_not_there(tmp_path):
    bad = Model("m", links=(Link("l", Pose(math.inf)),))
    with pytest.raises(FormatError):
        formats.save(bad, tmp_path / "m.sdf")
    with pytest.raises(FormatError, match="cannot be written"):
        formats.save(Model("m", links=(Link("l"),)), tmp_path / "missing" / "m.sdf")
    assert list(tmp_path.iterdir()) == []
    formats.save(Model("m", links=(Link("l"),)), tmp_path / "m.sdf")
    assert [file.name for file in tmp_path.iterdir()] == ["m.sdf"]


def test_unknown_formats_are_refused_with_the_known_ones(tmp_path):
    with pytest.raises(FormatError, match=r"\.sdf"):
        formats.save(World(), tmp_path / "world.txt")
    with pytest.raises(FormatError, match="to_mjcf"):
        formats.to_string(World(), "mjcf")


def valid(path):
    """Return whether libsdformat finds no fault in a file."""
    return "Valid" in libsdformat.ign_sdf("-k", path).stdout


ORACLE = [
    "elysia-best__gazebo-classic/worlds/joints.world",
    "gazebosim__sdformat/test/sdf/double_pendulum.sdf",
    "gazebosim__sdformat/test/sdf/joint_nested_parent_child.sdf",
    "osrf__gazebo_models/pioneer3at/model.sdf",
]


@quiet
@pytest.mark.corpus
@pytest.mark.parametrize("name", ORACLE)
def test_libsdformat_finds_it_valid(corpus, tmp_path, monkeypatch, name):
    monkeypatch.setenv("SDF_PATH", str(corpus / "osrf__gazebo_models"))
    world = formats.load(corpus / name, paths=[corpus / "osrf__gazebo_models"])
    formats.save(world, tmp_path / "saved.sdf")
    assert valid(tmp_path / "saved.sdf")


@quiet
@pytest.mark.parametrize("diagonal", ["0 0 0", "0.002 0 0", "1 1 -1"])
def test_a_mended_inertia_is_saved_as_the_file_had_it(diagonal):
    xx, yy, zz = diagonal.split()
    robot = formats.load_model_string(
        f"<robot name='r'><link name='a'><inertial><mass value='2'/><inertia ixx='{xx}' iyy='{yy}' "
        f"izz='{zz}' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>"
    )
    found = ET.fromstring(formats.to_string(robot, "sdf")).find(".//inertia")
    assert [found.findtext(name) for name in ("ixx", "iyy", "izz")] == diagonal.split()
    assert again(robot).models == (robot,)
