"""diagnostic_aggregator: groups of statuses, and their levels."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.diagnostic_aggregator import DiagnosticAggregator
from gazelle_ros.builtin.diagnostic_analyzers import STALE, analyzers_of, summary
from gazelle_ros.builtin.diagnostics import ERROR, OK, WARN, diagnostic_status
from gazelle_ros.msgs import diagnostic_msgs

ARRAY, STATUS = diagnostic_msgs.msg.DiagnosticArray, diagnostic_msgs.msg.DiagnosticStatus
POWER = {"type": "diagnostic_aggregator/GenericAnalyzer", "path": "Power System", "timeout": 5.0}


def status(name, level=OK, message="fine"):
    return diagnostic_status(name, {}, message, level)


def shown(groups, now=1.0):
    return {each.name: (each.level, each.message) for each in groups.report(now)}


@pytest.mark.parametrize(
    ("matching", "name", "title"),
    [
        ({"startswith": ["battery"]}, "battery 1", "battery 1"),
        ({"contains": "cell"}, "a cell/b", "a cell b"),
        ({"find_and_remove_prefix": "mobile_base: "}, "mobile_base: Motor", "Motor"),
        ({"find_and_remove_prefix": ["mobile_base"]}, "mobile_base: Motor", "Motor"),
        ({"contains": "Motor", "remove_prefix": "base"}, "base: Motor", "Motor"),
        ({"regex": "cell [0-9]+"}, "cell 12", "cell 12"),
        ({"expected": "cell"}, "cell", "cell"),
    ],
)
def test_a_status_comes_into_its_group_by_name(matching, name, title):
    groups = analyzers_of("a", {"power": POWER | matching}, "")
    assert groups.take(status(name, WARN, "low"), 0.0)
    assert not groups.take(status("another"), 0.0)
    assert shown(groups) == {
        "/Power System": (WARN, "Warning"),
        f"/Power System/{title}": (WARN, "low"),
    }


def test_statuses_become_stale_and_those_expected_are_missing():
    groups = analyzers_of("a", {"power": POWER | {"expected": ["one", "two"]}}, "/Robot")
    groups.take(status("one"), 0.0)
    assert shown(groups, 5.0) == {
        "/Robot": (ERROR, "Error"),
        "/Robot/Power System": (ERROR, "Error"),
        "/Robot/Power System/one": (OK, "fine"),
        "/Robot/Power System/two": (STALE, "Missing"),
    }
    assert shown(groups, 5.1)["/Robot/Power System"] == (STALE, "Stale")


def test_numbers_of_items_and_discarded_ones():
    groups = analyzers_of(
        "a", {"power": POWER | {"startswith": "b", "num_items": 2, "discard_stale": True}}, ""
    )
    for name in ("b1", "b2"):
        groups.take(status(name), 0.0)
    assert shown(groups)["/Power System"] == (OK, "OK")
    groups.take(status("b1"), 6.0)
    assert shown(groups, 7.0) == {
        "/Power System": (ERROR, "Expected 2, found 1"),
        "/Power System/b1": (OK, "fine"),
    }


def test_groups_in_groups_and_dropped_statuses():
    inner = {"power": POWER | {"contains": "battery"}}
    groups = analyzers_of(
        "a",
        {
            "base": {"type": "AnalyzerGroup", "path": "Base", "analyzers": inner},
            "noise": {"type": "DiscardAnalyzer", "path": "Noise", "contains": "noise"},
            "none": {"type": "IgnoreAnalyzer"},
        },
        "",
    )
    assert groups.take(status("noise"), 0.0)
    assert not groups.take(status("wheel"), 0.0)
    assert groups.take(status("battery", ERROR), 0.0)
    assert list(shown(groups)) == ["/Base", "/Base/Power System", "/Base/Power System/battery"]
    assert shown(groups)["/Base"] == (ERROR, "Error")


@given(st.lists(st.sampled_from([OK, WARN, ERROR, STALE]), max_size=6))
def test_a_group_is_as_bad_as_its_worst_part_and_stale_if_all_are(levels):
    found = summary("/g", [status(f"/g/{i}", level) for i, level in enumerate(levels)]).level
    if levels and set(levels) == {STALE}:
        assert found == STALE
    else:
        assert found == min(max(levels, default=OK), ERROR)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"type": "GenericAnalyser", "contains": "x"}, "a/power/type is no 'GenericAnalyser'"),
        ({"type": "GenericAnalyzer"}, "it would match nothing"),
        ({"type": "GenericAnalyzer", "contains": 3}, "must be a text or a list of texts, not 3"),
        ({"type": "GenericAnalyzer", "regex": "("}, "is not a regular expression"),
        (5, "must be a namespace with 'type' and 'path', not 5"),
    ],
)
def test_wrong_analyzers_are_refused(values, words):
    with pytest.raises(RosError, match=words.replace("(", r"\(")):
        analyzers_of("a", {"power": values}, "")


def test_the_node_publishes_groups_others_and_the_worst_level(make_node):
    node = make_node("/aggregator")
    node.set_param("~analyzers", {"power": POWER | {"contains": "battery"}})
    aggregator = DiagnosticAggregator(node)
    watcher = make_node("/watcher")
    reports, states = [], []
    watcher.subscribe("/diagnostics_agg", ARRAY, reports.append)
    watcher.subscribe("/diagnostics_toplevel_state", STATUS, states.append)
    source = watcher.advertise("/diagnostics", ARRAY)
    until(lambda: source.has_subscribers)

    def known():
        source.publish(ARRAY(status=[status("battery", WARN), status("arm: joint")]))
        aggregator.publish()
        return reports and len(reports[-1].status) == 4 and states

    until(known)
    assert [each.name for each in reports[-1].status] == [
        "/Power System",
        "/Power System/battery",
        "/Other",
        "/Other/arm: joint",
    ]
    until(lambda: states[-1].level == WARN)
    assert states[-1].name == "toplevel_state"
