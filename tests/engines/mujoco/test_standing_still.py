"""Everything in the corpus that claims to stand still does, for ten simulated minutes.

`python tests/standing.py CORPUS` prints a line for each file: how many links move,
how long it was watched, how far what rests has sunk, how fast anything is.
"""

import os
import warnings

import pytest
import standing

# Processor time for a scene [s]; what needs more is watched for as long as that lasts.
BUDGET = float(os.environ.get("GAZELLE_STAND_STILL_SECONDS", "20"))
PARTS = 8

# What does not stand still, or not at all, and why.
EXCEPTIONS = {
    "ros-simulation__gazebo_ros_pkgs/gazebo_plugins/test2/lcp_tests/balance.world": (
        "sinks",
        "balls balanced on balls: they roll off, as they must",
    ),
    "elysia-best__gazebo-classic/worlds/wind_demo.world": (
        "sinks",
        "a rope below a <kinematic> roof, which has no effect here, lies in a balance for a while",
    ),
    "moveit__moveit_resources/panda_description/urdf/panda_arm_hand.urdf.xacro": (
        "sinks",
        "joints without friction: the arm balances on its wrist for a minute, then rolls over",
    ),
    **dict.fromkeys(
        (
            f"ros-simulation__gazebo_ros_pkgs/gazebo_plugins/test2/large_models/{name}.urdf.xacro"
            for name in ("large_model", "smaller_large_model")
        ),
        ("refused", "thousands of links with inertia tensors of zeros"),
    ),
}


@pytest.mark.slow
@pytest.mark.corpus
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("part", range(PARTS))
def test_what_claims_to_stand_still_stands_still_for_ten_minutes(corpus, part):
    """Nothing explodes, nothing that rests sinks by more than a centimetre, no NaN."""
    faults = {}
    for path in list(standing.scenes(corpus))[part::PARTS]:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            outcome = standing.stand(path, corpus, budget=BUDGET)
        # What the readers refuse is judged in tests/formats/test_corpus.py.
        if outcome.fault not in ("", "unreadable"):
            faults[outcome.name] = (outcome.fault, outcome.where)
    unexplained = {
        name: fault
        for name, fault in faults.items()
        if name not in EXCEPTIONS or EXCEPTIONS[name][0] != fault[0]
    }
    assert not unexplained


def test_the_watch_sees_what_sinks(tmp_path):
    file = tmp_path / "sinking.sdf"
    file.write_text(
        """<sdf version="1.7"><model name="m"><link name="l">
        <inertial><mass>1</mass></inertial>
        <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry>
        </collision></link></model></sdf>"""
    )
    assert not standing.stand(file, tmp_path, long=40.0).fault
    engine = standing.make_engine("mujoco", standing.load(file))
    watch = standing._Watch(engine)
    for depth in (*(0.0 for _ in standing.LOOKS), 0.02):
        watch.time = standing.SETTLING
        engine.models["m"].set_placement((0.0, 0.0, 0.1 - depth), (0.0, 0.0, 0.0, 1.0))
        watch.look(1.0)
    assert watch.fault == "sinks"


def test_the_watch_does_not_take_what_turns_about_in_a_swing_for_what_rests(tmp_path):
    file = tmp_path / "swing.sdf"
    file.write_text(
        """<sdf version="1.7"><model name="m"><link name="l"><pose>0 0 5 1.2 0 0</pose>
        <inertial><pose>0 0 -2 0 0 0</pose><mass>1</mass></inertial></link>
        <joint name="j" type="revolute"><parent>world</parent><child>l</child>
        <axis><xyz>1 0 0</xyz></axis></joint></model></sdf>"""
    )
    assert not standing.stand(file, tmp_path, long=200.0).fault


def test_the_watch_sees_what_gains_energy(tmp_path):
    file = tmp_path / "free.sdf"
    file.write_text(
        '<sdf version="1.7"><model name="m"><link name="l"><inertial><mass>1</mass></inertial>'
        "</link></model></sdf>"
    )
    engine = standing.make_engine("mujoco", standing.load(file))
    watch = standing._Watch(engine)
    watch.time = standing.SETTLING
    engine.models["m"].set_motion((5.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    watch.look(1.0)
    assert watch.fault == "gains"
