"""Formats of other packages, which ``formats.load`` finds by entry points."""

from importlib.metadata import EntryPoint

import pytest

from gazelle import formats
from gazelle.description import World
from gazelle.errors import FormatError
from gazelle.formats import world_formats
from gazelle.formats.world_formats import WorldFormat, find_world_format


@pytest.fixture
def installed(monkeypatch):
    """Install formats by entry points, beside Gazelle's own."""

    def install(**values):
        known = world_formats.entry_points_of("gazelle.formats")
        points = {name: EntryPoint(name, value, "g") for name, value in values.items()}
        monkeypatch.setattr(world_formats, "entry_points_of", lambda _: {**known, **points})
        world_formats._formats.cache_clear()

    yield install
    monkeypatch.undo()
    world_formats._formats.cache_clear()


def _read(data, name, reading):
    if b"bad" in data:
        raise FormatError(f"{name} is bad")
    return World(name=data.split()[1].decode())


PLAIN = WorldFormat(lambda data, suffix: data.startswith(b"plain") or suffix == ".plain", _read)


@pytest.mark.parametrize("suffix", [".txt", ".world", ""])
def test_a_format_is_known_by_its_content(installed, tmp_path, suffix):
    installed(plain=f"{__name__}:PLAIN")
    file = tmp_path / f"any{suffix}"
    file.write_text("plain room")
    assert formats.load(file).name == "room"
    assert formats.load_string("plain hall").name == "hall"


def test_a_format_is_known_by_the_suffix_of_a_name(installed, tmp_path):
    installed(plain=f"{__name__}:PLAIN")
    (tmp_path / "a.plain").write_text("! room")
    assert formats.load(tmp_path / "a.plain").name == "room"
    (tmp_path / "b.plain").write_text("bad room")
    with pytest.raises(FormatError, match=r"b\.plain is bad"):
        formats.load(tmp_path / "b.plain")


@pytest.mark.parametrize("value", ["no_such_module:X", f"{__name__}:NOTHING"])
def test_a_format_that_cannot_be_imported_is_named(installed, value):
    installed(odd=value)
    with pytest.raises(FormatError, match=r"the format 'odd' \(.*\) cannot be loaded"):
        formats.load_string("plain hall")


@pytest.mark.parametrize("text", [b"<sdf/>", b" \r\n<robot/>", b"\xef\xbb\xbf<?xml?>"])
def test_xml_needs_none_of_them(installed, text):
    installed(odd="no_such_module:X")
    assert find_world_format(text) is None


def test_stage_is_one(tmp_path):
    assert find_world_format(b'model ( name "a" )').read.__module__ == "gazelle.stage.format"
    assert find_world_format(b"anything", ".inc") is not None
    assert find_world_format(b"anything", ".txt") is None
