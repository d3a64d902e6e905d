"""Files as Gazelle writes them against files as libsdformat prints them: all of it, value by value.

Both are read by ElementTree alone (``plain_sdf``): no code of the package stands between them and
the comparison. That loading a written file gives the same description again is for
``test_write_sdf`` to say.
"""

import re
import warnings
import xml.etree.ElementTree as ET

import corpus_table
import libsdformat
import pytest
from oracle_variants import EXTENDED
from plain_sdf import as_urdf, differences, table

from gazelle import Error, formats
from gazelle.formats import xacro
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver

ROBOTS = "ROBOTIS-GIT__turtlebot3/turtlebot3_description/urdf"
MODELS = "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/models"

XACROS = [
    *(f"{ROBOTS}/turtlebot3_{name}.urdf.xacro" for name in ("burger", "waffle", "waffle_pi")),
    "yujinrobot__kobuki/kobuki_description/urdf/kobuki_standalone.urdf.xacro",
    "ros-simulation__gazebo_ros_demos/rrbot_description/urdf/rrbot.xacro",
    "ROBOTIS-GIT__open_manipulator/open_manipulator_description/urdf/open_manipulator_robot.urdf.xacro",
    "ros-industrial__universal_robot/ur_description/urdf/ur5.xacro",
    "ros__urdf_sim_tutorial/urdf/09-publishjoints.urdf.xacro",
    "ros__urdf_sim_tutorial/urdf/13-diffdrive.urdf.xacro",
    "turtlebot__turtlebot/turtlebot_description/robots/kobuki_hexagons_kinect.urdf.xacro",
    "chvmp__champ/champ_description/urdf/champ.urdf.xacro",
]
FILES = [
    *(
        f"{MODELS}/turtlebot3_{name}/model.sdf"
        for name in ("burger", "waffle", "waffle_pi", "house")
    ),
    "osrf__gazebo_models/simple_arm/model.sdf",
    "osrf__gazebo_models/pioneer3at/model.sdf",
    "gazebosim__sdformat/test/sdf/model_frame_relative_to_joint.sdf",
    "gazebosim__sdformat/test/sdf/nested_canonical_link.sdf",
    "gazebosim__sdformat/test/sdf/double_pendulum.sdf",
    "elysia-best__gazebo-classic/worlds/friction_demo.world",
]
# what Gazelle writes beside what libsdformat 12 does: frames for lumped links, which it does
# since 12.6, and joints that follow others, which it does since 14
MORE = re.compile(r"more: \S*(/frame\[|/mimic)")
# robots of the corpus that come out otherwise, and why
KNOWN_ROBOTS = {
    "pr2": "libsdformat forgets that a link is lumped in <gazebo><joint>, so its file cannot be read",
}
# what of SDF files comes out otherwise, and why
KNOWN_VALUES = {
    r"/visual\[.*\]/material/": "looks that are not simulated: shaders, more maps, scripts as text",
    r"/visual\[.*\]/meta": "layers of the editor",
    r"/geometry/empty": "a shape of nothing is written as that",
    r"/density": "of a material: serves to compute the inertia, which is written instead",
    r"/inertial": "libsdformat 12 does not compute inertias; in static models wrong ones are left out",
    r"/scene/|/gui|/light\[|/audio": "the look of a world",
    r"/physics\[.*\]": "terms of the solver that have no effect here",
    r"/bullet/|elastic_modulus|poissons_ratio": "terms of other engines",
    r"\{|/gravity|not_an?_": "elements that SDF does not know, or others' own",
    r"/actor|/population|/road|scripted_motion": "written as what they become",
    r"implicit_spring_damper|cfm_damping": "old and new name of one thing",
    r"@relative_to|@placement_frame|pose": "frames that libsdformat resolves later: see test_resolved.py",
    r"/joint\[.*\]/(parent|child)": "likewise",
    r"/axis2?/|thread_pitch|initial_position": "what a joint of its type does not have",
}


@pytest.fixture(autouse=True, scope="module")
def _tool():
    libsdformat.needed()


def oracle(path, roots=()):
    """Return a file as libsdformat prints it; None where it rejects the file."""
    return libsdformat.printed(path, roots=roots)


def complaints(path):
    """Return libsdformat's complaints about a file."""
    run = libsdformat.ign_sdf("-k", path)
    said = [*run.stdout.splitlines(), *run.stderr.splitlines()]
    return [line for line in said if "rror" in line and "Library error" not in line]


def compared(ours, theirs):
    found = [line for line in differences(table(ours), table(theirs)) if not MORE.match(line)]
    return sorted(found)


