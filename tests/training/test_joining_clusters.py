"""Joining a cluster leaves the process as it is; with a stand-in for Ray."""

from __future__ import annotations

import signal
import sys
import types

import pytest

from gazelle.training.workers.clusters import connect


@pytest.fixture
def joined(monkeypatch):
    """Yield the keywords of ``ray.init``, which takes SIGTERM for itself."""
    keywords = {}

    def init(**given):
        keywords.update(given)
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(number))

    ray = types.SimpleNamespace(
        init=init, is_initialized=lambda: False, cluster_resources=lambda: {"CPU": 2.0}
    )
    monkeypatch.setitem(sys.modules, "ray", ray)
    before = signal.getsignal(signal.SIGTERM)
    yield keywords
    signal.signal(signal.SIGTERM, before)


@pytest.mark.parametrize("address", [None, "", "local", "auto"])
def test_a_handler_of_sigterm_stays(joined, address):
    def save(number, frame):
        pass

    signal.signal(signal.SIGTERM, save)
    assert connect(address) == 2
    assert signal.getsignal(signal.SIGTERM) is save


def test_without_a_handler_ray_ends_its_processes(joined):
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    connect("auto")
    assert signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL


@pytest.mark.parametrize("address", [None, "", "local"])
def test_a_cluster_of_this_machine_is_reached_by_nobody_else(joined, address):
    connect(address)
    assert joined["address"] == "local"
    assert joined["_node_ip_address"] == "127.0.0.1"
    assert joined["include_dashboard"] is False
