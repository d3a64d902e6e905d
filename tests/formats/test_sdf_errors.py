"""Errors of SDF files: one error or one warning each, with its place."""

import pytest
from xml_samples import model, sdf, world

from gazelle import FormatError, ResolveError, formats
from gazelle.errors import FormatWarning

LINK = "<link name='l'/>"


@pytest.mark.parametrize(
    ("body", "line", "element", "reason"),
    [
        (
            "<link name='l'><inertial>\n<mass>heavy</mass></inertial></link>",
            5,
            "link[@name='l']/inertial/mass",
            "expected a number in <mass>, found 'heavy'",
        ),
        (
            "<link name='l'><inertial><inertia>\n<ixx>nan</ixx></inertia></inertial></link>",
            5,
            "link[@name='l']/inertial/inertia/ixx",
            "expected a number",
        ),
        (
            "<link name='l'>\n<gravity>maybe</gravity></link>",
            5,
            "link[@name='l']/gravity",
            "expected true or false",
        ),
        ("<link/>", 4, "link", "attribute 'name' is required"),
        (
            f"{LINK}\n<frame name='a' attached_to='b'/><frame name='b' attached_to='a'/>",
            5,
            "frame[@name='a']",
            "cycle",
        ),
    ],
)
def test_errors_name_file_line_and_element(body, line, element, reason):
    with pytest.raises(FormatError, match=reason) as caught:
        model(body)
    assert caught.value.file == "test.sdf"
    assert caught.value.line == line
    assert caught.value.element == f"sdf/model[@name='m']/{element}"


def test_a_mass_does_not_matter_in_a_static_model():
    with pytest.warns(FormatWarning, match="the model is static, so it was ignored"):
        found = model(
            "<static>1</static><link name='l'><inertial><mass>nan</mass></inertial></link>"
        )
    assert found.links[0].inertial is None


def test_an_unknown_element_is_one_warning_with_a_suggestion():
    with pytest.warns(FormatWarning) as caught:
        model("<link name='l'>\n<inertail><mass>1</mass></inertail></link>")
    assert len(caught) == 1
    text = str(caught[0].message)
    assert text.startswith("test.sdf:5: <sdf/model[@name='m']/link[@name='l']/inertail>:")
    assert "did you mean 'inertial'?" in text


@pytest.mark.filterwarnings("error")
def test_hints_for_simbody_and_dart_are_kept():
    soft = "<surface><soft_contact><dart><damping>3</damping></dart></soft_contact></surface>"
    found = model(
        "<link name='a'><must_be_base_link>true</must_be_base_link><collision name='c'>"
        f"<geometry><sphere><radius>1</radius></sphere></geometry>{soft}</collision></link>"
        "<link name='b'/><joint name='j' type='ball'><parent>a</parent><child>b</child><physics>"
        "<simbody><must_be_loop_joint>true</must_be_loop_joint></simbody></physics></joint>"
    )
    assert found.links[0].extras[0].text == "true"
    assert found.links[0].collisions[0].surface.extras[0].get("dart/damping", 0.0) == 3.0
    assert found.joints[0].physics.must_be_loop_joint


def test_elements_of_other_tools_may_stand_anywhere():
    assert model("<link name='l'><tool:note>x</tool:note></link>").links[0].name == "l"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("<sdf><world name='w'/></sdf>", "'version' is required"),
        ("<sdf version='new'><world name='w'/></sdf>", "expected a version such as 1.6"),
        ("<html/>", "expected <sdf> or <robot>, found <html>"),
        ("<gazebo:world/>", "before 1.0"),
    ],
)
def test_the_root_is_judged(text, reason):
    with pytest.raises(FormatError, match=reason) as caught:
        formats.load_string(text, name="x.sdf")
    assert (caught.value.file, caught.value.line) == ("x.sdf", 1)


MESH = "<geometry><mesh><uri>{}</uri></mesh></geometry>"


def test_all_that_is_missing_is_one_warning():
    text = (
        f"<link name='l'><collision name='c'>{MESH.format('model://none/a.stl')}</collision>\n"
        f"<visual name='v'>{MESH.format('package://none/b.dae')}</visual></link>"
    )
    with pytest.warns(FormatWarning) as caught:
        found = model(text)
    assert len(caught) == 1
    message = str(caught[0].message)
    assert "'model://none/a.stl' (line 4), 'package://none/b.dae' (line 5)" in message
    assert "GAZEBO_MODEL_PATH is not set" in message or "looked in" in message
    assert found.links[0].collisions[0].geometry.path is None


def test_strict_makes_a_miss_an_error():
    text = sdf(
        "<model name='m'><link name='l'><visual name='v'>\n"
        f"{MESH.format('model://none/a.stl')}</visual></link></model>"
    )
    with pytest.raises(ResolveError, match=r"model://none/a\.stl") as caught:
        formats.load_string(text, name="test.sdf", strict=True)
    assert caught.value.line == 4
    assert caught.value.element.endswith("geometry/mesh/uri")


def test_nothing_is_fetched_from_a_network():
    with pytest.warns(FormatWarning, match="network addresses are never fetched"):
        found = world("<include><uri>https://fuel.example.org/u/models/Thing</uri></include>")
    assert found.models == ()


def test_a_missing_include_takes_its_joints_along():
    body = (
        "<model name='m'><link name='l'/><include><name>arm</name><uri>model://none</uri>"
        "</include><joint name='j' type='fixed'><parent>l</parent><child>arm::base</child>"
        "</joint></model>"
    )
    with pytest.warns(FormatWarning) as caught:
        found = world(body)
    assert found.models[0].joints == ()
    texts = [str(w.message) for w in caught]
    assert any("'arm::base' is of a model that was not found" in text for text in texts)
    assert any("not found: 'model://none'" in text for text in texts)


def test_check_lists_problems_and_raises_nothing(tmp_path):
    file = tmp_path / "bad.sdf"
    file.write_text(sdf("<model name='m'>\n<lnk/>\n<link name='l'><pose>x</pose></link></model>"))
    problems = formats.check(file)
    assert [(p.severity, p.line) for p in problems] == [("error", 5), ("warning", 4)]
    assert problems[0].file == str(file)
    assert problems[0].element == "sdf/model[@name='m']/link[@name='l']/pose"
    assert problems[1].hint == "did you mean 'link'?"
    assert formats.check(tmp_path / "none.sdf")[0].severity == "error"


def test_a_model_whose_inner_one_is_static_needs_no_link():
    inner = "<model name='n'><model name='o'><static>true</static></model></model>"
    found = model(inner, "1.8")
    assert found.models[0].models[0].static
    assert formats.load_model_string(formats.to_string(found, "sdf")) == found
    with pytest.warns(FormatWarning, match="has no link"):
        model("<model name='n'/>", "1.8")
