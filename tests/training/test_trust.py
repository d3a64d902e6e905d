"""Code that a run names is imported only for a user who trusts the run, or names the code."""

from __future__ import annotations

import dataclasses
import shutil
import sys

import pytest

from gazelle.errors import TaskError
from gazelle.training import OffPolicySettings, Recipe, Run, RunConfig, evaluate, resume, train
from gazelle.training.deploy import open_policy
from gazelle.training.importing import TaskModule
from gazelle.training.playback import Playback
from gazelle.training.policy_files import export_policy

DDPG = Recipe(algo="ddpg", settings=OffPolicySettings(demonstrator="evil_code:show"))
PLAIN = RunConfig(task="test/Corridor-v0", recipe=Recipe(), seed=0)


@pytest.fixture
def evil(tmp_path, monkeypatch):
    """Yield a folder with a module that leaves a mark when it is imported."""
    folder = tmp_path / "evil"
    folder.mkdir()
    mark = tmp_path / "executed"
    (folder / "evil_code.py").write_text(f"open({str(mark)!r}, 'w').close()\n")
    monkeypatch.syspath_prepend(str(folder))
    monkeypatch.chdir(folder)
    yield mark
    sys.modules.pop("evil_code", None)


def run_of(tmp_path, **values):
    run = Run.create(dataclasses.replace(PLAIN, **values), tmp_path / "runs")
    (run.folder / "checkpoints" / "000000000001").mkdir()
    (run.folder / "policy.npz").touch()
    return run.folder


NAMED = {
    "import": {"imports": (TaskModule("evil_code", "."),)},
    "installed": {"imports": (TaskModule("evil_code"),)},
    "task": {"task": "evil_code:test/Corridor-v0"},
    "file": {"task": "evil_code.py:test/Corridor-v0"},
    "callback": {"callbacks": ("evil_code:Callback",)},
    "demonstrator": {"recipe": DDPG},
    "beside": {"imports": (TaskModule("json", "."), TaskModule("evil_code", "."))},
}
COMMANDS = [evaluate, resume, export_policy, open_policy, Playback]


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("named", NAMED)
def test_nothing_of_a_run_is_executed_without_consent(tmp_path, evil, command, named):
    folder = run_of(tmp_path, **NAMED[named])
    with pytest.raises(TaskError, match=r"imports code: .*'evil_code") as caught:
        command(folder)
    assert "--trust" in caught.value.hint
    assert "--import" in caught.value.hint
    assert caught.value.file == str(folder / "config.json")
    assert not evil.exists()


@pytest.mark.parametrize("command", COMMANDS)
def test_a_user_who_trusts_the_run_lets_it_import(tmp_path, evil, command):
    folder = run_of(tmp_path, imports=(TaskModule("evil_code", str(tmp_path / "evil")),))
    with pytest.raises(Exception, match=r"."):  # there is no policy in it
        command(folder, trust=True)
    assert evil.exists()


@pytest.mark.parametrize("command", COMMANDS)
def test_a_user_who_names_another_module_has_that_imported_alone(tmp_path, evil, command):
    (tmp_path / "evil" / "mine.py").touch()
    folder = run_of(tmp_path, imports=(TaskModule("evil_code", "."),))
    with pytest.raises(Exception, match=r"."):  # there is no policy in it
        command(folder, imports=["mine"])
    assert not evil.exists()
    assert "mine" in sys.modules
    sys.modules.pop("mine")
    folder = run_of(tmp_path, task="evil_code:test/Corridor-v0")
    with pytest.raises(TaskError, match="imports code: 'evil_code'"):
        command(folder, imports=["mine"])
    assert not evil.exists()
    sys.modules.pop("mine", None)  # other tests have modules of that name


def test_a_module_of_a_name_that_is_imported_is_not_taken_for_that_from_elsewhere(tmp_path, evil):
    shutil.copy(tmp_path / "evil" / "evil_code.py", tmp_path / "evil" / "colorsys.py")
    import colorsys  # noqa: F401

    folder = run_of(tmp_path, imports=(TaskModule("colorsys", str(tmp_path / "evil")),))
    with pytest.raises(TaskError, match="imports code: 'colorsys' from the folder"):
        evaluate(folder)
    assert not evil.exists()


@pytest.mark.long
def test_who_trains_in_a_process_needs_no_consent_in_it(tmp_path, monkeypatch, tiny):
    (tmp_path / "my_corridors.py").write_text("import corridor\ncorridor.register()\n")
    monkeypatch.chdir(tmp_path)
    result = train("test/Corridor-v0", recipe=tiny, imports=["my_corridors"], out=tmp_path / "runs")
    assert evaluate(result.run.folder, episodes=2).episodes == 2
    resume(result.run.folder, steps=2048)


def test_the_command_line_says_what_to_type(cli, tmp_path, evil):
    folder = run_of(tmp_path, imports=(TaskModule("evil_code", "."),))
    for command in ("eval", "export", "deploy"):
        code, _, complaint = cli(command, folder)
        assert code == 1
        assert "this run imports code: 'evil_code' from the folder '.'" in complaint
        assert "--trust" in complaint
    code, _, complaint = cli("picture", folder, tmp_path / "picture.png")
    assert "--trust" in complaint
    assert not evil.exists()
