from __future__ import annotations

import os
import resource
import subprocess
import sys
import types
import warnings
from pathlib import Path

import pytest

from gazelle import __version__
from gazelle.cli import commands
from gazelle.cli.commands import COMMANDS, Command
from gazelle.errors import EngineError, FormatError, GazelleWarning


@pytest.fixture
def fake(monkeypatch):
    """Return a sub-command that does what the test defines."""

    def make(action):
        module = types.SimpleNamespace(
            __doc__="Does what the test says.",
            configure=lambda parser: parser.add_argument("--count", type=int),
            run=action,
        )
        monkeypatch.setattr(Command, "load", lambda self: module)
        monkeypatch.setitem(COMMANDS, "fake", Command("fake", "-", "-", "fake"))

    return make


def raising(error):
    def action(args):
        raise error

    return action


@pytest.mark.parametrize("arguments", [[], ["--help"], ["-h"], ["help"]])
def test_help_lists_every_command(cli, arguments):
    code, out, err = cli(*arguments)
    assert code == 0
    assert not err
    for name in COMMANDS:
        assert f"\n  {name} " in out


@pytest.mark.parametrize("name", [None, *COMMANDS])
def test_help_fits_80_columns(cli, monkeypatch, name):
    monkeypatch.setenv("COLUMNS", "200")
    code, out, _ = cli(*([name] if name else []), "--help")
    assert code == 0
    assert out
    assert max(len(line) for line in out.splitlines()) <= 80


@pytest.mark.parametrize("name", COMMANDS)
def test_every_listed_command_has_a_module(name):
    module = COMMANDS[name].load()
    assert callable(module.configure)
    assert callable(module.run)


def test_version(cli):
    assert cli("--version") == (0, f"gazelle {__version__}\n", "")


def test_unknown_command_suggests_the_closest(cli):
    code, out, err = cli("evla")
    assert (code, out) == (2, "")
    assert err == "gazelle: error: there is no command 'evla'\n  hint: did you mean 'eval'?\n"


def test_unknown_option_suggests_the_closest(cli, fake):
    fake(lambda args: 0)
    code, _, err = cli("fake", "--cuont", "3")
    assert code == 2
    assert "did you mean '--count'" in err


def test_wrong_value_points_to_the_help(cli, fake):
    fake(lambda args: 0)
    code, _, err = cli("fake", "--count", "three")
    assert code == 2
    assert err.endswith("hint: see gazelle fake --help\n")


def test_error_is_one_line_and_a_hint(cli, fake):
    fake(raising(FormatError("bad mass", file="a.urdf", line=7, element="mass", hint="write 1.0")))
    code, out, err = cli("fake")
    assert (code, out) == (1, "")
    assert err == "gazelle: error: a.urdf:7: <mass>: bad mass\n  hint: write 1.0\n"


def test_missing_file_is_one_line(cli, fake):
    fake(lambda args: Path("/no/such/file").read_text())
    code, _, err = cli("fake")
    assert code == 1
    assert err == "gazelle: error: /no/such/file: No such file or directory\n"


def test_surprise_is_one_line_and_debug_shows_the_traceback(cli, fake):
    fake(raising(ZeroDivisionError("division by zero")))
    code, _, err = cli("fake")
    assert code == 1
    assert "Traceback" not in err
    assert "ZeroDivisionError: division by zero" in err
    assert "--debug" in err
    for arguments in (["fake", "--debug"], ["--debug", "fake"]):
        code, _, err = cli(*arguments)
        assert code == 1
        assert "Traceback" in err


def test_interrupt_ends_cleanly(cli, fake):
    fake(raising(KeyboardInterrupt()))
    code, _, err = cli("fake")
    assert code == 130
    assert err.strip() == "gazelle: interrupted"


def test_own_warnings_are_one_line_each_and_others_are_silent(cli, fake):
    def action(args):
        warnings.warn("the wheel is square", GazelleWarning, stacklevel=1)
        warnings.warn("numpy changed its mind", DeprecationWarning, stacklevel=1)
        return 0

    fake(action)
    assert cli("fake") == (0, "", "gazelle: warning: the wheel is square\n")
    assert "numpy changed its mind" in cli("fake", "--debug")[2]


def test_exit_code_of_a_command_is_passed_on(cli, fake):
    fake(lambda args: 7)
    assert cli("fake")[0] == 7


def test_error_without_hint_has_no_hint_line(cli, fake):
    fake(raising(EngineError("it fell apart")))
    assert cli("fake")[2] == "gazelle: error: it fell apart\n"


def gazelle(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "gazelle.cli.main", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


def test_help_starts_fast_and_imports_nothing_heavy():
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert gazelle("--help").returncode == 0
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime < 1.0
    code = (
        "import sys; from gazelle.cli.main import main; main(['--help']);"
        "print([name for name in ('numpy', 'torch', 'mujoco', 'gymnasium') if name in sys.modules])"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.endswith("[]\n")


@pytest.mark.long
def test_a_reader_that_goes_away_is_no_error():
    command = f"{sys.executable} -m gazelle.cli.main plugins | head -c 1"
    found = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {command}"], capture_output=True, text=True, check=False
    )
    assert not found.stderr
    assert found.returncode == 0


def test_commands_module_imports_no_command():
    assert commands.COMMANDS is COMMANDS
    code = (
        "import sys, gazelle.cli.main;"
        "print([name for name in sys.modules if name.startswith('gazelle.cli.')])"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "['gazelle.cli.commands', 'gazelle.cli.main']"


@pytest.mark.long
def test_names_of_any_bytes_are_shown_as_they_are():
    words = [sys.executable, "-m", "gazelle", "check", b"\xff"]
    strict = {**os.environ, "PYTHONIOENCODING": "utf-8:strict"}
    done = subprocess.run(words, capture_output=True, env=strict, check=False)
    assert done.returncode == 1
    assert done.stdout.startswith(b"error: \xff: there is no such file")
    assert not done.stderr
