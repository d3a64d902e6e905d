"""Modules are compiled once for all installations, and again when what they are made of changes."""

from __future__ import annotations

from pathlib import Path

import pytest
from extensions import BuildModules
from setuptools import Distribution, Extension

COMPILER = """#!/bin/sh
echo "$0 $@" >> "$(dirname "$0")/calls"
for word; do [ "$previous" = -o ] && echo "$0" > "$word"; previous=$word; done
echo "version $(cat "$(dirname "$0")/version")"
echo "InstalledDir: /tmp/pip-build-env-$$"
"""
"""A compiler that notes how it was called and writes its name where a file is wanted."""


@pytest.fixture
def place(tmp_path, monkeypatch):
    """Return a folder with a source, a header and a compiler."""
    monkeypatch.chdir(tmp_path)
    for name in ("cc-one", "cc-two"):
        Path(name).write_text(COMPILER)
        Path(name).chmod(0o755)
    Path("room").mkdir()
    Path("room/law.c").write_text("int one;\n")
    Path("room/law.h").write_text("int two;\n")
    Path("version").write_text("1")
    monkeypatch.setenv("CC", str(tmp_path / "cc-one"))
    return tmp_path


def build(folder, kind="baseline"):
    """Build into a folder; how many modules were compiled, and what the module holds."""
    Path("calls").write_text("")
    module = Extension("room.law", ["room/law.c"], include_dirs=["room"], extra_compile_args=[kind])
    command = BuildModules(Distribution({"name": "room", "ext_modules": [module]}))
    command.build_lib, command.build_temp = folder, f"{folder}-objects"
    command.ensure_finalized()
    command.run()
    compiled = [line for line in Path("calls").read_text().splitlines() if " -c " in line]
    (made,) = Path(folder).rglob("law*")
    return len(compiled), made.read_text()


@pytest.mark.usefixtures("place")
def test_another_installation_takes_what_was_compiled():
    first = build("one")
    assert first[0] == 1
    assert build("two") == (0, first[1])
    assert build("one") == (0, first[1])


def edited(name, text):
    return lambda place, _: (place / name).write_text(text)


CHANGES = {
    "source": edited("room/law.c", "int other;\n"),
    "header": edited("room/law.h", "int other;\n"),
    "version of the compiler": edited("version", "2"),
    "compiler": lambda place, patch: patch.setenv("CC", str(place / "cc-two")),
}


@pytest.mark.parametrize("change", CHANGES)
def test_what_is_made_of_something_else_is_compiled_again(place, monkeypatch, change):
    build("one")
    CHANGES[change](place, monkeypatch)
    compiled, made = build("one")
    assert compiled == 1
    assert ("cc-two" in made) == (change == "compiler")
    assert build("two")[0] == 0


@pytest.mark.usefixtures("place")
def test_flags_make_another_module():
    build("one")
    assert build("one", "avx2")[0] == 1


@pytest.mark.usefixtures("place")
def test_a_build_that_was_broken_off_is_made_again():
    build("one")
    (kept,) = Path("build/compiled").rglob("law*.sha256")
    kept.unlink()
    assert build("two")[0] == 1
