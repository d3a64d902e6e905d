"""Insertion of elements into the text of a URDF or xacro file; other text is kept."""

from __future__ import annotations

import re
from collections.abc import Iterable

from gazelle.builders.elements import element
from gazelle.builders.errors import BuildError
from gazelle.description import Parameters
from gazelle.errors import did_you_mean
from gazelle.formats import xml
from gazelle.formats.write.xml import fragment

_END = re.compile(r"</robot\s*>")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_XACRO = "http://www.ros.org/wiki/xacro"


def insert(text: str, nodes: Iterable[Parameters]) -> str:
    """Return the text with elements added at the end of its ``<robot>``.

    Raises:
        BuildError: There is no ``</robot>``.
    """
    blanked = _COMMENT.sub(lambda found: " " * len(found.group()), text)
    ends = list(_END.finditer(blanked))
    if not ends:
        raise BuildError(
            "this is not a URDF: there is no </robot>",
            hint="pass the text of the file, not its name" if "<" not in text else None,
        )
    start = ends[-1].start()
    line = text.rfind("\n", 0, start) + 1
    where = line if not text[line:start].strip() else start
    lead = "" if where == line else "\n"
    added = "".join(fragment(node, "  ") for node in nodes)
    return f"{text[:where]}{lead}{added}{text[where:]}"


def gazebo(reference: str, children: Iterable[Parameters]) -> Parameters:
    """Return a ``<gazebo>`` element; without a reference it is about the model."""
    attributes = {"reference": reference} if reference else {}
    return element("gazebo", None, *children, attributes=attributes)


def root_of(text: str) -> Parameters:
    """Return the ``<robot>`` of a text.

    Raises:
        FormatError: The text is not well-formed XML.
        BuildError: It is not a URDF.
    """
    if "<" not in text:
        raise BuildError("this is not a URDF", hint="pass the text of the file, not its name")
    root = xml.parse(text, name="urdf")
    if root.tag != "robot":
        raise BuildError(f"expected a <robot>, found <{root.tag}>")
    return root


def is_xacro(text: str) -> bool:
    """Return whether names may come from macros, so that they cannot be looked up."""
    return _XACRO in text or "<xacro:" in text


def check_name(text: str, tag: str, name: str) -> None:
    """Check that a link or joint is there; in xacro, where macros make some, anything may be.

    Raises:
        FormatError: The text is not well-formed XML.
        BuildError: There is no such element.
    """
    names = [node.attributes.get("name", "") for node in root_of(text).find_all(tag)]
    if name not in names and not is_xacro(text):
        raise BuildError(f"the robot has no {tag} '{name}'", hint=did_you_mean(name, names))
