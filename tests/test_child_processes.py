"""Programs that are started: an interrupt at any moment leaves none of them running."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from gazelle.cli.main import main
from gazelle_ros.base.child_processes import child_process
from gazelle_ros.base.interrupts import Interrupted, holding, interruptible
from gazelle_ros.launch import Packages, programs
from gazelle_ros.launch.process import NodeProcess, Start

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="sends signals")
PAIRS = [
    (signal.SIGTERM,),
    (signal.SIGINT,),
    (signal.SIGTERM, signal.SIGINT),
    (signal.SIGINT, signal.SIGINT),
]


@pytest.fixture
def interrupted_starts(monkeypatch):
    """Send signals to this process while it starts another; return a list and the other's number."""
    plain, started, numbers = subprocess.Popen._execute_child, [], []

    def start(self, *args):
        plain(self, *args)
        started.append(self.pid)
        for number in numbers:
            os.kill(os.getpid(), number)

    monkeypatch.setattr(subprocess.Popen, "_execute_child", start)
    yield numbers, started
    for pid in started:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            continue


def beside_a_block(_folder):
    with child_process(["/bin/sleep", "100"]) as process:
        process.wait()


def of_a_launch_file(_folder):
    programs._output("/bin/sleep 100", Packages(), None)


def node_of_a_launch_file(folder):
    start = Start(("/bin/sleep", "100"), dict(os.environ), folder, None)
    process = NodeProcess(SimpleNamespace(place=None), "a", start)
    try:
        process.start()
    finally:
        process.finish()


@pytest.mark.parametrize("numbers", PAIRS, ids=str)
@pytest.mark.parametrize("run", [beside_a_block, of_a_launch_file, node_of_a_launch_file])
def test_signals_while_a_program_starts_leave_none(run, numbers, interrupted_starts, tmp_path):
    sent, started = interrupted_starts
    sent.extend(numbers)
    with pytest.raises(Interrupted), interruptible():
        run(tmp_path)
    (pid,) = started
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_an_interrupted_interactive_shell_is_ended(
    interrupted_starts, capsys, monkeypatch, tmp_path
):
    shell = tmp_path / "myshell"
    shell.write_text("#!/bin/sh\nexec sleep 100\n")
    shell.chmod(0o755)
    monkeypatch.setenv("SHELL", str(shell))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    sent, started = interrupted_starts
    sent.extend((signal.SIGTERM, signal.SIGINT))
    code = main(["shell"])
    assert code in {128 + number for number in sent}
    assert "interrupted" in capsys.readouterr().err
    (pid,) = started
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_a_program_that_ends_is_left_alone():
    with child_process([sys.executable, "-S", "-c", "raise SystemExit(3)"]) as process:
        assert process.wait() == 3
    assert process.returncode == 3


def test_an_interrupt_waits_for_the_end_of_a_block():
    done = []

    def work():
        with holding():
            with holding():
                os.kill(os.getpid(), signal.SIGTERM)
                time.sleep(0.001)
            done.append("inner")
        done.append("outer")

    with pytest.raises(Interrupted) as raised, interruptible():
        work()
    assert (done, raised.value.signal) == (["inner"], signal.SIGTERM)
    with holding():  # nobody handles signals
        pass


@pytest.mark.long
def test_a_command_of_a_shell_takes_the_place_of_gazelle(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle", "shell", "-c", "echo $$; trap"],
        env=os.environ | {"SHELL": "/bin/sh", "XDG_CACHE_HOME": str(tmp_path)},
        stdout=subprocess.PIPE,
        text=True,
    )
    said, _ = process.communicate()
    assert said.splitlines() == [str(process.pid)]
