"""Every file of the corpus loads, or is refused for a reason that a human agrees with."""

import difflib
import time

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

QUIET = 25.0
"""So often a second holds the work of `second` on a quiet machine."""


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


def second():
    """Return the processor time that a quiet machine's second of work takes now [s].

    Programs beside this one slow a processor down: they share its caches and its clock.
    """
    start = time.process_time()
    assert sum(number & 7 for number in range(1_000_000)) == 3_500_000
    return (time.process_time() - start) * QUIET


@pytest.mark.long
def test_none_takes_more_than_a_second(corpus, outcomes):
    def over(name, seconds):
        return seconds > SLOW.get(name, 1.0)

    def again(name):
        before = second()
        _, seconds = corpus_table.outcome(corpus / name, corpus)
        return seconds / max(before, second())

    slow = [name for name, (_, seconds) in outcomes.items() if over(name, seconds)]
    slow = {name: min(again(name) for _ in range(3)) for name in slow}
    assert {name: seconds for name, seconds in slow.items() if over(name, seconds)} == {}
    seconds = sorted(seconds for _, seconds in outcomes.values())
    assert seconds[len(seconds) // 2] < 0.02 * max(second() for _ in range(5))


@pytest.mark.long
def test_refusals_name_file_and_line(corpus, outcomes):
    refused = [name for name, (said, _) in outcomes.items() if said.startswith("refused")]
    for name in refused:
        found = formats.check(corpus / name)
        problem = next(p for p in found if p.severity == "error" or p.rule == "only-macros")
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
