"""Whatever a Stage file holds, it loads or is refused with one of our errors, in little time."""

import math
import re
import time
import warnings

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from PIL import Image
from stage_samples import draw, write

from gazelle import Error, FormatError, formats
from gazelle.stage.format import load_stage
from gazelle.stage.format.devices import KINDS

SAMPLE = """
include "part.inc"
resolution 0.02 interval_sim 100 # comment
unit_angle "degrees"
window ( size [ 400 300 ] scale 20 )
define scanner ranger ( sensor ( range [ 0 8 ] fov 180 samples 32 pose [ 0 0 0.1 0 ] ) )
define robot position ( size [ 0.4 0.4 0.3 ] drive "diff" scanner ( pose [ 0 0 0 0 ] )
  odom_error [ 0.1 0.1 0 1 ] ctrl "wander" color "random"
  block ( points 3 point[0] [ 0 0 ] point[1] [ 1 0 ] point[2] [ 0 1 ] z [ 0 1 ] ) )
model ( name "plan" bitmap "map.png" size [ 10 10 1 ] boundary 1 color "gray30" )
robot ( name "r0" pose [ 1 2 0 90 ] ) robot ( pose [ -1 2 0 0 ] mass 3 )
camera ( resolution [ 32 32 ] ) fiducial ( ) gripper ( paddle_state [ "open" "up" ] )
bumper ( bcount 1 bpose[0] [ 0 0 0 0 ] blength 0.2 ) actuator ( type "linear" axis [ 1 0 0 ] )
blobfinder ( colors_count 1 colors [ "red" ] ) blinkenlight ( ) lightindicator ( )
"""
WORDS = sorted({*re.findall(r"[a-z_\[\]0-9]+|\S", SAMPLE), *KINDS, "define", "include", "blocks"})


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stage")
    draw(folder, ["###", "#.#", "###"])
    write(folder, 'define corner block ( ) name "part"', "part.inc")
    return folder


def survives(folder, data):
    """Load it: a result or one of our errors, and soon."""
    file = folder / "fuzz.world"
    file.write_bytes(data)
    start = time.process_time()
    refusal = None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            formats.load(file)
        except Error as error:
            refusal = error
    assert refusal is None or (refusal.file and "\n" not in str(refusal))
    assert time.process_time() - start < 2.0


def test_the_sample_is_whole(folder):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert len(formats.load(write(folder, SAMPLE)).content.models) == 11


fuzzing = settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])


@fuzzing
@given(words=st.lists(st.sampled_from(WORDS), max_size=60))
@example(words=["define", "a", "a", "(", "a", "(", ")", ")", "a", "(", ")"])
@example(words=["block", "(", ")"])
def test_words_in_any_order_do_no_harm(folder, words):
    survives(folder, " ".join(words).encode())


@fuzzing
@given(data=st.binary(max_size=200), head=st.sampled_from([b"", b"model ( ", b'name "a"\n']))
def test_any_bytes_do_no_harm(folder, data, head):
    survives(folder, head + data)


@pytest.mark.long
@fuzzing
@given(
    cut=st.tuples(st.integers(0, len(SAMPLE)), st.integers(0, 40)),
    put=st.text(st.sampled_from('()[]"# .-019aeiz_\n'), max_size=6),
)
def test_a_spoilt_sample_does_no_harm(folder, cut, put):
    start, length = cut
    survives(folder, (SAMPLE[:start] + put + SAMPLE[start + length :]).encode())


@pytest.mark.long
@fuzzing
@given(
    name=st.sampled_from(["size", "pose", "origin", "mass", "bitmap", "color", "name", "ctrl"]),
    value=st.one_of(
        st.floats().map(repr),
        st.lists(st.floats().map(repr), max_size=5).map(lambda v: f"[ {' '.join(v)} ]"),
        st.text(max_size=8).map(lambda v: f'"{v}"'),
    ),
    kind=st.sampled_from(sorted(KINDS)),
)
def test_any_value_of_a_property_does_no_harm(folder, name, value, kind):
    survives(folder, f"{kind} ( {name} {value} )".encode())


@pytest.mark.long
@fuzzing
@given(
    robots=st.lists(
        st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-720, 720)), max_size=5
    )
)
def test_poses_come_out_as_written(folder, robots):
    text = "".join(
        f'define r{i} position ( )\nr{i} ( name "n{i}" pose [ {x!r} {y!r} 0 {a!r} ] )\n'
        for i, (x, y, a) in enumerate(robots)
    )
    stage = load_stage(write(folder, text))
    assert [model.name for model in stage.models] == [f"n{i}" for i in range(len(robots))]
    for model, (x, y, angle) in zip(stage.models, robots, strict=True):
        assert model.pose[:2] == (x, y)
        assert math.isclose(model.pose.yaw, math.radians(angle), abs_tol=1e-12)


@pytest.mark.parametrize(
    "data",
    [
        b"#" * 100_000 + b"\n<",
        (b"#" * 50 + b"\n") * 5_000 + b"<",
        b"1" * 200_000 + b"x",
        b"model ( pose [" + b"1" * 100_000 + b"x] )",
        b"model ( " + b"a[1]" * 50_000 + b"[",
        b'name "' + b"x" * 200_000,
        b"( " * 100_000,
        b"[" * 200_000,
        b"[1" * 200_000,
        b"model ( name " * 20_000,
        b"\n" * 500_000 + b"model (",
        b"block ( points 1e9 )",
        b"model ( block ( points 100000 ) )",
        b"bumper ( bcount 1e9 )",
        b"model ( blocks 1e9 )",
        b"ranger ( sensor ( samples 1e9 ) )",
    ],
)
def test_files_made_to_be_slow_are_not(folder, data):
    survives(folder, data)


def test_a_picture_of_noise_is_refused(folder):
    noise = np.random.default_rng(0).integers(0, 256, (3000, 3000), np.uint8)
    Image.fromarray(noise).save(folder / "noise.png")
    with pytest.raises(FormatError, match="edges"):
        load_stage(write(folder, 'model ( bitmap "noise.png" )'))


@pytest.mark.long
def test_ten_thousand_robots_load_in_a_second(folder):
    poses = "".join(
        f'robot ( name "r{i}" pose [ {i % 100} {i // 100} 0 {i % 360} ] )\n' for i in range(10_000)
    )
    file = write(
        folder,
        "define robot position ( ranger ( sensor ( samples 640 ) ) )\n" + poses,
        "many.world",
    )
    best = math.inf
    for _ in range(3):
        start = time.process_time()
        stage = load_stage(file)
        best = min(best, time.process_time() - start)
    assert len(stage.robots) == 10_000
    assert best < 1.0
