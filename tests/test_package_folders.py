"""Names of packages are the same by every lookup."""

import time

import pytest

from gazelle.formats.resolve import Resolver
from gazelle_ros.base.package_folders import package_name
from gazelle_ros.compat.rospkg.manifest import parse_manifest_file
from gazelle_ros.messages import search

BOMB = (
    '<!DOCTYPE p [<!ENTITY a "aaaaaaaaaa">'
    + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    )
    + "]><package><name>&i;</name></package>"
)
MANIFESTS = {
    "plain": ("<package><name>arm</name></package>", "arm"),
    "blanks": ("<package>\n  <name>\n    arm \n</name></package>", "arm"),
    "not the first": ("<package><version>1</version><name>arm</name></package>", "arm"),
    "attributes": ("<package format='3'><name xml:lang='en'>arm</name></package>", "arm"),
    "in a comment": ("<package><!-- <name>leg</name> --><name>arm</name></package>", "arm"),
    "of a person": (
        "<package><author><name>leg</name></author><name>arm</name></package>",
        "arm",
    ),
    "as text": ("<package><name><![CDATA[arm]]></name></package>", "arm"),
    "with entities": ("<package><name>a&#114;m</name></package>", "arm"),
    "twice": ("<package><name>arm</name><name>leg</name></package>", "arm"),
    "the first empty": ("<package><name/><name>arm</name></package>", "arm"),
    "damaged after it": ("<package><name>arm</name><descr", "arm"),
    "not well-formed after it": ("<package><name>arm</name><a></b></package>", "arm"),
    "declared": ("<?xml version='1.0'?>\n<package><name>arm</name></package>", "arm"),
    "with a mark of order": ("\ufeff<package><name>arm</name></package>", "arm"),
    "umlauts": ("<package><author>Jürgen</author><name>arm</name></package>", "arm"),
    "no name": ("<package><version>1</version></package>", "folder"),
    "empty": ("<package><name> </name></package>", "folder"),
    "no XML": ("arm", "folder"),
    "nothing": ("", "folder"),
    "damaged before it": ("<package><a></b><name>arm</name></package>", "folder"),
    "a bomb": (BOMB, "folder"),
}


@pytest.fixture
def folder(tmp_path):
    found = tmp_path / "src" / "folder"
    found.mkdir(parents=True)
    return found


@pytest.mark.parametrize(("text", "name"), MANIFESTS.values(), ids=MANIFESTS)
def test_a_package_has_one_name_for_robots_and_for_messages(folder, text, name):
    (folder / "package.xml").write_text(text, encoding="utf-8")
    (folder / "part.stl").touch()
    assert package_name(folder) == name
    assert search.find_packages(str(folder.parent)) == {name: folder}
    resolver = Resolver(paths=[folder.parent])
    assert resolver.find(f"package://{name}/part.stl") == folder / "part.stl"


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16"])
def test_a_manifest_may_be_in_another_encoding(folder, encoding):
    text = f"<?xml version='1.0' encoding='{encoding}'?><package><a>Jürgen</a><name>arm</name></package>"
    (folder / "package.xml").write_bytes(text.encode(encoding))
    assert package_name(folder) == "arm"


def test_a_folder_without_a_manifest_goes_by_its_name(folder):
    assert package_name(folder) == "folder"
    (folder / "package.xml").mkdir()
    assert package_name(folder) == "folder"


def test_a_thousand_manifests_are_read_in_a_moment(folder):
    long = "<description>" + "words " * 20_000 + "</description>"
    (folder / "package.xml").write_text(f"<package><name>arm</name>{long}</package>")
    start = time.process_time()
    for _ in range(1_000):
        package_name(folder)
    assert time.process_time() - start < 1.0


def test_blanks_that_nobody_types_do_no_harm(folder):
    text = "<package\u00a0format='2'>\u00a0<name>\u00a0arm\u2009</name></package>"
    (folder / "package.xml").write_text(text, encoding="utf-8")
    assert package_name(folder) == "arm"
    assert parse_manifest_file(str(folder)).name == "arm"
