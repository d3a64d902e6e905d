"""Descriptions of bundled robots and worlds."""

import pytest

from gazelle import assets
from gazelle.assets.descriptions import description
from gazelle.cli.main import main


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "<?xml version='1.0'?>\n<!-- A box of 0.5 kg.\n  Not this. -->\n<sdf/>",
            "A box of 0.5 kg.",
        ),
        ("<!-- A\n     box -->\n<robot/>", "A box"),
        ("# 72 robots. They\n#\n# wander.\nresolution 0.1\n# x", "72 robots."),
        ("<sdf/>\n<!-- inside -->", ""),
        ("", ""),
    ],
)
def test_the_first_sentence_at_the_head_is_the_description(tmp_path, text, expected):
    file = tmp_path / "some.world"
    file.write_text(text)
    assert description(file) == expected


@pytest.mark.parametrize("path", [*assets.robots().values(), *assets.worlds().values()], ids=str)
def test_every_bundled_file_has_a_short_one(path):
    assert 10 < len(description(path)) <= 130


@pytest.mark.parametrize(("command", "name"), [("robots", "kobuki"), ("worlds", "office")])
def test_lists_fit_a_terminal_and_show_paths_when_asked(command, name, capsys):
    assert main([command]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(len(line) <= 80 for line in lines)
    assert any(line.startswith(f"{name} ") for line in lines)
    assert main([command, "--long"]) == 0
    assert str(getattr(assets, command)()[name]) in capsys.readouterr().out
