"""Files of text and their names, whatever they hold, are one clear error."""

import contextlib
import os
import threading
from pathlib import Path

import pytest

import gazelle
from gazelle import Error, FormatError, ResolveError, RosError, formats
from gazelle.clients.descriptions import load_parameters
from gazelle.control.checking import check_controllers, is_controllers
from gazelle.formats import model_config
from gazelle.simulation import Replay
from gazelle.stage.format import load_stage
from gazelle.training.deploy import read_goals
from gazelle.training.run_archive import unpack_run
from gazelle.training.sweep_plan import SweepPlan
from gazelle.training.tables import rows_until
from gazelle.viewer.plots import read_table
from gazelle_ros.base.path_texts import MAX_NAME, MAX_PATH, can_be_path, existing_file, expanded
from gazelle_ros.base.text_files import read_rows, read_text
from gazelle_ros.compat.script import run_script
from gazelle_ros.launch import load_launch_text

NAMES = ["a" * (MAX_NAME + 1), "a/" * MAX_PATH, "a\x00b", "\ud800", "~nobody_is_called_this/a.sdf"]
LOADERS = {
    "load": formats.load,
    "load_map": formats.load_map,
    "load_model": formats.load_model,
    "load_srdf": formats.load_srdf,
    "load_stage": load_stage,
    "Simulation": gazelle.Simulation,
}


@pytest.mark.parametrize("data", [b"a: 1\nb: \xff\n", b"a: 1\nb: caf\xe9\n", b"\n\xed\xa0\x80"])
def test_what_is_no_text_is_an_error_with_its_line(tmp_path, data):
    file = tmp_path / "a.yaml"
    file.write_bytes(data)
    with pytest.raises(FormatError, match=r"a\.yaml:2: this is not UTF-8 text") as caught:
        read_text(file)
    assert caught.value.hint == "save it as UTF-8"
    assert not is_controllers(file)
    assert "UTF-8" in check_controllers(file, "fetch")[0].message
    with pytest.raises(FormatError, match="UTF-8"):
        load_parameters(None, file)


@pytest.mark.parametrize("name", NAMES, ids=range(len(NAMES)))
@pytest.mark.parametrize("loader", LOADERS)
def test_names_that_no_file_can_have(loader, name):
    with pytest.raises(ResolveError) as caught:
        LOADERS[loader](name)
    assert len(str(caught.value)) < 3 * MAX_NAME


@pytest.mark.parametrize("name", NAMES, ids=range(len(NAMES)))
@pytest.mark.parametrize("scheme", ["", "model://", "package://turtlebot3_gazebo/", "file://"])
def test_names_in_files_that_no_file_can_have(scheme, name):
    assert formats.Resolver().find(scheme + name) is None


def test_what_can_be_a_path():
    assert can_be_path("a" * MAX_NAME)
    assert can_be_path("é/b")
    assert not any(map(can_be_path, NAMES[:4]))
    assert str(expanded(NAMES[4])) == NAMES[4]
    with pytest.raises(ResolveError, match="there is no such file"):
        existing_file(NAMES[4])


@pytest.mark.parametrize("row", ["", "x,1", "1.5,1", ",1", "1,2,3,x\nnan,4"])
def test_tables_of_a_run_that_somebody_changed(tmp_path, row):
    file = tmp_path / "progress.csv"
    file.write_text(f"steps,loss\n64,0.5\n{row}\n128,0.25\n")
    if not row:
        assert rows_until(file, "steps", 100) == [{"steps": "64", "loss": "0.5"}]
        return
    with pytest.raises(FormatError, match=r"progress\.csv:\d: expected a whole number"):
        rows_until(file, "steps", 100)


def test_a_table_without_the_column_or_without_text(tmp_path):
    file = tmp_path / "progress.csv"
    assert rows_until(file, "steps", 1) == []
    for data in (b"loss\n1\n", b"steps\n\xff\n"):
        file.write_bytes(data)
        with pytest.raises(FormatError):
            rows_until(file, "steps", 1)


@pytest.mark.parametrize("text", ["a" * 300, "b/" * 3000, "model.sdf" * 40])
def test_a_manifest_that_names_what_can_be_no_file(tmp_path, text):
    (tmp_path / "model.config").write_text(f"<model><sdf version='1.6'>{text}</sdf></model>")
    with pytest.raises(FormatError, match="valid file name"):
        formats.load(tmp_path)


@pytest.mark.parametrize("version", ["9" * 5000, "\u00b2", "1." + "8" * 5000, "", "..", "a.b"])
def test_a_manifest_of_no_version(tmp_path, version):
    (tmp_path / "model.sdf").write_text("<sdf version='1.6'><model name='m'/></sdf>")
    text = f"<model><sdf version='{version}'>model.sdf</sdf></model>"
    (tmp_path / "model.config").write_text(text, encoding="utf-8")
    assert model_config.entry_file(tmp_path).name == "model.sdf"


@pytest.mark.parametrize("place", ["$(find NAME)/a.yaml", "$(find fetch_control)/NAME"])
@pytest.mark.parametrize("name", ["a" * 300, "a/" * 3000])
def test_names_in_launch_files_that_no_file_can_have(place, name):
    text = f'<launch><param name="a" value="{place.replace("NAME", name)}"/></launch>'
    plan = None
    with contextlib.suppress(RosError):
        plan = load_launch_text(text)
    assert plan is None or plan.parameters


@pytest.mark.parametrize("text", ['a,b\n1,"' + "2" * 140_000, '"' + "a,b\n" * 40_000])
@pytest.mark.parametrize("read", [read_rows, read_table, lambda file: rows_until(file, "a", 9)])
def test_tables_with_a_quote_that_is_never_closed(tmp_path, text, read):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(FormatError, match="this is not a table: field larger"):
        read(tmp_path / "a.csv")


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/full"])
@pytest.mark.parametrize(
    "read",
    [
        read_text,
        read_rows,
        read_goals,
        SweepPlan.read,
        lambda file: run_script(str(file), []),
        Replay,
        lambda file: unpack_run(file, "runs"),
    ],
)
def test_devices_that_never_end_are_one_error(read, device, monkeypatch):
    monkeypatch.setattr("gazelle_ros.base.text_files.MAX_BYTES", 1000)
    if not Path(device).is_char_device():
        pytest.skip(f"there is no {device}")
    with pytest.raises(Error, match=r"has more than the limit of 1,000 bytes|is a pipe"):
        read(Path(device))


def test_pipes_and_line_ends_are_read(tmp_path):
    os.mkfifo(tmp_path / "a.txt")
    writer = threading.Thread(target=(tmp_path / "a.txt").write_bytes, args=(b"a\r\nb\rc",))
    writer.start()
    assert read_text(tmp_path / "a.txt") == "a\nb\nc"
    writer.join()
