"""Xacro works without ROS, and errors point at the file that was written."""

import pytest
from xml_samples import INERTIAL

from gazelle import FormatError, formats
from gazelle.errors import FormatWarning
from gazelle_ros.base import bounded_yaml

NAMESPACE = "xmlns:xacro='http://www.ros.org/wiki/xacro'"


def package(folder, name):
    (folder / name / "urdf").mkdir(parents=True)
    (folder / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    return folder / name / "urdf"


@pytest.fixture
def robot(tmp_path):
    parts = package(tmp_path / "src", "parts")
    (parts / "wheel.xacro").write_text(
        f"<robot {NAMESPACE}>\n<xacro:macro name='wheel' params='name r:=0.1'>\n"
        f"<link name='${{name}}'>{INERTIAL}\n<collision><geometry>\n"
        "<cylinder radius='${r}' length='${r/2}'/></geometry></collision></link>\n"
        "</xacro:macro></robot>"
    )
    main = package(tmp_path / "src", "car") / "car.urdf.xacro"
    main.write_text(
        f"<robot name='car' {NAMESPACE}>\n<xacro:arg name='r' default='0.2'/>\n"
        "<xacro:include filename='$(find parts)/urdf/wheel.xacro'/>\n"
        "<xacro:wheel name='left' r='$(arg r)'/></robot>"
    )
    return main


def test_packages_are_found_around_the_file(robot):
    model = formats.load_model(robot)
    shape = model.links[0].collisions[0].geometry
    assert (model.name, model.links[0].name) == ("car", "left")
    assert (shape.radius, shape.length) == (0.2, 0.1)


def test_arguments_are_given(robot):
    model = formats.load_model(robot, xacro_args={"r": "0.5"})
    assert model.links[0].collisions[0].geometry.radius == 0.5


def test_elements_know_the_file_and_line_they_were_written_in(robot):
    collision = formats.load_model(robot).links[0].collisions[0]
    assert collision.source.file.endswith("parts/urdf/wheel.xacro")
    assert collision.source.line == 4


def test_errors_in_macros_name_the_macro_file_and_line(robot):
    with pytest.raises(FormatError, match="unsupported operand") as caught:
        formats.load_model(robot, xacro_args={"r": "'0.1 m'"})
    wheel = robot.parents[2] / "parts/urdf/wheel.xacro"
    assert caught.value.file.endswith("wheel.xacro")
    assert "cylinder" in wheel.read_text().splitlines()[caught.value.line - 1]


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("<link name='${nothing}'/>", "name 'nothing' is not defined"),
        ("<xacro:include filename='none.xacro'/>", "no file .*none.xacro"),
        ("<xacro:include filename='$(find nowhere)/a.xacro'/>", "no package 'nowhere'"),
        ("<xacro:nomacro/>", "unknown macro name: xacro:nomacro"),
        ("<link name='$(arg missing)'/>", "Undefined substitution argument"),
        ("<link name='${().__class__}'/>", "xacro"),
    ],
)
def test_errors_of_xacro_name_file_line_and_element(tmp_path, line, reason):
    file = tmp_path / "bad.xacro"
    file.write_text(f"<robot name='r' {NAMESPACE}>\n\n{line}</robot>")
    with pytest.raises(FormatError, match=reason) as caught:
        formats.load(file)
    assert caught.value.file == str(file)
    assert caught.value.line in {1, 3}
    assert caught.value.element is not None


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("<xacro:whel/>", "did you mean 'wheel'?"),
        ("<link name='${lenght}'/>", "did you mean 'length'?"),
        ("<xacro:wheel/>", "did you mean 'length'?"),
        ("<link name='$(arg missing)'/>", "xacro_args={'missing': ...}"),
        ("<xacro:include filename='$(find ur_description)/no.xacro'/>", "ROS_PACKAGE_PATH"),
        ("<xacro:zzzzz/>", None),
    ],
)
def test_common_mistakes_get_a_hint(tmp_path, monkeypatch, line, hint):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    file = tmp_path / "a.xacro"
    file.write_text(
        f"<robot name='r' {NAMESPACE}><xacro:property name='length' value='1'/>"
        "<xacro:macro name='wheel'><link name='${lengt}'/></xacro:macro>"
        f"{line}</robot>"
    )
    with pytest.raises(FormatError) as caught:
        formats.load(file)
    assert (caught.value.hint is None) if hint is None else (hint in caught.value.hint)


def test_files_outside_of_the_neighbourhood_are_not_read(tmp_path):
    file = tmp_path / "a" / "b.xacro"
    file.parent.mkdir()
    file.write_text(
        f"<robot name='r' {NAMESPACE}><xacro:property name='p' "
        "value='${xacro.load_yaml(\"/etc/hostname\")}'/><link name='${p}'/></robot>"
    )
    with pytest.raises(FormatError, match=r"may be read|no file"):
        formats.load(file)


def test_text_is_expanded_too():
    model = formats.load_model_string(
        f"<robot name='r' {NAMESPACE}><link name='${{1+1}}'>{INERTIAL}</link></robot>"
    )
    assert model.links[0].name == "2"


def test_loads_do_not_disturb_each_other(robot):
    first = formats.load_model(robot, xacro_args={"r": "0.7"})
    assert formats.load_model(robot).links[0].collisions[0].geometry.radius == 0.2
    assert first.links[0].collisions[0].geometry.radius == 0.7


