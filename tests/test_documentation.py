"""Commands and code of the documentation work as typed."""

import importlib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from ports import free_port

from gazelle.cli.commands import COMMANDS
from gazelle_ros import tool_names

ROOT = Path(__file__).parent.parent
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
TUTORIALS = sorted((ROOT / "docs" / "tutorials").glob("*-*.md"))
HOW_TO = sorted(set((ROOT / "docs" / "how-to").glob("*.md")) - {ROOT / "docs/how-to/index.md"})
FENCE = re.compile(r"^```(\w+)(?: file=(\S+))?\n(.*?)^```", re.DOTALL | re.MULTILINE)
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


def python_of(page):
    """Return the Python blocks of a page as one program."""
    return "\n".join(
        re.findall(r"^```python\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)
    )


@pytest.mark.long
@pytest.mark.parametrize("page", [p for p in PAGES if python_of(p)], ids=lambda p: p.name)
def test_the_python_of_a_page_runs(page, tmp_path):
    # Pages make folders; a short path, since sockets of processes lie in it.
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, "-c", python_of(page)],
            cwd=tmp_path,
            env={**os.environ, "TMPDIR": folder},
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
    assert done.returncode == 0, done.stderr


def _without_numbers(text):
    return re.sub(r"[ \t]+", " ", re.sub(r"-?[\d.,:]*\d", "N", text))


@pytest.mark.long
@pytest.mark.parametrize("page", TUTORIALS, ids=lambda p: p.name)
def test_a_tutorial_works_as_typed(page, tmp_path):
    """Blocks with ``file=NAME`` are saved, ``sh`` is typed into one shell, ``text`` comes out."""
    blocks = FENCE.findall(page.read_text())
    for _, name, text in blocks:
        if name:
            (tmp_path / name).write_text(text)
    typed = "".join(text for kind, name, text in blocks if kind == "sh" and not name)
    shown = [text for kind, name, text in blocks if kind == "text" and not name]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            ["bash", "-euc", f"trap 'kill $(jobs -p) 2>/dev/null || true; wait' EXIT\n{typed}"],
            cwd=tmp_path,
            env={
                **os.environ,
                "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
                "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
                "TMPDIR": folder,
            },
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=300,
            check=False,
        )
    assert typed
    assert done.returncode == 0, done.stdout
    came = _without_numbers(done.stdout)
    for line in "".join(shown).splitlines():
        assert _without_numbers(line).strip() in came, f"{line}\n{done.stdout}"


@pytest.mark.long
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda p: p.name)
def test_an_example_runs_in_an_empty_folder(example, tmp_path):
    done = subprocess.run(
        [sys.executable, str(example)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("page", HOW_TO, ids=lambda p: p.name)
def test_a_guide_answers_one_question_in_at_most_400_words(page):
    """Code and tables do not count."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    prose = [line for line in text.splitlines() if not line.startswith(("|", "    "))]
    assert 20 < len(" ".join(prose).split()) <= 400


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_links_and_commands_of_a_page_exist(page):
    text = page.read_text()
    for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target
    for command in re.findall(r"(?:^ {4}|`)gazelle ([a-z]+)\b", text, re.MULTILINE):
        assert command in {**COMMANDS, **tool_names.COMMANDS}, command


def test_our_names_beside_those_of_other_tools_exist():
    """Each is a method, property or field of what its first word stands for."""
    import gazelle
    from gazelle import clients
    from gazelle.simulation.physics import _NAMES as PHYSICS
    from gazelle.simulation.physics import PhysicsProperties

    text = (ROOT / "docs" / "reference" / "names.md").read_text()
    owners = {
        "gazebo": clients.Gazebo,
        "controllers": clients.Controllers,
        "processes": clients.Processes,
    }
    found = re.findall(r"`(?:with )?([a-z]+)\.(\w+)", text)
    missing = [
        f"{owner}.{name}"
        for owner, name in found
        if owner in owners and not hasattr(owners[owner], name)
    ]
    with gazelle.Simulation("empty", engine="planar") as sim:
        sim.spawn("turtlebot3_burger", name="robot")
        there = {"sim": sim, "robot": sim.robots["robot"]}
        missing += [
            f"{owner}.{name}"
            for owner, name in found
            if owner in there and not hasattr(there[owner], name)
        ]
    for name in re.findall(r"`sim\.physics\.(\w+)", text):
        if name not in PHYSICS and not hasattr(PhysicsProperties, name):
            missing.append(f"sim.physics.{name}")
    for dotted in re.findall(r"`(?:with )?(gazelle(?:_ros)?(?:\.\w+)+)", text):
        module, _, name = dotted.rpartition(".")
        if not hasattr(importlib.import_module(module), name):
            missing.append(dotted)
    assert missing == []
    assert len(found) > 60


def test_the_readme_names_the_two_commands_first():
    first_screen = (ROOT / "README.md").read_text().splitlines()[:24]
    text = "\n".join(first_screen)
    assert "make demo" in text
    assert "make test" in text
    assert "room.png" in text
