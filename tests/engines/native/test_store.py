"""Machine code is kept where only its user can write, and used only if it is what was kept."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

from gazelle.engines.native import Native, store
from gazelle.errors import EngineWarning

USE = (
    "from gazelle.engines.planar.kernels_motion import turned\n"
    "from gazelle.engines.native.machine import Machine\n"
    "print(turned(0.25))\n"
)
FORBID = USE.replace("print", "Machine.compile = None\nprint")

posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="there are no modes of files")


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """An empty folder to keep machine code in."""
    folder = tmp_path / "kept"
    monkeypatch.setenv("GAZELLE_CACHE_DIR", str(folder))
    return folder


def tripled(a):
    return 3 * a


def started(code, folder, **environment):
    """A process that runs some lines and keeps what it compiles in a folder."""
    environment = {**os.environ, "GAZELLE_CACHE_DIR": str(folder), **environment}
    return subprocess.Popen(
        [sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def test_machine_code_is_kept_and_damaged_files_are_not_used(kept):
    assert Native(tripled)(2) == 6
    (file,) = kept.glob("*.o")
    assert store.read(file.stem) is not None
    file.write_bytes(file.read_bytes()[:-1])
    assert store.read(file.stem) is None


def test_what_was_kept_longest_ago_is_dropped_and_what_was_never_finished(kept):
    store.write("first", b"code")
    lost, busy = kept / "lost.part", kept / "busy.part"
    lost.touch()
    busy.touch()
    os.utime(lost, (0, 0))
    for number in range(401):
        (kept / f"{number}.o").touch()
        os.utime(kept / f"{number}.o", (number, number))
    store.write("last", b"code")
    assert sorted(file.name for file in kept.glob("*") if file.stem in ("0", "1", "2", "3")) == [
        "3.o"
    ]
    assert not lost.exists()
    assert busy.exists()
    assert store.read("last") == store.read("first") == b"code"


@posix
def test_the_folder_and_its_files_are_its_users_own(kept):
    store.write("key", b"code")
    modes = [stat.S_IMODE(path.stat().st_mode) for path in (kept, kept / "key.o")]
    assert modes == [0o700, 0o600]


@posix
@pytest.mark.parametrize("mode", [0o770, 0o707])
def test_a_folder_that_others_can_write_is_not_trusted(kept, tmp_path, monkeypatch, mode):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    store.write("key", b"code")
    kept.chmod(mode)
    store._chosen.cache_clear()
    with pytest.warns(EngineWarning, match="others can write to .*kept; GAZELLE_CACHE_DIR may"):
        assert store.read("key") is None
    assert store.folder() == tmp_path / f"gazelle-kernels-{os.getuid()}"


@posix
def test_a_folder_of_another_user_is_not_trusted(kept, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    store.write("key", b"code")
    store._chosen.cache_clear()
    monkeypatch.setattr("os.getuid", lambda: kept.stat().st_uid + 1)
    monkeypatch.setattr(store, "_is_safe", owned_by(kept.stat().st_uid + 1))
    with pytest.warns(EngineWarning, match="memory only"):
        assert store.folder() is None
    assert store.read("key") is None
    store.write("key", b"code")  # which does nothing
    assert Native(tripled)(2) == 6


def owned_by(user):
    """What tells safe files of a user, who is not the administrator, from others."""
    return lambda state: state.st_uid == user


@posix
def test_owners_and_modes_decide_what_is_safe(tmp_path):
    state = list(tmp_path.stat())
    for owner, mode, safe in (
        (os.getuid(), 0o40755, True), (0, 0o40755, True), (os.getuid() + 1, 0o40700, False),
        (os.getuid(), 0o40775, False), (os.getuid(), 0o40702, False),
    ):  # fmt: skip
        state[stat.ST_UID], state[stat.ST_MODE] = owner, mode
        assert store._is_safe(os.stat_result(state)) is safe


@posix
def test_a_file_that_others_can_write_is_not_used(kept):
    store.write("key", b"code")
    (kept / "key.o").chmod(0o622)
    assert store.read("key") is None


def test_without_a_home_a_folder_among_temporary_files_is_used(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    monkeypatch.delenv("GAZELLE_CACHE_DIR", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file" / "cache"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        place = store.folder()
    assert place is not None
    assert place.parent == tmp_path / "temporary"
    store.write("key", b"code")
    assert store.read("key") == b"code"


def test_without_any_folder_one_warning_says_so(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "file"))
    monkeypatch.setenv("GAZELLE_CACHE_DIR", str(tmp_path / "file" / "cache"))
    with pytest.warns(EngineWarning, match="kept in memory only") as caught:
        assert [Native(tripled)(k) for k in (1, 2, 0.5)] == [3, 6, 1.5]
    assert len(caught) == 1


@posix
def test_a_link_among_temporary_files_is_not_followed(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    (tmp_path / f"gazelle-kernels-{os.getuid()}").symlink_to(tmp_path / "elsewhere")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setenv("GAZELLE_CACHE_DIR", str(tmp_path / "file" / "cache"))
    with pytest.warns(EngineWarning, match="it is a link"):
        assert store.folder() is None


def test_a_later_process_loads_what_was_kept(tmp_path):
    printed = [started(code, tmp_path).communicate()[0] for code in (USE, FORBID)]
    assert printed[0] == printed[1] != ""


def test_processes_that_compile_at_once_leave_whole_files(tmp_path):
    processes = [started(USE, tmp_path) for _ in range(2)]
    printed = [process.communicate() for process in processes]
    assert [process.returncode for process in processes] == [0, 0]
    assert printed[0] == printed[1]
    assert {file.suffix for file in tmp_path.iterdir()} == {".o"}
    assert started(FORBID, tmp_path).communicate()[0] == printed[0][0]


def test_what_is_half_written_has_no_name_yet(kept, monkeypatch):
    def broken(source: Path, target: Path) -> None:
        assert source.read_bytes().endswith(b"code")
        assert not target.exists()
        raise OSError

    monkeypatch.setattr(Path, "replace", broken)
    store.write("key", b"code")
    assert list(kept.iterdir()) == []
