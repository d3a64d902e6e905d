"""ROS 1 scripts as people write them for Gazebo run as they are: alone, and on the real rospy.

They are in the folder ``scripts``. What they print must be the same both ways.
"""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from real_messages import generate_real_classes
from ros.real import INSTALLED, PYTHON, environment

# They set all of ODE's properties.
pytestmark = pytest.mark.filterwarnings("ignore:the physics property")

FOLDER = Path(__file__).parents[1] / "scripts"
PRINTED = {
    "spawn_boxes": """
spawn crate: True SpawnModel: Successfully spawned entity
spawn parcel: True SpawnModel: Successfully spawned entity
spawn dice: True SpawnModel: Successfully spawned entity
again: False SpawnModel: Failure - entity already exists.
broken: False
no urdf: ServiceException
['crate', 'dice', 'parcel']
delete crate: True DeleteModel: successfully deleted model
delete parcel: True DeleteModel: successfully deleted model
delete dice: True DeleteModel: successfully deleted model
delete nobody: False DeleteModel: model does not exist
[]
""",
    "teleport": """
True SetModelState: set model state done 0.5 0.5 0.0
True SetModelState: set model state done -0.5 0.5 1.6
True SetModelState: set model state done -0.5 -0.5 3.1
True SetModelState: set model state done 0.5 -0.5 1.0
topic 0.8
SetModelState: model does not exist
SetModelState: specified reference frame entity does not exist
0.8
""",
    "change_physics": """
['auto_disable_bodies', 'cfm', 'contact_max_correcting_vel', 'contact_surface_layer', 'erp', \
'gravity_x', 'gravity_y', 'gravity_z', 'max_contacts', 'max_update_rate', 'sor_pgs_iters', \
'sor_pgs_precon_iters', 'sor_pgs_rms_error_tol', 'sor_pgs_w', 'time_step']
0.001 -9.8
-1.6 77
True GetPhysicsProperties: got properties -1.6 77
True physics engine updated
0.002 500 -9.8 False
0.001
""",
    "push_wheel": """
success: True
status_message: "SpawnModel: Successfully spawned entity"
ApplyJointEffort: effort set
True True 1.0
SetModelConfiguration: success
SetModelConfiguration: joint name and position list have different lengths
GetJointProperties: joint not found False
True
""",
    "print_pose": """
'' True GetModelState: got properties [] 0.0 1.0
'world' True GetModelState: got properties [world] 0.0 1.0
'map' True GetModelState: got properties [map] 0.0 1.0
'r1' True GetModelState: got properties [r1] 0.0 1.0
'r1::base_footprint' True GetModelState: got properties [r1::base_footprint] 0.0 1.0
'ground_plane' True GetModelState: got properties [ground_plane] 0.0 1.0
'nowhere' False GetModelState: reference relative_entity_name not found, did you forget to scope \
the body by model name? [nowhere] 0.0 0.0
[0, 1, 2, 3, 4, 5]
r1::wheel_left_link r1::base_footprint 0.080
GetLinkState: link not found, did you forget to scope the link by model name?
['wheel_left_joint', 'wheel_right_joint'] False True
""",
    "beat": """
True 1.5 False
['i', 'names', 'p'] /beat/gains
/beat / /beat/beat
['wheel_right_joint', 'wheel_left_joint'] 2
a second True
ticks True
['/beat/beat']
bye
""",
    "drive_to": """
frames odom base_footprint
driven enough True
standing True
tf agrees True
LookupException
""",
    "follow_wall": """
base_scan 360 0.00 6.28
0.12 3.50 tuple
scans True free True
""",
    "hover": """
SpawnModel: Successfully spawned entity
mass 1.5
height True level True
falls True
False ApplyBodyWrench: body does not exist
DeleteModel: successfully deleted model
""",
    "train": """
episode 0 5 as the first True
reward 3.0 done False paused True
episode 1 5 as the first True
reward 3.0 done False paused True
episode 2 5 as the first True
reward 3.0 done False paused True
""",
}
# What longer ones print is in files beside them.
PRINTED |= {file.stem: file.read_text(encoding="utf-8") for file in FOLDER.glob("*.printed")}
QUICK = ("spawn_boxes", "teleport", "change_physics", "push_wheel", "properties", "puck", "frames")
BOTH = [
    pytest.param(name, marks=() if name in QUICK else pytest.mark.slow, id=name) for name in PRINTED
]


@pytest.fixture(scope="module")
def classes(tmp_path_factory):
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    return generate_real_classes(
        {"gazebo_msgs", "controller_manager_msgs"}, tmp_path_factory.mktemp("genpy")
    )


@pytest.fixture
def background(graph):
    """Yield the world running in real time beside the test."""
    thread = threading.Thread(target=graph.server.run)
    thread.start()
    yield graph
    graph.server.stop()
    thread.join()


def printed(command, surroundings):
    """Return the output of a script, without its log."""
    finished = subprocess.run(
        command,
        env=surroundings,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr
    assert "Traceback" not in finished.stderr
    lines = finished.stdout.strip().splitlines()
    return [line.rstrip() for line in lines if not line.startswith("[INFO]")]


@pytest.mark.long
@pytest.mark.parametrize("name", BOTH)
def test_a_script_written_for_gazebo_runs_unchanged(name, background):
    command = [sys.executable, "-m", "gazelle", "exec", str(FOLDER / f"{name}.py")]
    uri = {"ROS_MASTER_URI": background.master.uri}
    assert printed(command, os.environ | uri) == PRINTED[name].strip().splitlines()


@pytest.mark.long
@pytest.mark.ros
@pytest.mark.parametrize("name", BOTH)
def test_the_same_script_prints_the_same_on_the_real_rospy(name, background, classes):
    surroundings = environment(background.master.uri) | {"PYTHONPATH": str(classes)}
    command = [PYTHON, str(FOLDER / f"{name}.py")]
    assert printed(command, surroundings) == PRINTED[name].strip().splitlines()
