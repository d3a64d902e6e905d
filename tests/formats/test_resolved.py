"""Against libsdformat's own resolution: poses of every part, inertias, joints and axes."""

import collections
import warnings

import corpus_table
import pytest
import resolved
from oracle_variants import INCLUDED, SDF, URDF
from xml_samples import sdf

from gazelle import Error, formats
from gazelle.formats.sdf import state

pytestmark = [
    pytest.mark.long,  # a C++ program is compiled for them
    pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning"),
]


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    found = resolved.build(tmp_path_factory.mktemp("oracle"))
    if found is None:
        pytest.skip("libsdformat's headers or g++ are not installed (Debian: libsdformat-dev, g++)")
    return found


def differences(program, file, roots, **digits):
    lines = resolved.run(program, [file], roots)[str(file)]
    assert "error" not in lines, lines["error"]
    return resolved.differences(formats.load(file, paths=roots), lines, **digits)


@pytest.mark.parametrize("text", SDF.values(), ids=SDF)
def test_hard_sdf_is_resolved_the_same(program, tmp_path, text):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm/model.config").write_text("<model><sdf version='1.9'>model.sdf</sdf></model>")
    (tmp_path / "arm/model.sdf").write_text(sdf(INCLUDED, "1.9"))
    file = tmp_path / "file.sdf"
    file.write_text(text)
    assert differences(program, file, [tmp_path], merged="merge=" in text) == []


@pytest.mark.parametrize("text", URDF.values(), ids=URDF)
def test_hard_urdf_is_resolved_the_same(program, tmp_path, text):
    file = tmp_path / "robot.urdf"
    file.write_text(text)
    assert differences(program, file, [tmp_path], lumped=True) == []


# what Gazelle loads and libsdformat 12 finds wrong, and why
ACCEPTED = {
    "Unable to find uri": "a model that is not found is left out, and named in a warning",
    "is missing a child <uri> element": "the material's name is enough",
    "is missing a child <name> element": "it has no colour then",
    "A model must have at least one link": "robots without mass are kept, to be shown",
    "has invalid inertia": "Gazebo Classic runs it; `gazelle check` says what is wrong",
    "Error reading element <sim_time>": "a blank at its end does no harm",
    "Error reading element <mu>": "-1 means `no slip` to Gazebo Classic",
    "Error reading element <color>": "a colour of fog is not used",
    "specified by joint": "`__model__` may be the end of a joint since SDF 1.7",
    "provided sensor type is missing or invalid": "libsdformat 12 is older than the type",
    "with non-unique name": "a link and a joint or frame may share a name, as before SDF 1.7",
    "Delimiter '::'": "flattened names of SDF before 1.8 stay when such a file is saved again",
    "model with name": "models beside each other are all taken",
    "World with name": "only the first world of a file is taken",
    "can only contain one model": "models beside each other are all taken",
    "Unable to read file": "SDF before 1.3; an XML declaration with blanks before it",
    "shader type": "normal maps are not used",
    "<shader><type> element": "shaders are not used",
    "<image><format>": "the pictures are always RGB",
}
# what libsdformat says after another error
CONSEQUENCES = ("Error reading element <", "Failed to load a world", "Graph")
# what Gazelle refuses and libsdformat 12 loads, and why
REFUSED = {
    "joint_axis_invalid_expressed_in.sdf": "libsdformat tells of it when the axis is asked for",
    "world_joint_invalid_child_world.sdf": "libsdformat 12 does not know SDF 1.10",
    "world_joint_invalid_resolved_parent_same_as_child.sdf": "the same",
}
# where the two mean something else, and why
DIFFERENT = {
    "auto_inertia_pendulum.sdf": "libsdformat 12 does not compute inertias, which SDF does since 1.11",
    "inertial_stats_auto.sdf": "the same",
    "inertial_stats_auto_mass.sdf": "the same",
    "mesh_auto_inertial.sdf": "the same",
    "shapes.sdf": "the same",
    "flattened_test_nested_model_with_frames.sdf": "libsdformat moves joints of flattened names",
    "root_duplicate_models.sdf": "libsdformat takes the first model of several",
    "root_multiple_models.sdf": "the same",
    "sensors.sdf": "libsdformat 12 does not know the type air_speed",
    "resolve_uris.sdf": "a mesh folder without model.config takes the model along",
    # before SDF 1.7 a joint may be called as a link is: libsdformat renames it, Gazebo
    # Classic and Gazelle do not
    "elevator.world": "a joint and a link of one name",
    "gripper.world": "the same",
    "misalignment_plugin_demo.world": "the same",
    "model_link_joint_same_name.sdf": "the same",
    "osrf_elevator.world": "the same",
    "model-1_3.sdf": "the same, simple_gripper",
    "model-1_4.sdf": "the same",
    "model.sdf": "the same",
}


