"""A MuJoCo whose files were overwritten by another of its distributions is named, with the repair."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

LOAD = "import gazelle; gazelle.Simulation('empty')"


@pytest.fixture
def ray_offset(tmp_path):
    """Return an installer of distributions and a folder `mujoco` at the head of the path."""

    def lay(package, **versions):
        folder = tmp_path / "mujoco"
        folder.mkdir()
        for name, text in package.items():
            (folder / name).write_text(text)
        for name, number in versions.items():
            named = name.replace("_", "-")
            info = tmp_path / f"{name}-{number}.dist-info"
            info.mkdir()
            (info / "METADATA").write_text(
                f"Metadata-Version: 2.1\nName: {named}\nVersion: {number}\n"
            )
        paths = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
        return subprocess.run(
            [sys.executable, "-c", LOAD],
            env=os.environ | {"PYTHONPATH": paths},
            capture_output=True,
            text=True,
            check=False,
        )

    return lay


def judge(done, message):
    last = done.stderr.strip().splitlines()
    assert done.returncode != 0
    text = "\n".join(last)
    assert "gazelle.errors.EngineError" in text
    assert message in text
    assert "pip uninstall -y mujoco mujoco-core" in text
    assert "pip install --force-reinstall --no-deps" in text


def test_an_older_bundle_over_the_core_is_named(ray_offset):
    package = {"__init__.py": "__version__ = '3.3.7'\n", "batch.py": "raise AttributeError('x')\n"}
    done = ray_offset(package, mujoco="3.3.7", mujoco_core="4.0.1")
    judge(done, "mujoco-core 4.0.1 and mujoco 3.3.7 share a folder")


@pytest.mark.long
def test_two_that_happen_to_import_are_named_too(ray_offset):
    package = {"__init__.py": "__version__ = '3.3.7'\n", "batch.py": ""}
    done = ray_offset(package, mujoco="3.3.7", mujoco_core="4.0.1")
    judge(done, "MuJoCo is damaged")


def test_a_folder_that_an_uninstallation_emptied_is_named(ray_offset):
    judge(ray_offset({"__init__.py": ""}, mujoco_core="4.0.1"), "MuJoCo cannot be imported")


def test_a_folder_of_another_version_is_named(ray_offset):
    package = {"__init__.py": "__version__ = '3.17.0'\n", "batch.py": ""}
    done = ray_offset(package, mujoco_core="4.0.1")
    judge(done, "mujoco-core 4.0.1 is installed, and its folder holds 3.17.0")


def test_a_version_that_another_package_brought_down_is_named(ray_offset):
    """`mujoco` 4.0.0 asks for `mujoco-core` 4.0.0, which factorises sparse Hessians wrongly."""
    package = {"__init__.py": "__version__ = '4.0.0'\n", "batch.py": ""}
    done = ray_offset(package, mujoco="4.0.0", mujoco_core="4.0.0")
    judge(done, "MuJoCo 4.0.0 is too old")


def test_the_command_says_it_in_one_line(tmp_path):
    (tmp_path / "mujoco").mkdir()
    (tmp_path / "mujoco" / "__init__.py").write_text("")
    done = subprocess.run(
        [sys.executable, "-m", "gazelle", "run", "empty", "--for", "0.1"],
        env=os.environ | {"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    lines = [line for line in done.stderr.splitlines() if "loading" not in line]  # if it is slow
    assert lines[0].startswith("gazelle: error: MuJoCo cannot be imported")
