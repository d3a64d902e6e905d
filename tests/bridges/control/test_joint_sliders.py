"""Interfaces that the tool rqt_joint_trajectory_controller uses, for both clients of Python."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from bridges.control.robot_graph import robot_graph
from control.arms import JOINTS, arm_text
from real_messages import generate_real_classes
from ros.real import INSTALLED, PYTHON, environment

SCRIPT = str(Path(__file__).parent / "joint_sliders.py")
FOLLOW = "JointTrajectoryController"
GAINS = {name: {"p": 600.0, "i": 100.0, "d": 60.0, "i_clamp": 50.0} for name in JOINTS}


@pytest.fixture(params=["Position", pytest.param("Effort", marks=pytest.mark.slow)])
def uri(request):
    """Run an arm with a controller that follows trajectories, and one that does not."""
    kind = request.param
    parameters = {
        "/robot_description": arm_text(kind),
        "/arm/follower": {
            "type": f"{kind.lower()}_controllers/{FOLLOW}",
            "joints": JOINTS,
            "gains": GAINS,
        },
        "/arm/idle": {
            "type": f"{kind.lower()}_controllers/{FOLLOW}",
            "joints": JOINTS,
            "gains": GAINS,
        },
    }
    with robot_graph(arm_text(kind), parameters=parameters) as graph:
        for name in ("follower", "idle"):
            assert graph.call("load_controller", name=name)
        assert graph.switch(["follower"])
        yield graph.node.master_uri, kind.lower()


def check(command, surroundings, kind):
    done = subprocess.run(
        command,
        env=surroundings,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines() == [
        "managers /arm/controller_manager",
        f"follower {kind}_controllers/{FOLLOW} elbow shoulder",
        "elbow -3.14 3.14 6 shoulder -3 3 4",
        "there",
    ]


@pytest.mark.long
def test_sliders_move_the_joints(uri):
    master, kind = uri
    surroundings = os.environ | {"ROS_MASTER_URI": master}
    check([sys.executable, "-m", "gazelle", "exec", SCRIPT], surroundings, kind)


@pytest.fixture(scope="module")
def classes(tmp_path_factory):
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    packages = {"control_msgs", "controller_manager_msgs"}
    return generate_real_classes(packages, tmp_path_factory.mktemp("genpy"))


@pytest.mark.ros
@pytest.mark.slow
def test_sliders_of_the_real_rospy_do_too(uri, classes):
    master, kind = uri
    check([PYTHON, SCRIPT], environment(master) | {"PYTHONPATH": str(classes)}, kind)
