"""Options of ``gazelle film`` and ``picture`` that the source has no use for."""

from __future__ import annotations

import argparse

import pytest

from gazelle.cli import filming

WRITTEN = {
    "run.jsonl": [
        "--seed=1",
        "--no-ground",
        "--spawn=turtlebot3_burger",
        "--drive=0.1,0",
        "--task=A",
    ],
    "drive.bag": ["--eye=0,0,1", "--target=0,0,0", "--follow=a", "--engine=planar", "--trust"],
    "fleet": ["--topic=/image", "--import=mine", "--world=w", "--robot=r", "--goals=g"],
    "run": ["--size=64x48", "--top", "--topic=/image", "--spawn=turtlebot3_burger"],
}


@pytest.mark.parametrize(
    ("source", "option"), [(source, each) for source in WRITTEN for each in WRITTEN[source]]
)
def test_an_option_without_use_is_an_error(cli, tmp_path, monkeypatch, source, option):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "run").mkdir()
    (tmp_path / "run/config.json").write_text("{}")
    code, _, err = cli("picture", source, "out.png", option)
    assert code == 1
    name = option.partition("=")[0]
    assert f"error: {name} does not apply to" in err
    assert "it applies to" in err
    assert not (tmp_path / "out.png").exists()


def test_every_option_is_of_some_source():
    parser = argparse.ArgumentParser(add_help=False)
    filming.add_source(parser)
    written = {each for action in parser._actions for each in action.option_strings}
    assert written == set(filming._TAKERS)
