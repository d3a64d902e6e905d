"""Content of ``package.xml``."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

from gazelle_ros.base import characters
from gazelle_ros.compat.rospkg.common import MANIFEST_FILE, PACKAGE_FILE, STACK_FILE

__all__ = [
    "MANIFEST_FILE",
    "PACKAGE_FILE",
    "STACK_FILE",
    "Depend",
    "InvalidManifest",
    "Manifest",
    "parse_manifest_file",
]

_DEPENDS = ("depend", "build_depend", "exec_depend", "run_depend", "build_export_depend")


class InvalidManifest(Exception):  # noqa: N818
    """A ``package.xml`` is malformed."""


@dataclass
class Depend:
    """A package another one needs."""

    name: str


@dataclass
class Manifest:
    """Content of a ``package.xml``."""

    name: str = ""
    version: str = ""
    description: str = ""
    license: str = ""
    author: str = ""
    depends: list[Depend] = field(default_factory=list)
    exports: list[Any] = field(default_factory=list)
    is_catkin: bool = True

    def get_export(self, tag: str, attr: str, convert: bool = True) -> list[str]:  # noqa: FBT001, FBT002  # rospkg's interface
        """Return values of an attribute in ``<export>``."""
        del convert
        return [each.get(attr) for each in self.exports if each.tag == tag and each.get(attr)]


def parse_manifest_file(dirpath: str, manifest_name: str = PACKAGE_FILE) -> Manifest:
    """Read a package's manifest.

    Raises:
        InvalidManifest: It cannot be read.
    """
    path = Path(dirpath) / manifest_name
    try:
        data, _ = characters.plain_bytes(path.read_bytes(), characters.XML_COMMENT)
        root = ET.fromstring(data)  # noqa: S314  # expat bounds how far entities may grow
    except (OSError, ET.ParseError, ValueError, LookupError) as error:
        raise InvalidManifest(f"[{path}] {error}") from None

    def text(tag: str) -> str:
        return (root.findtext(tag) or "").strip()

    needed = dict.fromkeys(
        (element.text or "").strip() for tag in _DEPENDS for element in root.findall(tag)
    )
    export = root.find("export")
    return Manifest(
        name=text("name"),
        version=text("version"),
        description=text("description"),
        license=text("license"),
        author=text("author"),
        depends=[Depend(name) for name in needed if name],
        exports=[] if export is None else list(export),
    )
