"""Imports of the package are declared, and those of tests come with the extra `test`."""

from __future__ import annotations

import ast
import functools
import re
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
ROS_FILE = ROOT / "packages" / "gazelle-ros" / "pyproject.toml"
ROS_PROJECT = tomllib.loads(ROS_FILE.read_text(encoding="utf-8"))["project"]
DEVELOPERS = {"test", "lint", "oracle", "bench", "docs"}
"""Extras that no user installs."""

NOT_OURS = {
    "cv2": "cv_bridge hands images to the user's OpenCV, and says so where there is none",
    "onnxruntime": "whoever deploys ONNX policies chooses one of its builds; it is in `test`",
    "mujoco_warp": "it would bring another MuJoCo over Gazelle's; the engine says the commands",
    "warp": "is warp-lang, of the extra `warp`",
    "cython": "what is compiled needs it no more; it is in the extra `test`",
}
"""Libraries that nobody can declare, and why."""


def distributions(lines):
    """Return the names of packages in requirements, also those of our own extras."""
    found = set()
    for line in lines:
        name = re.split(r"[^A-Za-z0-9_.-]", line)[0]
        project = {"gazelle": PROJECT, "gazelle-ros": ROS_PROJECT}.get(name)
        if project is not None:
            extras = re.search(r"\[(.*)\]", line)
            for extra in extras[1].split(",") if extras else ():
                found |= distributions(project["optional-dependencies"][extra.strip()])
        else:
            found.add(plain(name))
    return found


def plain(name):
    """Return a package's name as PyPI compares it (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


@functools.cache
def imported(path):
    """Return libraries that a file imports anywhere, and whether on its own import."""
    return list(_imported(path))


def _imported(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names = [node.module]
        else:
            continue
        for name in names:
            yield name.split(".")[0], node in tree.body


def strangers(paths, allowed, *, own=()):
    """Return imports from outside of Python, the project and allowed packages."""
    owners = packages_distributions()
    found = {}
    for path in paths:
        for name, at_once in imported(path):
            if name in sys.stdlib_module_names or name in own:
                continue
            if not {plain(each) for each in owners.get(name, [name])} & allowed:
                found.setdefault(name, []).append((str(path.relative_to(ROOT)), at_once))
    return found


def sources():
    programs = set((ROOT / "gazelle").glob("assets/*/scripts/*.py"))
    return sorted(set((ROOT / "gazelle").rglob("*.py")) - programs)


def ros_sources():
    return sorted((ROOT / "packages" / "gazelle-ros").rglob("*.py"))


@pytest.mark.long
def test_what_users_import_is_declared_for_users():
    extras = set(PROJECT["optional-dependencies"]) - DEVELOPERS
    allowed = distributions(PROJECT["dependencies"])
    for extra in extras:
        allowed |= distributions(PROJECT["optional-dependencies"][extra])
    assert strangers(sources(), allowed, own={"gazelle", "gazelle_ros", *NOT_OURS}) == {}


@pytest.mark.long
def test_what_ros_imports_is_declared_by_its_distribution():
    allowed = distributions(ROS_PROJECT["dependencies"])
    for lines in ROS_PROJECT["optional-dependencies"].values():
        allowed |= distributions(lines)
    assert strangers(ros_sources(), allowed, own={"gazelle_ros", *NOT_OURS}) == {}


@pytest.mark.long
def test_what_tests_import_at_once_comes_with_the_extra_test():
    """`make test` installs just that; a test that needs more asks for it when it runs."""
    allowed = distributions(PROJECT["dependencies"])
    allowed |= distributions(PROJECT["optional-dependencies"]["test"])
    folders = [ROOT / name for name in ("tests", "tools", "benchmarks")]
    own = {
        "gazelle",
        "gazelle_ros",
        "tests",
        *(each.stem for folder in folders for each in folder.rglob("*")),
    }
    collected = [*ROOT.glob("tests/**/test_*.py"), *ROOT.glob("tests/**/conftest.py")]
    assert len(collected) > 300
    found = strangers(collected, allowed, own=own)
    at_once = {
        name: places for name, uses in found.items() if (places := [p for p, now in uses if now])
    }
    assert at_once == {}


@pytest.mark.parametrize("line", ["import lxml", "def f():\n    from lxml import etree"])
def test_an_import_that_nobody_declared_is_caught(line, tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    path = tmp_path / "made.py"
    path.write_text(line)
    assert list(strangers([path], distributions(PROJECT["dependencies"]))) == ["lxml"]
