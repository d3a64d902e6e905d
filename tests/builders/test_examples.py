"""The examples run as they are."""

import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.formats import check

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(script, *args):
    done = subprocess.run(
        [sys.executable, EXAMPLES / script, *map(str, args)],
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.long
def test_build_an_office(tmp_path):
    out = run("build_an_office.py", "--seed", 1, "--out", tmp_path, "--width", 80)
    assert "after 1.0 s the robot is at" in out
    assert (tmp_path / "office.png").stat().st_size > 1000
    for name in ("office", "small_office", "one_room"):
        assert check(tmp_path / f"{name}.world") == []


@pytest.mark.long
@pytest.mark.parametrize("seed", [0, 5])
def test_equip_a_robot(tmp_path, seed):
    out = run("equip_a_robot.py", "--seed", seed, "--out", tmp_path)
    # It stands on Mars, and feels that.
    felt = float(out.split("felt acceleration ")[1].split()[0])
    assert felt == pytest.approx(3.73, abs=0.3)
    assert check(tmp_path / "robot.urdf") == []
    assert check(tmp_path / "mars.world") == []


def test_the_page_about_builders_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = (EXAMPLES.parent / "docs" / "how-to" / "builders.md").read_text(encoding="utf-8")
    blocks = [block.split("```")[0] for block in page.split("```python\n")[1:]]
    assert len(blocks) == 2
    names = {}
    for block in blocks:
        exec(compile(block, "docs/how-to/builders.md", "exec"), names)
    assert check("lab.world") == []
    names["sim"].close()


def test_the_page_about_builders_names_everything():
    import gazelle.builders

    page = (EXAMPLES.parent / "docs" / "how-to" / "builders.md").read_text(encoding="utf-8")
    inner = {"BuildError", "Opening", "Paint", "PALETTE", "PRESETS", "Place", "Planet", "Terrain",
             "Zone", "along", "material", "physics", "planet", "plan_places", "plan_size",
             "solid_inertial"}  # fmt: skip
    missing = [n for n in gazelle.builders.__all__ if n not in page and n not in inner]
    assert missing == []
