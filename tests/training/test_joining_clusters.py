"""Joining a cluster leaves the process as it is; with a stand-in for Ray."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
import types

import pytest
from processes import is_running

from gazelle.errors import TaskError
from gazelle.training.workers.clusters import connect
from gazelle_ros.base.child_processes import descendants
from gazelle_ros.base.interrupts import Interrupted, interruptible


@pytest.fixture
def joined(monkeypatch, tmp_path):
    """Yield the keywords of ``ray.init``, which takes SIGTERM for itself."""
    keywords = {}

    def init(**given):
        keywords.update(given)
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(number))

    ray = types.SimpleNamespace(
        init=init,
        is_initialized=lambda: False,
        cluster_resources=lambda: {"CPU": 2.0},
        __file__=str(tmp_path / "ray" / "__init__.py"),
    )
    monkeypatch.setitem(sys.modules, "ray", ray)
    before = signal.getsignal(signal.SIGTERM)
    yield keywords
    signal.signal(signal.SIGTERM, before)


@pytest.mark.parametrize("address", ["local", "auto"])
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


@pytest.mark.parametrize("address", ["", " "])
def test_an_empty_address_starts_nothing(joined, address):
    with pytest.raises(TaskError, match="address of a Ray cluster is empty"):
        connect(address)
    assert not joined


def test_a_cluster_of_this_machine_is_reached_by_nobody_else(joined):
    connect("local")
    assert joined["address"] == "local"
    assert joined["_node_ip_address"] == "127.0.0.1"
    assert joined["include_dashboard"] is False


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT])
def test_an_interrupted_start_leaves_no_process_of_its_own(joined, monkeypatch, tmp_path, how):
    began = []
    tree = tmp_path / "ray" / "raylet.py"
    tree.parent.mkdir()
    tree.write_text(
        "import subprocess as s; s.Popen(['sleep', '100']); print(flush=True); s.os.wait()"
    )
    others = [subprocess.Popen(["sleep", "100"])]
    before = set(descendants())
    take_sigterm = sys.modules["ray"].init

    def init(**keywords):
        take_sigterm()
        began.append(subprocess.Popen([sys.executable, tree], stdout=subprocess.PIPE))
        began[0].stdout.readline()
        began.extend(set(descendants()) - before - {began[0].pid})
        # As another thread may, which knows nothing of Ray.
        others.append(subprocess.Popen(["sleep", "100"]))
        signal.raise_signal(how)

    monkeypatch.setattr(sys.modules["ray"], "init", init)
    with pytest.raises(Interrupted) as caught, interruptible():
        connect("local")
    assert caught.value.signal == how
    assert began[0].wait(10) == -signal.SIGKILL
    assert [other.poll() for other in others] == [None, None]
    for other in others:
        other.kill()
        other.wait()
    began[0].stdout.close()
    assert len(began) == 2
    while is_running(began[1]):
        time.sleep(0.01)
