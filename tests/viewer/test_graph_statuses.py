"""Displays of a graph say what is wrong with their topics."""

import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.viewer.graph.statuses import Arrivals, status_of

GOOD = {"kind": "a/B", "offered": "a/B", "publishers": 1, "unplaced": "", "error": ""}


class Ticking:
    """A clock that tests set."""

    now = 100.0

    def __call__(self):
        return self.now


def arrivals(count, gap=0.5, since=0.0):
    clock = Ticking()
    made = Arrivals(clock)
    for _ in range(count):
        clock.now += gap
        made.add()
    clock.now += since
    return made


@pytest.mark.parametrize(
    ("came", "change", "text"),
    [
        (arrivals(4), {"offered": "a/C"}, "type differs: a/C is published, a/B was shown"),
        (arrivals(4), {"error": "bad encoding"}, "bad encoding"),
        (
            arrivals(4),
            {"unplaced": "no transform from base_scan to odom"},
            "no transform from base_scan to odom, so it is not shown",
        ),
        (arrivals(4), {"publishers": 0, "offered": ""}, "it has no publisher"),
        (arrivals(4, since=7.0), {}, "no message for 7 s"),
    ],
)
def test_each_fault_is_named(came, change, text):
    status = status_of(came, **{**GOOD, **change})
    assert (status.text, status.fault) == (text, True)


@pytest.mark.parametrize(
    ("came", "text"),
    [
        (arrivals(0), "no message yet"),
        (arrivals(1, since=60.0), "1 message"),
        (arrivals(5), "5 messages, 2 Hz"),
        (arrivals(5, since=1.0), "5 messages, 1 Hz"),
    ],
)
def test_what_comes_in_is_counted(came, text):
    status = status_of(came, **GOOD)
    assert (status.text, status.fault) == (text, False)
