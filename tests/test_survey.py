"""The tool that counts what becomes of description files tells what runs from what does not."""

import importlib.util
import sys
from pathlib import Path

import pytest

FILE = Path(__file__).parent.parent / "tools" / "survey.py"
BODY = (
    "<link name='l'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>"
)
CASES = {
    "runs": f"<robot name='r'>{BODY}</robot>",
    "has nothing to run": "<sdf version='1.6'><world name='w'/></sdf>",
    "refused": "<robot name='r'><link name='l'></robot>",
    "meant to be included": "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'/>",
}


@pytest.fixture
def survey(monkeypatch):
    spec = importlib.util.spec_from_file_location("survey", FILE)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "survey", module)
    spec.loader.exec_module(module)
    return module


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("said", CASES)
def test_what_becomes_of_a_file_is_told(survey, tmp_path, said):
    path = tmp_path / ("a.urdf" if said != "meant to be included" else "a.xacro")
    path.write_text(CASES[said])
    outcome = survey.tried(path, 0.01)
    assert outcome.said == said, outcome.error
    assert (outcome.build > 0.0) == (said == "runs")
