"""A pointer of Git LFS in place of any file is one error, which names the file and the cure."""

import pytest
from xml_samples import INERTIAL

from gazelle import FormatError, formats
from gazelle.engines import make_engine
from gazelle.formats.elevations import READERS

POINTER = "version https://git-lfs.github.com/spec/v1\noid sha256:" + "0" * 64 + "\nsize 9\n"
NAMESPACE = "xmlns:xacro='http://www.ros.org/wiki/xacro'"
MAP = "resolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.2\n"
SDF = "<sdf version='1.6'>\n<world name='w'>\n{}\n</world></sdf>"
MODEL = f"<model name='m'><link name='l'>{INERTIAL}\n{{}}\n</link></model>"
GEOMETRY = "<collision name='c'><geometry>{}</geometry></collision>"


def refused(path):
    """Return the error of reading and building a world."""
    with pytest.raises(FormatError) as caught:
        make_engine("mujoco", formats.load(path), 1)
    assert "is a pointer of Git LFS" in caught.value.message
    assert "git lfs pull" in caught.value.hint
    return caught.value


@pytest.mark.parametrize("name", ["a.urdf", "a.sdf", "a.world", "a.xacro", "a.yaml"])
def test_the_file_itself(tmp_path, name):
    (tmp_path / name).write_text(POINTER)
    error = refused(tmp_path / name)
    assert (error.file, error.line) == (str(tmp_path / name), 1)


@pytest.mark.parametrize(
    "inner",
    [
        "<xacro:include filename='part.xacro'/>",
        "<xacro:property name='v' value=\"${xacro.load_yaml('part.xacro')['x']}\"/><link name='${v}'/>",
    ],
)
def test_what_a_xacro_file_reads(tmp_path, inner):
    (tmp_path / "part.xacro").write_text(POINTER)
    (tmp_path / "robot.xacro").write_text(f"<robot name='r' {NAMESPACE}>\n{inner}\n</robot>")
    assert refused(tmp_path / "robot.xacro").file.endswith("part.xacro")


@pytest.mark.parametrize(
    ("inner", "line"),
    [
        (MODEL.format(GEOMETRY.format("<mesh><uri>part.stl</uri></mesh>")), 4),
        (MODEL.format(GEOMETRY.format("<mesh><uri>part.dae</uri></mesh>")), 4),
        (
            MODEL.format(
                GEOMETRY.format("<heightmap><uri>part.png</uri><size>9 9 1</size></heightmap>")
            ),
            4,
        ),
    ],
)
def test_what_an_sdf_world_names(tmp_path, inner, line):
    for suffix in ("stl", "dae", "png"):
        (tmp_path / f"part.{suffix}").write_text(POINTER)
    (tmp_path / "a.world").write_text(SDF.format(inner))
    error = refused(tmp_path / "a.world")
    assert (error.file, error.line) == (str(tmp_path / "a.world"), line)


def test_what_a_urdf_names(tmp_path):
    (tmp_path / "part.stl").write_text(POINTER)
    mesh = "<collision><geometry>\n<mesh filename='part.stl'/></geometry></collision>"
    link = f"<link name='l'>{INERTIAL}\n{mesh}</link>"
    (tmp_path / "a.urdf").write_text(f"<robot name='r'>\n{link}</robot>")
    assert refused(tmp_path / "a.urdf").line == 4


def test_the_picture_of_a_map(tmp_path):
    (tmp_path / "map.pgm").write_text(POINTER)
    (tmp_path / "map.yaml").write_text("image: map.pgm\n" + MAP)
    assert refused(tmp_path / "map.yaml").line == 1


def test_the_picture_and_an_include_of_a_stage_world(tmp_path):
    (tmp_path / "part.png").write_text(POINTER)
    (tmp_path / "part.inc").write_text(POINTER)
    for number, text in enumerate(
        ('window ( size [9 9] )\nmodel ( bitmap "part.png" )', 'model ( )\ninclude "part.inc"')
    ):
        path = tmp_path / f"{number}.world"
        path.write_text(text)
        refused(path)


def test_elevations(tmp_path):
    for suffix, read in READERS.items():
        path = tmp_path / f"part{suffix}"
        path.write_text(POINTER)
        with pytest.raises(FormatError, match="Git LFS"):
            read(path)


def test_an_included_model(tmp_path):
    folder = tmp_path / "part"
    folder.mkdir()
    config = "<model><name>part</name><sdf version='1.6'>model.sdf</sdf></model>"
    (folder / "model.config").write_text(config)
    (folder / "model.sdf").write_text(POINTER)
    world = tmp_path / "a.world"
    world.write_text(SDF.format("<include><uri>model://part</uri></include>"))
    assert refused(world).file == str(folder / "model.sdf")
