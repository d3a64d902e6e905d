"""Bags written in tests."""

from __future__ import annotations

import pytest

from gazelle_ros import Time, load_message
from gazelle_ros.bags import Bag


@pytest.fixture
def string():
    return load_message("std_msgs/String")


@pytest.fixture
def write_bag(tmp_path, string):
    """Return a writer of messages, given as topic, text and seconds; it returns the path."""

    def write(rows, name="t.bag", **options):
        path = tmp_path / name
        with Bag(path, "w", **options) as bag:
            for topic, text, seconds in rows:
                bag.write(topic, string(data=text), Time.from_sec(seconds))
        return path

    return write


@pytest.fixture
def unindex():
    """Return a function that removes a bag's index, as in a truncated recording."""

    def run(path, *, keep=1.0):
        data = bytearray(path.read_bytes())
        place = data.index(b"index_pos=") + 10
        data[place : place + 8] = bytes(8)
        path.write_bytes(bytes(data[: int(len(data) * keep)]))

    return run
