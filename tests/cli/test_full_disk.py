"""A file that finds no room is one error: nothing half-written is left, and what was there stays."""

from __future__ import annotations

import contextlib
import os
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from cli.ending_states import write_policy
from ros.graph import until

from gazelle_ros import Master, Node, load_message
from gazelle_ros.bags import Bag
from gazelle_ros.base.writing import replacing, write_bytes, write_text

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs limits of processes")


def gazelle(folder, *words, most=1000, background=False, **more):
    """Run a command that may write so many bytes into a file, as if the disk were full then."""
    command = [sys.executable, "-m", "gazelle", *map(str, words)]
    options = {
        "cwd": folder,
        "text": True,
        "stdout": subprocess.PIPE,
        "stderr": subprocess.PIPE,
        "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
    } | more
    if background:
        return subprocess.Popen(command, **options)
    return subprocess.run(command, check=False, timeout=300, **options)


def one_error(done, file):
    """Check that one line is printed that names the file."""
    (line,) = [each for each in done.stderr.splitlines() if "error" in each.lower()]
    assert line.startswith("gazelle: error: "), done.stderr
    assert "File too large" in line, done.stderr
    assert str(file) in line, done.stderr
    assert "Traceback" not in done.stderr
    assert "Exception" not in done.stderr
    assert done.returncode == 1


def names(folder):
    return sorted(str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file())


def test_a_file_is_whole_or_as_it_was(tmp_path):
    file = tmp_path / "a.txt"
    write_text(file, "old")
    file.chmod(0o640)
    link = tmp_path / "link.txt"
    link.symlink_to(file)
    with contextlib.suppress(ZeroDivisionError), replacing(link) as draft:
        draft.write_text("half")
        raise ZeroDivisionError
    assert (file.read_text(), names(tmp_path)) == ("old", ["a.txt", "link.txt"])
    write_bytes(link, b"new")
    assert (file.read_text(), link.is_symlink()) == ("new", True)
    assert file.stat().st_mode & 0o777 == 0o640


def test_what_is_no_file_is_written_directly():
    with pytest.raises(OSError, match=r"No space left.*/dev/full"):
        write_bytes("/dev/full", b"x" * 100_000)
    write_text("/dev/null", "nothing")


def test_an_error_names_the_file_and_not_its_draft(tmp_path):
    with pytest.raises(FileNotFoundError) as raised:
        write_text(tmp_path / "nowhere" / "a.txt", "")
    assert raised.value.filename == str(tmp_path / "nowhere" / "a.txt")


@pytest.mark.long
@pytest.mark.parametrize(
    ("words", "file"),
    [
        (["picture", "empty", "a.png"], "a.png"),
        (["film", "empty", "a.gif", "--for", "0.2"], "a.gif"),
        (["film", "empty", "a.mp4", "--for", "0.2", "--size", "64x64"], "a.mp4"),
        (["convert", "turtlebot3_burger", "a.sdf"], "a.sdf"),
        (["map", "turtlebot3_stage_1", "a"], "a"),
        (["plot", "table.csv", "a.png"], "a.png"),
    ],
)
def test_commands_leave_no_half_of_a_file(words, file, tmp_path):
    rows = "".join(f"{row},{row**2}\n" for row in range(50))
    (tmp_path / "table.csv").write_text(f"a,b\n{rows}")
    done = gazelle(tmp_path, *words)
    one_error(done, file)
    assert names(tmp_path) == ["table.csv"]


@pytest.mark.long
@pytest.mark.parametrize("file", ["a.csv", "a.json", "a.png"])
def test_an_evaluation_leaves_no_half_of_its_failures(file, tmp_path):
    policy = write_policy(tmp_path)
    before = names(tmp_path)
    words = ["eval", policy, "--task", "TurtleBot3Stage1", "--episodes", 8, "--failures", file]
    one_error(gazelle(tmp_path, *words, most=20), file)
    assert names(tmp_path) == before


@pytest.mark.long
def test_training_keeps_what_was_saved_before(tmp_path):
    """The limit leaves room for the tables, and none for a checkpoint."""
    done = gazelle(
        tmp_path, "train", "TurtleBot3Stage1", "--num-envs", 8, "--steps", 4096, most=20_000
    )
    one_error(done, "checkpoints")
    left = names(tmp_path)
    assert not [each for each in left if ".part" in each]
    assert [each for each in left if each.endswith("config.json")]


