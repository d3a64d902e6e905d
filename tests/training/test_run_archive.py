"""Training runs as one file, from anybody."""

import zipfile

import pytest

from gazelle.cli.main import main
from gazelle.errors import FormatError, TaskError
from gazelle.training import Recipe, Run, RunConfig, pack_run, run_archive, unpack_run

CONFIG = "run/config.json"
LINK = 0o120777 << 16


@pytest.fixture
def run(tmp_path):
    """Return a run with two checkpoints, and something that is none of its files."""
    run = Run.create(RunConfig(task="x/Corridor-v0", recipe=Recipe(steps=300), seed=3), tmp_path)
    for steps in (100, 200):
        text = str(steps).encode()
        run.add_checkpoint(
            steps, lambda folder, text=text: (folder / "policy.npz").write_bytes(text)
        )
    (run.folder / "progress.csv").write_text("time/steps\n200\n")
    (run.folder / "tensorboard").mkdir()
    (run.folder / "tensorboard" / "events.out.tfevents.1.host.2.0").write_bytes(b"curve")
    (run.folder / "notes.py").write_text("print()")
    return run


def files_of(run):
    found = (path for path in run.folder.rglob("*") if path.is_file())
    return {path.relative_to(run.folder).as_posix(): path.read_bytes() for path in found}


def test_a_run_comes_back_with_its_newest_checkpoint_and_nothing_else(run, tmp_path):
    file = pack_run(run.folder, tmp_path / "a.zip")
    first, second = (unpack_run(file, tmp_path / "other") for _ in range(2))
    assert first.config == second.config == run.config
    assert first.folder == tmp_path / "other" / run.folder.name
    assert second.folder.name == f"{run.folder.name}-2"
    kept = files_of(run)
    del kept["notes.py"], kept["checkpoints/000000000100/policy.npz"]
    assert files_of(first) == files_of(second) == kept
    assert first.newest_checkpoint().name == "000000000200"


def test_a_run_without_a_checkpoint_comes_back(tmp_path):
    run = Run.create(RunConfig(task="x/Corridor-v0", recipe=Recipe(), seed=3), tmp_path)
    assert unpack_run(pack_run(run.folder, tmp_path / "a.zip"), tmp_path / "b").checkpoints() == []


def archive(tmp_path, members):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as made:
        for name, text, *attributes in members:
            info = zipfile.ZipInfo(name)
            info.external_attr = attributes[0] if attributes else 0
            made.writestr(info, text)
    return tmp_path / "a.zip"


@pytest.mark.filterwarnings("ignore:Duplicate name")
@pytest.mark.parametrize(
    ("members", "complaint"),
    [
        ([("../evil", ""), (CONFIG, "")], "'../evil', which is not a file of a run"),
        ([("/etc/passwd", "")], "not a file of a run"),
        ([("run/../../evil", "")], "not a file of a run"),
        ([("run/tensorboard/../../evil", "")], "not a file of a run"),
        ([("..\\evil/config.json", "")], "not a file of a run"),
        ([("../config.json", "")], "not a file of a run"),
        ([(CONFIG, "/etc/passwd", LINK)], "not a file of a run"),
        ([(CONFIG, ""), ("run/evil.py", "")], "not a file of a run"),
        ([(CONFIG, ""), ("run/checkpoints/1/evil.pkl", "")], "not a file of a run"),
        ([(CONFIG, ""), (CONFIG, "")], "twice"),
        ([(CONFIG, ""), ("other/config.json", "")], "twice"),
        ([(CONFIG, ""), ("other/progress.csv", "")], "not the archive of one run"),
        ([("run/progress.csv", "")], "not the archive of one run"),
        ([], "not the archive of one run"),
        ([(CONFIG, "{}")], "not a run's configuration"),
    ],
)
def test_what_is_no_run_is_refused_and_leaves_nothing(tmp_path, members, complaint):
    file = archive(tmp_path, members)
    with pytest.raises(FormatError, match=r"a\.zip") as raised:
        unpack_run(file, tmp_path / "runs" / "deep")
    assert complaint in str(raised.value)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == [file]


def test_what_is_too_large_is_refused(tmp_path, monkeypatch):
    file = archive(tmp_path, [(CONFIG, "{}"), ("run/progress.csv", "x" * 100)])
    monkeypatch.setattr(run_archive, "MAX_BYTES", 100)
    with pytest.raises(FormatError, match="unpacks to 102 bytes"):
        unpack_run(file, tmp_path / "runs")
    monkeypatch.setattr(run_archive, "MAX_FILES", 1)
    with pytest.raises(FormatError, match="at most 1 files, this 2"):
        unpack_run(file, tmp_path / "runs")


def test_a_size_that_lies_is_no_way_around_the_limit(tmp_path):
    """The header in front of a file and the list at the end say 2 bytes, the data has more."""
    text = b"x" * 5000
    file = archive(tmp_path, [(CONFIG, text)])
    raw = file.read_bytes()
    size = len(text).to_bytes(4, "little")
    file.write_bytes(raw.replace(size, (2).to_bytes(4, "little")))
    with pytest.raises(FormatError):
        unpack_run(file, tmp_path / "runs")


def test_every_cut_archive_is_refused(run, tmp_path):
    raw = pack_run(run.folder, tmp_path / "a.zip").read_bytes()
    for length in range(0, len(raw), 97):
        (tmp_path / "cut.zip").write_bytes(raw[:length])
        with pytest.raises(FormatError):
            unpack_run(tmp_path / "cut.zip", tmp_path / "cut")
    assert not list((tmp_path / "cut").glob("*"))


def test_files_that_cannot_be(run, tmp_path):
    with pytest.raises(FormatError, match="no such file"):
        unpack_run(tmp_path / "none.zip")
    with pytest.raises(TaskError, match=r"as \.zip"):
        pack_run(run.folder, tmp_path / "a.tar")
    with pytest.raises(TaskError, match="cannot write"):
        pack_run(run.folder, tmp_path / "none" / "a.zip")
    with pytest.raises(FormatError, match="no run here"):
        pack_run(tmp_path, tmp_path / "a.zip")
    (tmp_path / "taken").write_text("")
    file = pack_run(run.folder, tmp_path / "a.zip")
    with pytest.raises(TaskError, match="cannot unpack"):
        unpack_run(file, tmp_path / "taken")


def test_the_commands(run, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["export", str(run.folder), "--format", "run"]) == 0
    file = f"{run.folder}.zip"
    assert capsys.readouterr().out.splitlines()[0] == f"run:  {file}"
    assert main(["runs", "other", "--import", file]) == 0
    out = capsys.readouterr().out
    assert out.startswith(f"{file} is in other/{run.folder.name}\n")
    assert f"\n{run.folder.name} " in out
