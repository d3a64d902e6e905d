"""The bundled package of a fleet, as its users start it."""

import subprocess
import sys

import pytest
from ports import free_port


def run(*words, folder):
    command = [sys.executable, "-m", "gazelle", *words]
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=100, check=False
    )


@pytest.mark.long
def test_its_script_drives_all_and_none_bumps(tmp_path):
    done = run("exec", "fleet_stage", "drive_fleet.py", "--rounds", "1", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "no AGV bumped into anything" in done.stdout


def test_an_unknown_program_of_it_is_told_apart(tmp_path):
    done = run("exec", "fleet_stage", "drive_flet.py", folder=tmp_path)
    assert done.returncode != 0
    assert "did you mean 'drive_fleet.py'" in done.stderr


@pytest.mark.slow
def test_its_launch_file_drives_them_in_real_time(tmp_path):
    words = ("fleet_stage", "fleet.launch", "drive:=true", "rounds:=1", "-p", str(free_port()))
    done = run("launch", *words, folder=tmp_path)
    assert "done in" in done.stdout, done.stderr
