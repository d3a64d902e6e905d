"""XML is read with places, and nothing in it can do harm."""

import pytest

from gazelle import FormatError
from gazelle.formats import xml


def test_elements_know_file_line_and_path():
    root = xml.parse(
        "<sdf>\n <world name='w'>\n  <a/>\n  <a>\n   <b/></a></world></sdf>", name="f.sdf"
    )
    inner = root.find("world").children[1].find("b")
    assert inner.source.file == "f.sdf"
    assert inner.source.line == 5
    assert inner.source.element == "sdf/world[@name='w']/a[2]/b"


def test_text_is_read_around_comments():
    assert xml.parse("<a> x<!-- y -->z </a>", name="a").text == "xz"


def test_prefixes_need_no_declaration():
    root = xml.parse("<robot><xacro:if value='1'/></robot>", name="a")
    assert root.children[0].tag == "xacro:if"


@pytest.mark.parametrize("head", [" \n", "<!-- usage -->\n", "\ufeff"])
def test_a_declaration_may_follow_blanks_and_comments(head):
    root = xml.parse(f"{head}<?xml version='1.0'?>\n<a/>", name="a")
    assert root.source.line == 1 + head.count("\n") + 1


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("<a>\n<b>\n</a>", 3, "mismatched tag"),
        ("<a>\n<b", 2, "unclosed token"),
        ("<a x='1' x='2'/>", 1, "duplicate attribute"),
        ("<a/>\n<b/>", 2, "junk after document element"),
        ("<a>\n&nbsp;</a>", 2, "undefined entity"),
        ("not xml", 1, "not XML"),
    ],
)
def test_malformed_xml_names_the_line(text, line, reason):
    with pytest.raises(FormatError, match=reason) as caught:
        xml.parse(text, name="bad.sdf")
    assert caught.value.file == "bad.sdf"
    assert caught.value.line == line


@pytest.mark.parametrize(
    ("text", "line", "said", "advice"),
    [
        ("<a>\n<b>\n</a>", 3, "</a> stands where <b> of line 2 is still open", "</b> is missing"),
        ("<a>\n<b></c></b></a>", 2, "</c> closes nothing; open is <b> of line 2", "</b>, or take"),
        (
            "<a>\n<b>\n</b>\n",
            4,
            "the file ends, and <a> of line 1 is not closed",
            "</a> is missing",
        ),
        ('<a>\n<b n="x>\n<c d="1"/></b></a>', 3, "tag that begins in line 2", "close its quote"),
        ("<a>\n<b\n<c/></a>", 3, "tag that begins in line 2", "close its quote"),
    ],
)
def test_what_is_not_closed_is_named_with_its_line(text, line, said, advice):
    with pytest.raises(FormatError) as caught:
        xml.parse(text, name="bad.sdf")
    assert said in caught.value.message
    assert caught.value.line == line
    assert advice in caught.value.hint


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_what_is_not_closed_is_named_in_any_encoding(encoding):
    head = "<?xml version='1.0' encoding='latin-1'?>" if encoding == "latin-1" else ""
    text = f"{head}<a>\n<!-- größe --><b>\n</a>"
    with pytest.raises(FormatError, match="mismatched tag") as caught:
        xml.parse(text.encode(encoding), name="bad.sdf")
    assert caught.value.line == 3


@pytest.mark.parametrize("text", ["", " \n ", b"\x00\x01", "<a>\x00</a>"])
def test_rubbish_is_a_format_error(text):
    with pytest.raises(FormatError):
        xml.parse(text, name="a")


def test_a_billion_laughs_are_refused_at_once():
    levels = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 10))
    text = f'<!DOCTYPE a [<!ENTITY l0 "ha">{levels}]><a>&l9;</a>'
    with pytest.raises(FormatError, match="entity 'l0'"):
        xml.parse(text, name="a")


def test_files_are_not_drawn_in_by_entities(tmp_path):
    secret = tmp_path / "secret"
    secret.write_text("secret")
    text = f'<!DOCTYPE a [<!ENTITY s SYSTEM "{secret.as_uri()}">]><a>&s;</a>'
    with pytest.raises(FormatError, match="entity 's'"):
        xml.parse(text, name="a")


def test_depth_is_limited():
    with pytest.raises(FormatError, match="nested more than"):
        xml.parse("<a>" * 10_000 + "</a>" * 10_000, name="a")


def test_the_number_of_elements_is_limited(monkeypatch):
    monkeypatch.setattr(xml, "MAX_XML_ELEMENTS", 10)
    with pytest.raises(FormatError, match="limit of 10 elements"):
        xml.parse("<a>" + "<b/>" * 10 + "</a>", name="a")


def test_size_is_limited(monkeypatch, tmp_path):
    monkeypatch.setattr(xml, "MAX_XML_BYTES", 5)
    (tmp_path / "a.sdf").write_text("<aaaaaaaa/>")
    for read in (lambda: xml.read_file(tmp_path / "a.sdf"), lambda: xml.parse("<aaaa/>", name="a")):
        with pytest.raises(FormatError, match="larger than 5 bytes"):
            read()


def test_a_missing_file_is_a_format_error(tmp_path):
    with pytest.raises(FormatError, match="no such file"):
        xml.read_file(tmp_path / "none.sdf")
