"""Packages of PyPI that are not those of ROS 1 Noetic behave as Noetic's while ROS 1's modules are there."""

import collections
import io
import subprocess
import sys

import numpy as np
import pytest
import yaml

import gazelle_ros as ros
from gazelle_ros.builtin import xacro as xacro_program
from gazelle_ros.builtin.registry import stand_in

ROBOT = (
    '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    '<xacro:include filename="$(find parts)/urdf/wheel.xacro"/>{}</robot>'
)
WHEEL = (
    '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
    '<xacro:macro name="wheel" params="name"><link name="${name}_wheel"/></xacro:macro></robot>'
)


@pytest.fixture
def robot(tmp_path, monkeypatch):
    """Return a robot whose file includes one of another package on ROS_PACKAGE_PATH."""
    folder = tmp_path / "src" / "parts"
    (folder / "urdf").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>parts</name></package>")
    (folder / "urdf" / "wheel.xacro").write_text(WHEEL)
    file = tmp_path / "robot.urdf.xacro"
    file.write_text(ROBOT.format('<xacro:wheel name="left"/>'))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    return file


def expanded_by_file(file):
    import xacro

    return xacro.process_file(str(file), in_order=True, mappings={}).toxml()


def expanded_by_document(file):
    import xacro

    with file.open() as text:
        document = xacro.parse(text)
    xacro.process_includes(document)
    xacro.process_doc(document, in_order=True)
    return document.toxml()


def expanded_by_text(file):
    import xacro

    xacro.set_substitution_args_context(xacro.load_mappings(["a:=b"]))
    document = xacro.parse(file.read_text())
    xacro.process_doc(document)
    return document.toprettyxml()


@pytest.mark.parametrize("way", [expanded_by_file, expanded_by_document, expanded_by_text])
def test_scripts_expand_xacro_with_the_packages_of_ros_1(robot, way):
    with ros.install():
        assert 'name="left_wheel"' in way(robot)


def test_afterwards_xacro_is_as_it_was():
    import xacro

    before = dict(vars(xacro))
    with ros.install():
        assert xacro.eval_extension is not before["eval_extension"]
    assert dict(vars(xacro)) == before


@pytest.mark.parametrize("options", [[], ["--inorder"], ["-i", "--xacro-ns", "__name:=x"]])
def test_the_program_expands_as_scripts_do(robot, capsys, options):
    assert xacro_program.main([*options, str(robot)]) == 0
    assert 'name="left_wheel"' in capsys.readouterr().out


def test_a_missing_package_is_told_with_what_to_do(robot, capsys):
    robot.write_text(ROBOT.format("").replace("parts", "no_parts"))
    assert xacro_program.main([str(robot)]) != 0
    said = capsys.readouterr().err
    assert "there is no package 'no_parts'" in said
    assert "<class" not in said


@pytest.mark.parametrize("line", ['<wheel name="left"/>', '<property name="a" value="1"/>'])
def test_the_program_expands_tags_without_prefix_and_says_so_once(robot, capsys, line):
    robot.write_text(ROBOT.format(line + '<wheel name="left"/>'))
    assert xacro_program.main([str(robot)]) == 0
    out, err = capsys.readouterr()
    assert "left_wheel" in out
    assert err.count("write <xacro:wheel>") == 1


@pytest.mark.long
@pytest.mark.parametrize(
    "words",
    [
        ["exec", "xacro", "xacro"],
        ["exec", "xacro", "xacro.py"],
        ["exec", str(stand_in("xacro") / "xacro.py")],
        ["xacro"],
    ],
)
def test_every_command_finds_the_package_and_not_its_own_folder(robot, words):
    done = subprocess.run(
        [sys.executable, "-m", "gazelle_ros", *words, str(robot)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, "left_wheel" in done.stdout) == (0, True), done.stderr


@pytest.mark.parametrize("text", ["{a: [1, 2]}", "a:\n- 1\n- 2"])
def test_yaml_loads_without_a_loader_as_in_noetic(text):
    with ros.install():
        assert yaml.load(text) == yaml.load(io.StringIO(text)) == {"a": [1, 2]}
        assert list(yaml.load_all(text)) == [{"a": [1, 2]}]
        assert yaml.load(text, Loader=yaml.SafeLoader) == {"a": [1, 2]}
    with pytest.raises(TypeError):
        yaml.load(text)


def test_yaml_makes_no_objects():
    with ros.install(), pytest.raises(yaml.YAMLError):
        yaml.load("!!python/object/apply:os.getcwd []")


@pytest.mark.parametrize("name", ["float", "int", "Inf", "NaN", "float_", "product"])
def test_names_that_numpy_took_out_are_there(name):
    assert not hasattr(np, name)
    with ros.install():
        assert hasattr(np, name)
    assert not hasattr(np, name)


def test_numpy_reads_images_as_noetic_does():
    with ros.install():
        picture = np.fromstring(b"\x01\x02", np.uint8)
        picture[0] = 7  # a copy, which may be written
        assert picture.tolist() == [7, 2]
        assert np.fromstring("1 2", sep=" ").tolist() == [1.0, 2.0]


@pytest.mark.parametrize("name", ["Callable", "Mapping", "Iterable", "MutableMapping"])
def test_collections_has_its_abstract_classes(name):
    with ros.install():
        assert hasattr(collections, name)
    assert not hasattr(collections, name)