@pytest.fixture(scope="module")
def compared(program, corpus):
    """Return libsdformat's answer by file, and our error or the differences."""
    roots = sorted({str(config.parent.parent) for config in corpus.rglob("model.config")})
    paths = corpus_table.files(corpus, "sdf", "world", "urdf")
    lines = {}
    for start in range(0, len(paths), 40):
        lines |= resolved.run(program, paths[start : start + 40], roots)
    return {path: (lines.get(str(path)), *_judged(path, roots, lines)) for path in paths}


def _judged(path, roots, lines):
    """Return our first error, whether it stops the load or is tolerated, and all differences."""
    try:
        with warnings.catch_warnings(record=True) as said, pytest.MonkeyPatch.context() as patch:
            warnings.simplefilter("always")
            patch.setattr(state, "apply", lambda world: world)  # libsdformat leaves it to Gazebo
            world = formats.load(path, paths=roots)
    except Error as error:
        return error, []
    if said:
        problems = formats.check(path, paths=roots)
        tolerated = next((each for each in problems if each.severity == "error"), None)
        if tolerated is not None:
            return tolerated, []
    theirs = lines.get(str(path), {})
    complete = not any("not found" in str(warning.message) for warning in said)
    bare = any("at least one link" in said for said in theirs.get("error", []))
    if not (theirs and complete and any(key != "error" for key in theirs)) or bare:
        return None, []
    if any("error" in fields for key, fields in theirs.items() if key != "error"):
        return None, []  # libsdformat resolves only a part of it
    return None, resolved.differences(world, theirs, merged=True)


@pytest.mark.slow
@pytest.mark.corpus
def test_the_whole_corpus_is_resolved_the_same(compared):
    agree = sum(not found for *_, found in compared.values())
    wrong = {path.name: found[:3] for path, (*_, found) in compared.items() if found}
    assert {name: found for name, found in wrong.items() if name not in DIFFERENT} == {}
    assert agree > 400


@pytest.mark.slow
@pytest.mark.corpus
def test_where_libsdformat_refuses_gazelle_does_or_the_reason_is_listed(compared):
    loaded = collections.defaultdict(list)
    for path, (theirs, ours, _) in compared.items():
        errors = [] if theirs is None else theirs.get("error", [])
        if any("Unable to find uri" in said for said in errors):
            continue  # what is said then is of the model that is not there
        for said in errors:
            if ours is None and not any(r in said for r in (*ACCEPTED, *CONSEQUENCES)):
                loaded[said[:160]].append(path.name)
    assert loaded == {}


@pytest.mark.slow
@pytest.mark.corpus
def test_what_gazelle_refuses_libsdformat_does_or_the_reason_is_listed(compared):
    refused = {
        path.name: ours.message
        for path, (theirs, ours, _) in compared.items()
        if isinstance(ours, Error) and theirs is not None and "error" not in theirs
    }
    assert refused.keys() - REFUSED.keys() == set(), refused
