"""A graph as tools see it, and where they write."""

from __future__ import annotations

import io

import pytest

from gazelle_ros.tools.graph import GraphInspector


@pytest.fixture
def graph(master):
    with GraphInspector("rostool", master.uri, namespace="/") as made:
        yield made


@pytest.fixture
def out():
    return io.StringIO()
