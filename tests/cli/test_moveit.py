"""`gazelle run --controllers` and `--moveit`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest
from ports import free_port
from ros.graph import until

from gazelle.errors import RosError
from gazelle_ros import Master, Node, load_service


def test_moveit_needs_a_graph(cli):
    code, _, err = cli("run", "fetch", "--moveit", "--for", "0.1")
    assert code == 2
    assert "--ros" in err


def test_a_robot_without_a_package_for_moveit_is_refused(cli, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{free_port()}")
    code, _, err = cli("run", "rrbot", "--ros", "--moveit", "--for", "0.1")
    assert code == 1
    assert "move_group.launch" in err


def test_controllers_of_a_file_run_as_far_as_joints_are_free(cli, tmp_path):
    file = tmp_path / "controllers.yaml"
    kind = "{type: effort_controllers/JointEffortController, joint: joint1}"
    file.write_text(f"one: {kind}\nother: {kind}\ngains: {{p: 1.0}}\n")
    arguments = ("--for", "0.05", "--rate", "max", "--controllers")
    code, out, _ = cli("run", "rrbot", *arguments, file)
    assert code == 0
    assert "controllers not started (--verbose says why): other\n" in out
    out = cli("run", "rrbot", "--verbose", *arguments, file)[1]
    assert "'other' is not started: could not switch controllers" in out
    assert "'one' is not" not in out
    file.write_text("gains: {p: 1.0}\n")
    code, _, err = cli("run", "rrbot", *arguments, file)
    assert code == 1
    assert "no controllers" in err
    code, _, err = cli("run", "rrbot", *arguments, tmp_path / "no.yaml")
    assert code == 1
    assert "no.yaml" in err
    assert cli("run", "empty", *arguments, file)[0] == 1


@pytest.mark.slow
def test_fetch_runs_with_move_group_and_ends_with_it():
    with Master(port=0, rosout=False) as master, Node("asking", master_uri=master.uri) as node:
        command = [sys.executable, "-m", "gazelle", "run", "pick_and_place", "--spawn", "fetch"]
        environ = {**os.environ, "ROS_MASTER_URI": master.uri}
        with subprocess.Popen([*command, "--ros", "--moveit"], env=environ) as process:
            try:
                service = load_service("moveit_msgs/GetPositionFK")
                node.wait_for_service("compute_fk", timeout=120)
                asked = service._request_class(fk_link_names=["gripper_link"])

                def answered():
                    try:
                        return node.client("compute_fk", service).call(asked, timeout=30)
                    except RosError:
                        return None

                until(lambda: answered() is not None, 120.0)
                (found,) = answered().pose_stamped
                assert found.pose.position.x > 0.5
            finally:
                process.send_signal(signal.SIGINT)
            assert process.wait(60) in (0, 130)
