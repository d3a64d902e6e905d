"""Every file of the corpus loads, or is refused for a reason that a human agrees with."""

import difflib

import corpus_table
import pytest

from gazelle import formats

pytestmark = pytest.mark.corpus

BROKEN_ON_PURPOSE = "gazebosim__sdformat/test/sdf"

# seconds of files that take more than one, and why
SLOW = {
    # a stress test: macros make 1,200 links of 41,000 elements, one by one, in Python
    "ros-simulation__gazebo_ros_pkgs/gazebo_plugins/test2/large_models/large_model.urdf.xacro": 4.0,
}


@pytest.fixture(scope="module")
def outcomes(corpus):
    return corpus_table.sweep(corpus)


@pytest.mark.long
def test_what_becomes_of_each_file_is_in_the_table(outcomes):
    expected = corpus_table.TABLE.read_text(encoding="utf-8").splitlines()
    found = corpus_table.as_text(outcomes).splitlines()
    change = list(difflib.unified_diff(expected, found, "corpus_table.txt", "now", n=0))
    assert not change, "\n".join(change[:40])
    assert len(outcomes) > 800


@pytest.mark.long
def test_none_takes_more_than_a_second(corpus, outcomes):
    slow = [name for name, (_, s) in outcomes.items() if s > SLOW.get(name, 1.0)]
    again = {
        name: min(corpus_table.outcome(corpus / name, corpus)[1] for _ in "12") for name in slow
    }
    assert {name: s for name, s in again.items() if s > SLOW.get(name, 1.0)} == {}
    seconds = sorted(seconds for _, seconds in outcomes.values())
    assert seconds[len(seconds) // 2] < 0.02


@pytest.mark.long
def test_refusals_name_file_and_line(corpus, outcomes):
    refused = [name for name, (said, _) in outcomes.items() if said.startswith("refused")]
    for name in refused:
        problem = next(p for p in formats.check(corpus / name) if p.severity == "error")
        assert problem.file, name
        assert problem.line or "file" in problem.message or "robot_model" in problem.message, name


def test_files_made_wrong_on_purpose_are_errors_of_a_check(corpus):
    folder = corpus / BROKEN_ON_PURPOSE
    bad = [f for f in folder.glob("*.sdf") if "invalid" in f.name or "bad" in f.name]
    assert len(bad) > 10
    passed = [
        file.name
        for file in bad
        if not any(each.severity == "error" for each in formats.check(file))
    ]
    assert passed == []
