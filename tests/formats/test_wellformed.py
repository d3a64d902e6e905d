"""Text that is not well-formed XML: what Gazebo's parsers take is read, and said."""

import warnings

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import FormatError, formats
from gazelle.errors import FormatWarning
from gazelle.formats import xml

HEAD = "<?xml version='1.0'?>\n<sdf version='1.6'>\n<model name='m'>"
TAIL = "</model>\n</sdf>\n"
LINK = "<link name='l'/>"

ODD = {
    "dashes in a comment": (HEAD + "<!-- a -- b\n --- c --->" + LINK + TAIL, 3),
    "a comment in a comment": (HEAD + "<!-- a\n<!-- b -->\n" + LINK + TAIL, 3),
    "a control character": (HEAD + "<!-- \x0c -->" + LINK + TAIL, 3),
    "a misspelt declaration": (HEAD.replace("version", "verison", 1) + LINK + TAIL, 1),
    "a declaration in the middle": (HEAD + "<?xml version='1.0'?>" + LINK + TAIL, 3),
    "an attribute without quotes": (HEAD + "<link name=l />" + TAIL, 3),
    "attributes without a blank": (HEAD + "<link name='l'x='1'/>" + TAIL, 3),
    "an attribute twice": (HEAD + "<link name='l' name='k'/>" + TAIL, 3),
    "an ampersand in an attribute": (HEAD + "<link name='l' x='a & b'/>" + TAIL, 3),
    "a less-than sign in an attribute": (HEAD + "<link name='l' x='a < b'/>" + TAIL, 3),
    "an ampersand in text": (
        HEAD + LINK + "<plugin name='p' filename='f'>a & b</plugin>" + TAIL,
        3,
    ),
    "an unknown entity": (HEAD + LINK + "<plugin name='p' filename='f'>&nbsp;</plugin>" + TAIL, 3),
    "a second root": (HEAD + LINK + TAIL + "<sdf version='1.6'/>", 5),
    "text behind the root": (HEAD + LINK + TAIL + "\nSuccess\n", 6),
}


@pytest.mark.parametrize("name", ODD)
def test_what_gazebo_reads_is_read_with_one_warning(name):
    text, line = ODD[name]
    with pytest.warns(FormatWarning) as caught:
        found = formats.load_model_string(text, name="test.sdf")
    assert [link.name for link in found.links] == ["l"]
    assert len(caught) == 1
    assert str(caught[0].message).startswith(f"test.sdf:{line}: this is not well-formed XML:")


@pytest.mark.parametrize("name", ODD)
def test_it_is_an_error_of_a_check_and_of_strict_parsing(name, tmp_path):
    text, line = ODD[name]
    file = tmp_path / "odd.sdf"
    file.write_text(text, encoding="utf-8")
    faults = [each for each in formats.check(file) if each.severity == "error"]
    assert [(each.rule, each.line) for each in faults] == [("tolerated", line)]
    with pytest.raises(FormatError):
        xml.parse(text.encode(), name="odd")


def test_bytes_that_are_not_utf_8_are_latin_1(tmp_path):
    file = tmp_path / "model.sdf"
    file.write_bytes((HEAD + "<link name='R\u00fcckwand'/>" + TAIL).encode("latin-1"))
    with pytest.warns(FormatWarning, match="Latin-1 was taken"):
        found = formats.load_model(file)
    assert found.links[0].name == "R\u00fcckwand"


@pytest.mark.parametrize(
    "text",
    [
        HEAD + "<link name='l'></model></link></sdf>",
        HEAD + LINK + "</model>",
        HEAD + "<link name='l></model></sdf>",
        HEAD + "<!-- open" + LINK + TAIL,
        HEAD + "<link 1='l'/>" + TAIL,
        "plain text",
        "",
    ],
)
def test_elements_that_do_not_close_are_an_error(text):
    with pytest.raises(FormatError):
        formats.load_model_string(text, name="test.sdf")


def test_curly_quotes_are_named():
    with pytest.raises(FormatError, match="is a curly quote: write a straight one") as caught:
        formats.load_model_string(HEAD + "<link name=\u201cl\u201d/>" + TAIL, name="test.sdf")
    assert caught.value.line == 3


@pytest.mark.parametrize("blank", ["\u00a0", "\u2009", "\u202f", "\u3000"])
def test_unusual_blanks_are_taken_as_spaces(blank, tmp_path):
    odd = HEAD + f"<link{blank}name='l'><pose>1{blank}2 3 0 0 0</pose></link>" + TAIL
    with pytest.warns(FormatWarning, match=r"test.sdf:3: there is a no-break space") as caught:
        found = formats.load_model_string(odd, name="test.sdf")
    assert len(caught) == 1
    assert found.links[0].pose.position == (1, 2, 3)
    file = tmp_path / "odd.world"
    file.write_text(f"resolution{blank}0.02\n# a{blank}comment\nmodel( pose [1{blank}2 0 0] )\n")
    with pytest.warns(FormatWarning, match=r"odd.world:1: there is a no-break space"):
        stage = formats.load(file).content
    assert stage.resolution == 0.02
    robot = (
        f"<robot name='r'><link{blank}name='l'><inertial><mass value='1'/>"
        "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>"
    )
    with pytest.warns(FormatWarning, match="there is a no-break space"):
        assert formats.load_model_string(robot).links[0].name == "l"
    srdf = f"<robot{blank}name='r'><group name='g'><link name='l'/></group></robot>"
    with pytest.warns(FormatWarning, match="there is a no-break space"):
        assert formats.load_srdf_string(srdf).groups[0].links == ("l",)


def test_unusual_blanks_in_comments_are_nobodys_business():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        formats.load_model_string(HEAD + "<!-- a\u00a0b -->" + LINK + TAIL)


def test_curly_quotes_in_other_files_are_named(tmp_path):
    file = tmp_path / "odd.world"
    file.write_text("define a model( color \u201cred\u201d )\n")
    with pytest.raises(FormatError, match="is a curly quote"):
        formats.load(file)
    file = tmp_path / "map.yaml"
    file.write_text(
        "image: \u201cmap.pgm\u201d\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.2\n"
    )
    with pytest.raises(FormatError, match="is a curly quote"):
        formats.load_map(file)
    with pytest.raises(FormatError, match="is a curly quote"):
        formats.load_model_string(
            HEAD + "<link name='l'><pose>\u201c1 0 0 0 0 0</pose></link>" + TAIL
        )


PARTS = st.sampled_from(
    [
        *ODD,
        "<link name='k'/>",
        "<!--",
        "-->",
        "<",
        ">",
        "&",
        "'",
        '"',
        "<a b=c>",
        "</a>",
        "]]>",
        "?>",
    ]
)


@given(st.lists(PARTS, max_size=8))
@settings(max_examples=150, deadline=None)
def test_any_text_is_read_or_refused_and_reads_the_same_twice(parts):
    body = "".join(part for part in parts if part not in ODD)
    text = HEAD + LINK + body + TAIL
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            root = xml.parse(text.encode(), name="x", report=lambda *_: None)
            mended = xml.parsed(text.encode(), name="x", report=lambda *_: None)[1]
    except FormatError:
        return
    assert xml.parse(mended, name="x") == root
