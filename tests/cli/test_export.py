"""`gazelle export`."""

from __future__ import annotations

import json

import pytest


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return the folder of a short run."""
    from gazelle.training import PPOSettings, Recipe, train

    recipe = Recipe(steps=256, num_envs=4, settings=PPOSettings(n_steps=16, batch_size=32))
    return train("CartPole-v1", recipe=recipe, out=tmp_path_factory.mktemp("runs")).run.folder


@pytest.mark.parametrize(("form", "suffix"), [("onnx", ".onnx"), ("numpy", ".npz")])
def test_export_says_what_it_wrote_and_what_to_type_next(cli, run, tmp_path, form, suffix):
    pytest.importorskip("onnx")
    code, out, err = cli("export", run, "--format", form, "--out", tmp_path)
    assert (code, err) == (0, "")
    policy, contract = tmp_path / f"CartPole{suffix}", tmp_path / "CartPole.json"
    assert f"policy:   {policy}" in out
    assert f"deploy {policy}" in out
    assert policy.stat().st_size > 1000
    assert json.loads(contract.read_text())["task"] == "CartPole-v1"


def test_by_default_files_are_in_the_run(cli, run):
    assert cli("export", run, "--format", "numpy")[0] == 0
    assert (run / "export" / "CartPole.npz").is_file()


def test_an_unknown_format_is_a_wrong_command_line(cli, run):
    code, _, err = cli("export", run, "--format", "h5")
    assert code == 2
    assert "there is no format 'h5' for policies: there are: numpy, onnx" in err


def test_torchscript_is_refused_with_what_takes_its_place(cli, run):
    code, _, err = cli("export", run, "--format", "torchscript")
    assert code == 2
    assert "PyTorch has deprecated TorchScript; onnx runs in" in " ".join(err.split())


def test_nothing_to_export_is_one_line(cli, tmp_path):
    code, _, err = cli("export", tmp_path)
    assert code == 1
    assert "no run here" in err
