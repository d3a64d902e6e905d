"""Many clients at once, half of the time while the world is paused: nothing hangs or is lost."""

from __future__ import annotations

import ctypes
import gc
import random
import resource
import threading
from pathlib import Path

import pytest
from graph_client import BALL, Client, model_state, pose

CLIENTS = 8
ALLOWED = (
    "SpawnModel: Successfully spawned entity",
    "SpawnModel: Failure - entity already exists.",
    "DeleteModel: successfully deleted model",
    "DeleteModel: model does not exist",
    "SetModelState: set model state done",
    "SetModelState: model does not exist",
)


def bother(uri, number, calls, faults):
    """Spawn, delete, set and reset at random."""
    client = Client(uri, f"client{number}")
    dice = random.Random(number)
    try:
        for _ in range(calls):
            name = f"ball{dice.randrange(4)}"
            answer = act(client, dice.random(), name)
            if answer is not None and answer.status_message not in ALLOWED:
                faults.append(answer.status_message)
    except Exception as error:  # noqa: BLE001  whatever it is, the test wants to know
        faults.append(repr(error))
    finally:
        client.node.close()


def act(client, chance, name):
    """Make one call, the quick kinds more often than the slow ones."""
    if chance < 0.04:
        return client.call("spawn_sdf_model", "SpawnModel", model_name=name, model_xml=BALL)
    if chance < 0.08:
        return client.call("delete_model", "DeleteModel", model_name=name)
    if chance < 0.96:
        state = model_state(name, pose(chance, 0.0, 1.0))
        return client.call("set_model_state", "SetModelState", model_state=state)
    kinds = ("reset_simulation", "reset_world", "pause_physics", "unpause_physics")
    client.call(kinds[int(chance * 1000) % 4], "std_srvs/Empty")
    return None


def storm(graph, calls):
    """Run all clients at once; return the wrong results."""
    faults: list[str] = []
    threads = [
        threading.Thread(target=bother, args=(graph.master.uri, i, calls // CLIENTS, faults))
        for i in range(CLIENTS)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=1500)
    assert not any(thread.is_alive() for thread in threads), "a call hangs"
    return faults


@pytest.mark.long
def test_clients_that_call_at_once_all_get_their_answers(running):
    assert storm(running, 1600) == []


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_hundred_thousand_calls_leave_memory_flat(running):
    assert storm(running, 10_000) == []
    before = memory()
    assert storm(running, 100_000) == []
    assert memory() - before < 30.0


def memory():
    """Return resident memory [MB], without what the C library keeps for itself (Linux)."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[1])
    return pages * resource.getpagesize() / 1e6
