"""A workspace with one package, and launch files written in tests."""

from __future__ import annotations

import pytest

from gazelle_ros.launch import Packages, load_launch
from gazelle_ros.messages import search


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """Yield a folder on ROS_PACKAGE_PATH with the package ``robot``."""
    folder = tmp_path / "ws"
    package = folder / "robot"
    (package / "launch").mkdir(parents=True)
    (package / "scripts").mkdir()
    (package / "package.xml").write_text("<package><name>robot</name></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder))
    monkeypatch.delenv("CMAKE_PREFIX_PATH", raising=False)
    search.forget()
    yield folder
    search.forget()


@pytest.fixture
def script(workspace):
    """Return a writer of executable scripts of the package ``robot``; it returns the path."""

    def write(name, text, *, executable=True):
        path = workspace / "robot" / "scripts" / name
        path.write_text(text)
        path.chmod(0o755 if executable else 0o644)
        return path

    return write


@pytest.fixture
def load(workspace):
    """Return a loader of ``<launch>`` with a body, as a file of the package ``robot``."""

    def run(body, args=None, *, name="main.launch", **others):
        folder = workspace / "robot" / "launch"
        for other, text in others.items():
            (folder / f"{other}.launch").write_text(f"<launch>\n{text}\n</launch>")
        path = folder / name
        path.write_text(f"<launch>\n{body}\n</launch>")
        return load_launch(path, args, packages=Packages())

    return run


@pytest.fixture
def values(load):
    """Return the values of the parameters of a launch file, by name."""

    def run(body, args=None, **others):
        plan = load(body, args, **others)
        return {name: each.value for name, each in plan.parameters.items()}

    return run
