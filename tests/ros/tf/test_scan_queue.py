"""Scans are used in their order, none is left out, however late transforms are."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros import Master, Node, load_message
from gazelle_ros.tf.scan_queue import ScanQueue


class Transforms:
    """Are known from one time to another."""

    def __init__(self, first=0, last=-1):
        self.first, self.last = first, last
        self.later = []

    def find(self, message):
        stamp = message.header.stamp.to_nsec()
        found = stamp if self.first <= stamp <= self.last else None
        if self.later:  # more come between any two looks
            self.last = self.later.pop(0)
        return found


def scan(stamp):
    made = load_message("sensor_msgs/LaserScan")()
    made.header.stamp.nsecs = stamp
    return made


@pytest.fixture(scope="module")
def queue():
    with Master(port=0) as master, Node("/taker", master_uri=master.uri) as node:
        yield ScanQueue(node, "scan", load_message("sensor_msgs/LaserScan"))


def work(queue, transforms, used):
    queue.work(
        transforms.find, lambda message, found: used.append((message.header.stamp.to_nsec(), found))
    )


@given(st.lists(st.integers(0, 9), max_size=20).map(sorted))
def test_transforms_that_come_meanwhile_cost_no_scan(queue, arrivals):
    for stamp in range(10):
        queue.add(scan(stamp))
    transforms, used = Transforms(), []
    transforms.later = list(arrivals)
    while transforms.later and len(used) < 10:
        work(queue, transforms, used)
    transforms.later, transforms.last = [], 9
    if len(used) < 10:
        work(queue, transforms, used)
    assert used == [(stamp, stamp) for stamp in range(10)]


def test_scans_older_than_all_transforms_are_left_out(queue):
    for stamp in range(6):
        queue.add(scan(stamp))
    used = []
    work(queue, Transforms(3, 9), used)
    assert used == [(3, 3), (4, 4), (5, 5)]
    assert not queue._waiting


def test_what_waits_for_its_transform_stays(queue):
    for stamp in range(4):
        queue.add(scan(stamp))
    used = []
    work(queue, Transforms(0, 1), used)
    assert used == [(0, 0), (1, 1)]
    work(queue, Transforms(0, 3), used)
    assert [stamp for stamp, _ in used] == [0, 1, 2, 3]