@pytest.mark.parametrize("files", [1, 2, 5])
def test_files_that_include_each_other_are_one_error_with_the_ring(tmp_path, files):
    folder = tmp_path / "inner"
    folder.mkdir()
    for number in range(files):
        after = (number + 1) % files
        (folder / f"{number}.xacro").write_text(
            f"<robot {NAMESPACE}>\n\n<xacro:include filename='../inner/{after}.xacro'/></robot>"
        )
    main = tmp_path / "main.xacro"
    main.write_text(
        f"<robot name='r' {NAMESPACE}>\n<xacro:include filename='inner/0.xacro'/></robot>"
    )
    with pytest.raises(FormatError, match="include each other without end") as caught:
        formats.load_model(main)
    ring = [folder / f"{number}.xacro" for number in (*range(files), 0)]
    assert caught.value.message.endswith(": " + " -> ".join(map(str, ring)))
    assert (caught.value.file, caught.value.line) == (str(ring[-2]), 3)


def test_macros_that_call_each_other_are_an_error_with_a_line(tmp_path):
    main = tmp_path / "main.xacro"
    main.write_text(
        f"<robot name='r' {NAMESPACE}>\n<xacro:macro name='a'><xacro:b/></xacro:macro>\n"
        "<xacro:macro name='b'><xacro:a/></xacro:macro>\n<xacro:a/></robot>"
    )
    with pytest.raises(FormatError, match="call each other without end") as caught:
        formats.load_model(main)
    assert caught.value.file == str(main)
    assert caught.value.line in {2, 3}


OLD = [
    ("<property name='n' value='base'/><link name='${n}'/>", "property"),
    ("<macro name='m' params='n'><link name='${n}'/></macro><xacro:m n='base'/>", "macro"),
    ("<xacro:macro name='m' params='n'><link name='${n}'/></xacro:macro><m n='base'/>", "m"),
    ("<xacro:macro name='m'><link name='base'/></xacro:macro><m/>", "m"),
    ("<xacro:macro name='m' params='n:=base'><link name='${n}'/></xacro:macro><m/>", "m"),
    ("<if value='true'><link name='base'/></if>", "if"),
    ("<link name='base'/><unless value='true'><link name='other'/></unless>", "unless"),
    ("<arg name='n' default='base'/><link name='$(arg n)'/>", "arg"),
    (
        (
            "<xacro:macro name='m' params='n *block'><link name='${n}'><insert_block name='block'/>"
            "</link></xacro:macro><m n='base'><visual><geometry><sphere radius='1'/></geometry>"
            "</visual></m>"
        ),
        "insert_block",
    ),
    ("<include filename='part.xacro'/>", "include"),
]


@pytest.mark.filterwarnings("ignore:.*no link has a mass")
@pytest.mark.parametrize(("text", "tag"), OLD)
def test_tags_without_prefix_are_expanded_as_in_melodic(tmp_path, text, tag):
    (tmp_path / "part.xacro").write_text("<robot><link name='base'/></robot>")
    file = tmp_path / "old.urdf.xacro"
    namespace = NAMESPACE if "xacro:" in text else ""
    file.write_text(f"<robot name='r' {namespace}>\n{text}</robot>")
    with pytest.warns(FormatWarning, match=f"'{tag}' lacks the prefix") as caught:
        model = formats.load_model(file)
    assert [link.name for link in model.links] == ["base"]
    said = next(str(each.message) for each in caught if f"'{tag}' lacks" in str(each.message))
    assert f"{file}:2: " in said
    assert f"write <xacro:{tag}>" in said


@pytest.mark.filterwarnings("ignore:.*no link has a mass")
@pytest.mark.parametrize(
    "text",
    [
        # Noetic's files in which a macro has the name of an element
        (
            "<xacro:macro name='inertial' params='m'><inertial><mass value='${m}'/><inertia ixx='1' "
            "ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></xacro:macro>"
            "<link name='base'><xacro:inertial m='1'/></link>"
        ),
        (
            "<xacro:macro name='cylinder' params='radius length'><cylinder radius='${radius}' "
            "length='${length}'/></xacro:macro><link name='base'><visual><geometry>"
            "<cylinder radius='1' length='2'/></geometry></visual></link>"
        ),
        (
            "<xacro:macro name='link' params='name'><link name='base'/></xacro:macro>"
            "<xacro:link name='other'/>"
        ),
        (
            "<xacro:macro name='geometry' params='size'/><link name='base'><visual><geometry>"
            "<box size='1 1 1'/></geometry></visual></link>"
        ),
    ],
)
def test_elements_with_the_name_of_a_macro_stay_themselves(text):
    model = formats.load_model_string(f"<robot name='r' {NAMESPACE}>{text}</robot>")
    assert [link.name for link in model.links] == ["base"]


def test_macros_share_what_they_load(tmp_path, monkeypatch):
    (tmp_path / "sizes.yaml").write_text("small: {x: 0.5}\n")
    file = tmp_path / "many.xacro"
    file.write_text(
        f"<robot name='r' {NAMESPACE}><xacro:macro name='part' params='n'>"
        "<xacro:property name='all' value=\"${xacro.load_yaml('sizes.yaml')}\"/>"
        "<visual name='part_${n}'><geometry>"
        "<sphere radius=\"${n * all['small']['x']}\"/></geometry></visual></xacro:macro>"
        f"<link name='base'>{INERTIAL}"
        + "".join(f"<xacro:part n='{number}'/>" for number in range(1, 21))
        + "</link></robot>"
    )
    parsed = []
    compose = bounded_yaml.compose
    monkeypatch.setattr(bounded_yaml, "compose", lambda text: parsed.append(1) or compose(text))
    (link,) = formats.load(file).models[0].links
    assert [visual.geometry.radius for visual in link.visuals] == [n / 2 for n in range(1, 21)]
    assert len(parsed) == 1
