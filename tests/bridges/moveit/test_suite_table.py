"""The table of MoveIt's suites, and how their packages are found and hidden."""

from __future__ import annotations

import pytest
from rossuites.moveit import MOVEIT
from rossuites.sources import hiding, packages


@pytest.mark.parametrize("suite", MOVEIT, ids=lambda suite: suite.name)
def test_what_a_suite_hides_is_beside_it(suite):
    there = {suite.package, *suite.beside}
    assert {name.partition("/")[0] for name in suite.hidden} <= there
    assert suite.files


def test_packages_go_by_the_names_of_their_manifests(tmp_path):
    folder = tmp_path / "deep" / "arm_config"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name> long_arm_config </name></package>")
    assert packages(tmp_path) == {"long_arm_config": folder}


def test_what_is_hidden_comes_back(tmp_path):
    source = tmp_path / "packages" / "commander" / "src"
    source.mkdir(parents=True)
    (source / "code.py").write_text("")
    with hiding(tmp_path / "packages", ["commander/src"]):
        assert not source.exists()
    assert (source / "code.py").is_file()
