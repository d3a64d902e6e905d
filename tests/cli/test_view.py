"""Files are looked at from the shell, and nothing is left behind at the end."""

import re
import signal
import subprocess
import sys

import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.simulation import Simulation


@pytest.mark.long
@pytest.mark.parametrize("source", ["turtlebot3_burger", "run.jsonl"])
def test_a_file_is_shown_until_ctrl_c(tmp_path, source):
    if source == "run.jsonl":
        with Simulation("empty", threads=1) as simulation, simulation.record(tmp_path / source):
            simulation.run(0.2)
    with subprocess.Popen(
        [sys.executable, "-m", "gazelle", "view", source],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=tmp_path,
    ) as process:
        line = process.stdout.readline()
        assert re.fullmatch(r"view http://127\.0\.0\.1:\d+/[\w-]{20,}/\n", line)
        assert "paused" in process.stderr.readline()
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in out + err


def test_what_is_watched_is_in_this_process(cli):
    code, _, err = cli("train", "TurtleBot3Stage1", "--view", "--workers", 2)
    assert code == 2
    assert "--view cannot be used with --workers" in err