def converted(path, **options):
    return formats.to_string(formats.load_model(path, **options), "sdf", folder=path.parent)


def expanded(path, corpus):
    """Return a xacro file as URDF text."""
    return as_urdf(xacro.expand(path, Reading(Resolver([corpus], file=path))))


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
@pytest.mark.corpus
@pytest.mark.parametrize("file", XACROS)
def test_robots_are_what_libsdformat_makes_of_them(corpus, tmp_path, file):
    path = tmp_path / "robot.urdf"
    path.write_text(expanded(corpus / file, corpus))
    ours = converted(path)
    assert compared(ours, oracle(path)) == []
    (tmp_path / "robot.sdf").write_text(ours)
    assert complaints(tmp_path / "robot.sdf") == []
    assert compared(ours, oracle(tmp_path / "robot.sdf")) == []


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
@pytest.mark.corpus
@pytest.mark.parametrize("file", FILES)
def test_sdf_files_are_what_libsdformat_reads(corpus, tmp_path, file):
    models = corpus / "osrf__gazebo_models"
    world = formats.load(corpus / file, paths=[models])
    content = world if file.endswith(".world") else world.models[0]
    ours = formats.to_string(content, "sdf", folder=(corpus / file).parent)
    assert unexpected(compared(ours, oracle(corpus / file, [models]))) == []


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
@pytest.mark.parametrize("text", EXTENDED.values(), ids=EXTENDED)
def test_gazebo_extensions_mean_what_libsdformat_makes_of_them(tmp_path, text):
    path = tmp_path / "robot.urdf"
    path.write_text(text)
    assert compared(converted(path), oracle(path)) == []


def robots(corpus):
    """Yield every robot of the corpus as URDF text, by the path of its file."""
    for path in corpus_table.files(corpus, "urdf", "xacro"):
        try:
            text = expanded(path, corpus)
        except Error:
            continue
        if re.search(r"<robot[^>]* name=", text) and "<link" in text:
            yield path, text


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.corpus
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_every_robot_of_the_corpus_is_what_libsdformat_makes_of_it(corpus, tmp_path):
    wrong, same = {}, 0
    for path, text in robots(corpus):
        file = tmp_path / "robot.urdf"
        file.write_text(text)
        theirs = oracle(file)
        if theirs is None or "<link" not in theirs:
            continue  # refused, or without any mass
        try:
            found = compared(converted(file), theirs)
        except Error:
            continue  # refused by Gazelle
        except ET.ParseError:
            continue  # libsdformat printed what is no XML
        except KeyError as error:
            found = [f"libsdformat names a frame that is not there: {error}"]
        same += not found
        if found and not any(name in path.name for name in KNOWN_ROBOTS):
            wrong[str(path.relative_to(corpus))] = found[:3]
    assert wrong == {}
    assert same > 60


def unexpected(found):
    return [line for line in found if not any(re.search(known, line) for known in KNOWN_VALUES)]


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.corpus
def test_every_sdf_file_of_the_corpus_is_what_libsdformat_reads(corpus):
    roots = sorted({str(config.parent.parent) for config in corpus.rglob("model.config")})
    wrong, same = {}, 0
    for path in corpus_table.files(corpus, "sdf", "world"):
        theirs = oracle(path, roots)
        ours = None if theirs is None else saved_again(path, roots, "<world" in theirs)
        if ours is None:
            continue
        try:
            found = unexpected(compared(ours, theirs))
        except Exception:  # noqa: BLE001  # libsdformat printed what is no XML, or no frame
            continue
        same += not found
        if found and path.name not in KNOWN_FILES and not complaints(path):
            wrong[str(path.relative_to(corpus))] = found[:3]
    assert wrong == {}  # what libsdformat itself finds wrong is printed by it, and left out by us
    assert same > 300


def saved_again(path, roots, is_world):
    """Return the file as Gazelle writes it; None where it is rejected or incomplete."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            world = formats.load(path, paths=roots)
            content = world if is_world else world.models[0]
            text = formats.to_string(content, "sdf", folder=path.parent)
        except (Error, IndexError):
            return None
    return None if any("not found" in str(each.message) for each in said) else text


KNOWN_FILES = {
    "resolve_uris.sdf": "a mesh folder without model.config takes the model along",
    "root_multiple_models.sdf": "libsdformat takes the first model of several",
    "animated_box.world": "an actor becomes a model that a plugin moves",
    "animation_tension.world": "the same",
    "flattened_test_nested_model_with_frames.sdf": "libsdformat moves joints of flattened names",
    "gazebo_ros_camera.world": "of two <camera> libsdformat prints all of one only",
    "joint_complete.sdf": "Gazebo Classic has no continuous joints",
}
