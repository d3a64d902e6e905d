"""A terminal that is closed ends what runs in it, without an error of what it prints at its end."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import signal
import sys
from pathlib import Path

import pytest
from ports import free_port
from ros.graph import until

from gazelle_ros.base.terminal import kept_terminal
from tests.processes import is_running

pty = pytest.importorskip("pty")
termios = pytest.importorskip("termios")


def test_settings_come_back_if_the_terminal_is_there():
    keys, number = pty.openpty()
    with open(number) as terminal:  # noqa: PTH123  # by its number
        before = termios.tcgetattr(number)
        with kept_terminal(terminal) as there:
            changed = termios.tcgetattr(number)
            changed[3] &= ~termios.ECHO
            termios.tcsetattr(number, termios.TCSANOW, changed)
        assert there
        assert termios.tcgetattr(number) == before
        with kept_terminal(terminal):
            os.close(keys)


@pytest.mark.parametrize("stream", [None, io.StringIO()])
def test_other_streams_are_no_terminals(stream):
    with kept_terminal(stream) as there:
        assert not there


@pytest.mark.parametrize(("asked", "code"), [(True, 129), (False, 1)])
def test_what_cannot_be_printed_any_more_is_no_error(asked, code, cli, monkeypatch):
    def run(_args):
        if asked:
            monkeypatch.setattr("gazelle_ros.cli.main.requested", lambda: True)
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr("gazelle_ros.cli.main._discard_output", lambda: None)
    monkeypatch.setattr("gazelle_ros.cli.main.end_process", lambda _code: None)
    monkeypatch.setattr("gazelle.cli.worlds.run", run)
    found, _, err = cli("worlds")
    assert found == code
    assert ("Input/output error" in err) is not asked


LAUNCH = """<launch><node pkg="tf" type="static_transform_publisher" name="a" required="false"
args="0 0 0 0 0 0 a b 100" launch-prefix="/bin/sh -c 'echo working; exec sleep 100'"/></launch>"""


@pytest.mark.long
@pytest.mark.parametrize(
    ("words", "sign"),
    [
        ("launch a.launch", "process[a"),
        ("film empty a.gif --for 1e5 --size 16x16", "filming"),
        ("run empty", "step"),
    ],
)
def test_commands_in_a_closed_terminal_end_quietly(words, sign, tmp_path):
    (tmp_path / "a.launch").write_text(LAUNCH)
    said, port = tmp_path / "said.txt", free_port()
    pid, keys = pty.fork()
    if not pid:
        os.chdir(tmp_path)
        os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
        os.dup2(os.open(said, os.O_WRONLY | os.O_CREAT), 2)
        os.execv(sys.executable, [sys.executable, "-m", "gazelle", *words.split()])
    shown = b""
    os.set_blocking(keys, False)

    def there():
        nonlocal shown
        with contextlib.suppress(BlockingIOError):
            shown += os.read(keys, 65536)
        return sign in shown.decode() + said_by(said)

    try:
        until(there, 120.0)
        os.close(keys)
        until(lambda: not is_running(pid))
    finally:
        os.kill(pid, signal.SIGKILL)
        code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    assert code in (0, 129)
    assert "rror" not in said_by(said)


def said_by(file: Path) -> str:
    return file.read_text() if file.exists() else ""
