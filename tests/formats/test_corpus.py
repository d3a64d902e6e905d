"""Every file of the corpus loads, or is refused for a reason that a human agrees with."""

import collections
import time

import pytest

from gazelle import formats

pytestmark = pytest.mark.corpus

# what is said of a file that cannot be loaded by itself, and of how many xacro files
REFUSED = {
    "this is not XML": 1,
    "the attribute 'name' is required in <robot>": 155,  # xacro files of macros
    "a <robot> needs a <link>": 36,  # xacro files of macros
    "there is no package": 28,  # packages that the corpus leaves out
    "expected <sdf> or <robot>": 19,  # xacro's own test inputs
    "there is no file": 7,
    "xacro: ": 4,  # arguments that must be given, names of the including file
}
BROKEN_ON_PURPOSE = "gazebosim__sdformat/test/sdf"
BROKEN = {
    "elysia-best__gazebo-classic/worlds/collision_zero.world",  # a box of size zero
    "elysia-best__gazebo-classic/worlds/joint_damping_demo.world",  # inertia of zeros
    "ros-simulation__gazebo_ros_pkgs/gazebo_plugins/test/test_worlds/gazebo_ros_depth_camera.world",
    "ros-simulation__gazebo_ros_pkgs/gazebo_plugins/test2/worlds/empty.world",  # before 1.0
}


def files(corpus, *kinds):
    schema = corpus / "gazebosim__sdformat" / "sdf"
    found = [f for kind in kinds for f in corpus.rglob(f"*.{kind}") if schema not in f.parents]
    return sorted(found)


def judge(corpus, paths):
    """Errors by file, and seconds by file."""
    errors, seconds = {}, {}
    for path in paths:
        start = time.perf_counter()
        problems = formats.check(path)
        name = str(path.relative_to(corpus))
        seconds[name] = time.perf_counter() - start
        first = next((p for p in problems if p.severity == "error"), None)
        if first is not None:
            errors[name] = first
    return errors, seconds


def unexplained(errors):
    return {
        name: problem.message
        for name, problem in errors.items()
        if name not in BROKEN
        and BROKEN_ON_PURPOSE not in name
        and not any(problem.message.startswith(reason) for reason in REFUSED)
    }


def test_sdf_and_urdf_files_load_or_are_refused_with_reason(corpus):
    paths = files(corpus, "sdf", "world", "urdf")
    errors, seconds = judge(corpus, paths)
    assert len(paths) > 500
    assert unexplained(errors) == {}
    assert all(p.file and (p.line or "file" in p.message) for p in errors.values())
    assert max(seconds.values()) < 1.0, max(seconds, key=seconds.get)
    assert sorted(seconds.values())[len(seconds) // 2] < 0.02


def test_files_made_wrong_on_purpose_are_refused(corpus):
    folder = corpus / BROKEN_ON_PURPOSE
    bad = [f for f in folder.glob("*.sdf") if "invalid" in f.name or "bad" in f.name]
    errors, _ = judge(corpus, bad)
    assert {f.name for f in bad} == {name.rpartition("/")[2] for name in errors}


@pytest.mark.slow
def test_xacro_files_load_or_are_refused_with_reason(corpus):
    errors, _ = judge(corpus, files(corpus, "xacro", "gazebo"))
    assert unexplained(errors) == {}
    counts = collections.Counter(
        next((r for r in REFUSED if p.message.startswith(r)), "other") for p in errors.values()
    )
    assert all(count <= REFUSED[reason] for reason, count in counts.items()), counts
