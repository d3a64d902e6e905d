"""Every command ends on Ctrl-C and SIGTERM, waiting or working, and leaves no process behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path

import pytest
from cli.ending_states import (
    FILES,
    MARK,
    STATES,
    complaints,
    left_behind,
    spent,
    spent_by_session,
    write_policy,
)
from ports import free_port

from gazelle.cli.commands import COMMANDS
from gazelle_ros import Master

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(sys.platform != "linux", reason="reads /proc"),
]

PROCESSOR_S = 2.0
"""Limit of processor time for the end of a command; the wall clock depends on other programs."""
WALL_S = 30.0


@pytest.fixture(scope="module")
def policy(tmp_path_factory):
    return write_policy(tmp_path_factory.mktemp("policy"))


class Running:
    """A command in a state.

    Args:
        state: Which.
        number: The signal that it will be sent.
        folder: Its own.
        words: What stands for other words in the command line.
    """

    def __init__(self, state, number, folder, words):
        self.master = Master(port=0) if state.master else None
        uri = self.master.uri if self.master else f"http://127.0.0.1:{free_port()}/"
        self.state, self.number, self.folder = state, number, folder
        for name, text in FILES.items():
            (folder / name).write_text(text)
        self.mark = uuid.uuid4().hex
        line = state.words
        for name, value in words.items():
            line = line.replace(name, str(value))
        self.said = folder / "said.txt"
        with self.said.open("w") as out:
            self.process = subprocess.Popen(
                ["/bin/sh", "-c", f'exec "$0" -m gazelle {line}', sys.executable],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                cwd=folder,
                env=os.environ | {"ROS_MASTER_URI": uri, MARK: self.mark},
                start_new_session=True,
            )

    def __str__(self):
        return f"{self.state.words}, signal {self.number}: {self.said.read_text()[-2000:]}"

    @property
    def processor(self):
        """Return the processor time of the process itself [s], also after its end."""
        return spent(Path(f"/proc/{self.process.pid}"))[1]

    @property
    def ended(self):
        options = os.WEXITED | os.WNOHANG | os.WNOWAIT
        return os.waitid(os.P_PID, self.process.pid, options) is not None

    def there(self):
        """Return True once it has reached its state."""
        sign = self.state.sign
        if isinstance(sign, float):
            return self.ended or spent_by_session(self.process.pid) >= sign
        if sign.startswith("FOLDER/"):
            return any(self.folder.glob(sign.removeprefix("FOLDER/")))
        return sign in self.said.read_text()

    def ask(self):
        """Send the signal; SIGTERM twice at once, as ``timeout`` does."""
        self.spent = self.processor
        os.kill(self.process.pid, self.number)
        if self.number == signal.SIGTERM:
            os.killpg(self.process.pid, self.number)

    def check(self):
        """Check its end."""
        until(lambda: self.ended, self)
        ending = self.processor - self.spent
        code = self.process.wait()
        said = self.said.read_text()
        good = {0, 128 + self.number}
        if isinstance(self.state.sign, float) or self.state.script:
            good |= {1, -self.number}  # done by then, or Python was still starting or ending
        assert code in good, (code, str(self))
        assert not complaints(self.state, said), str(self)
        assert ending < PROCESSOR_S, (ending, str(self))
        assert not self.state.saved or any(self.folder.glob(self.state.saved)), str(self)
        until(lambda: not left_behind(self.mark), self)

    def kill(self):
        for each in left_behind(self.mark):
            try:
                os.kill(int(each.name), signal.SIGKILL)
            except ProcessLookupError:
                continue
        self.process.wait()
        if self.master:
            self.master.close()


def until(true, running, seconds=WALL_S):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, str(running)
        time.sleep(0.02)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_ends_waiting_and_working(name, tmp_path, policy):
    running = []
    try:
        for place, state in enumerate(STATES[name]):
            for number in (signal.SIGINT, signal.SIGTERM):
                folder = tmp_path / f"{place}-{number}"
                folder.mkdir()
                words = {"FOLDER": folder, "POLICY": policy}
                running.append(Running(state, number, folder, words))
        for each in running:
            until(lambda each=each: each.there() or each.ended, each, 120.0)
            assert not each.ended or isinstance(each.state.sign, float), str(each)
            each.ask()
        for each in running:
            each.check()
    finally:
        for each in running:
            each.kill()
