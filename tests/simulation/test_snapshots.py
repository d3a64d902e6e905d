"""Bytes that are no snapshot are refused, and nothing changes."""

from __future__ import annotations

import io

import numpy as np
import pytest

import gazelle
from gazelle.errors import SimulationError


def an_archive():
    buffer = io.BytesIO()
    np.savez(buffer, numbers=np.zeros(3))
    return buffer.getvalue()


def test_bytes_that_are_no_snapshot_are_refused():
    with gazelle.Simulation("shapes") as sim:
        sim.run(0.01)
        good = sim.snapshot()
        before = sim.state_hash()
        for bad in (b"", b"hello", good[:100], good[:-100], good[200:], an_archive()):
            with pytest.raises(SimulationError, match="no snapshot"):
                sim.restore(bad)
        assert sim.state_hash() == before
        sim.restore(good)