@pytest.mark.long
def test_a_study_ends_and_keeps_its_rows(tmp_path):
    (tmp_path / "study.py").write_text(
        "def run(*, seed, wide=0):\n    return {'text': str(seed) + 'x' * 300}\n"
    )
    words = ["study", "study.py:run", "--seeds", 20, "--workers", 1, "--out", "a.csv"]
    one_error(gazelle(tmp_path, *words, most=4000), "a.csv")
    assert names(tmp_path) == ["a.csv", "study.py"]
    assert 5 <= (tmp_path / "a.csv").read_text().count("\n") < 20
    done = gazelle(tmp_path, *words, most=1_000_000)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.csv").read_text().count("\n") == 21


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_study_that_ended_before_its_first_row_goes_on(number, tmp_path):
    (tmp_path / "study.py").write_text(
        "import pathlib, time\n"
        "def run(*, seed):\n"
        "    if not pathlib.Path('go').exists():\n"
        "        pathlib.Path('begun').touch()\n"
        "        time.sleep(100)\n"
        "    return {'x': seed}\n"
    )
    words = ["study", "study.py:run", "--workers", 1, "--out", "a.csv"]
    begun = gazelle(tmp_path, *words, most=-1, background=True)
    until((tmp_path / "begun").exists)
    begun.send_signal(number)
    begun.communicate(timeout=60)
    (tmp_path / "go").touch()
    done = gazelle(tmp_path, *words, most=-1)
    assert done.returncode == 0, done.stderr
    assert "1 of them new" in done.stdout


@pytest.mark.long
@pytest.mark.parametrize("most", [4000, 100_000, 300_000])
def test_a_bag_keeps_what_found_room(most, tmp_path):
    kind = load_message("std_msgs/String")
    with Master(port=0) as master, Node("talker", master_uri=master.uri) as node:
        words = node.advertise("words", kind, 100)
        process = gazelle(
            tmp_path, "bag", "record", "/words", "-O", "a", "--chunksize", 16,
            most=most, background=True, env=os.environ | {"ROS_MASTER_URI": master.uri},
        )  # fmt: skip
        end = time.monotonic() + 120
        while process.poll() is None and time.monotonic() < end:
            words.publish(kind(data="x" * 1000))
            time.sleep(0.002)
        out, err = process.communicate(timeout=60)
    assert process.returncode == 1, (out, err)
    assert len(err.splitlines()) <= 2, err
    assert "File too large" in err
    if most < 5000:  # not even a header
        assert names(tmp_path) == []
        return
    assert names(tmp_path) == ["a.bag"], err
    with Bag(str(tmp_path / "a.bag")) as bag:
        found = bag.get_message_count()
    assert 0.5 * most / 1000 < found <= most / 1000


@pytest.mark.long
@pytest.mark.parametrize(
    "words",
    [
        *(["tasks"], ["msg", "show", "nav_msgs/Odometry"], ["worlds"]),
        *(["--help"], ["--version"], ["train", "--help"]),
    ],
)
def test_a_full_standard_output_is_one_error(words, tmp_path):
    env = {name: text for name, text in os.environ.items() if name != "PYTHONUNBUFFERED"}
    with Path("/dev/full").open("w") as full:
        done = gazelle(tmp_path, *words, stdout=full, env=env)
    said = "gazelle: error: (the standard output: )?No space left on device\n  hint: .*\n"
    assert re.fullmatch(said, done.stderr)
    assert done.returncode == 1


@pytest.mark.long
def test_an_encoding_without_a_letter_shows_its_number(tmp_path):
    done = gazelle(tmp_path, "plugins", most=-1, env=os.environ | {"PYTHONIOENCODING": "ascii"})
    assert (done.returncode, done.stderr) == (0, "")
    assert r"compliance \xb7 radius" in done.stdout


@pytest.mark.long
@pytest.mark.parametrize("closed", ["1", "0", "2", "0 1 2"])
def test_closed_streams_are_no_fault_of_ours(closed, tmp_path):
    closing = " ".join(f"{number}>&-" for number in closed.split())
    shell = f'exec "$0" -m gazelle worlds {closing}'
    done = subprocess.run(
        ["/bin/sh", "-c", shell, sys.executable],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == (1 if "1" in closed else 0)
    if closed == "1":
        assert done.stderr.startswith("gazelle: error: the standard output is closed\n  hint:")


@pytest.mark.parametrize(
    "error",
    [
        MemoryError(),
        MemoryError("Unable to allocate 7.45 GiB for an array"),
        RuntimeError("can't start new thread"),
        ImportError("libx.so: failed to map segment from shared object"),
    ],
)
def test_too_little_memory_is_one_plain_error(error, cli, monkeypatch):
    def run(_args):
        raise error

    monkeypatch.setattr("gazelle.cli.worlds.run", run)
    code, _, err = cli("worlds")
    assert code == 1
    assert err.startswith("gazelle: error: there is not enough memory")
    assert "hint: " in err


def test_pictures_and_policies_are_written_whole(tmp_path, monkeypatch):
    from PIL import Image

    from gazelle.viewer.film_files import write_picture

    def half(_self, file, *_args, **_options):
        file.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", half)
    with pytest.raises(OSError, match=r"a\.png"):
        write_picture(tmp_path / "a.png", np.zeros((4, 4, 3), np.uint8))
    assert names(tmp_path) == []
