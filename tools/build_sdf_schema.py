"""Write ``gazelle/formats/sdf/schema.json`` from a folder of SDF's own schema files.

Usage: python tools/build_sdf_schema.py SCHEMA_FOLDER, which holds ``1.4/root.sdf`` and so
on. Names, types, defaults and versions are kept; descriptions are not.
"""

from __future__ import annotations

import argparse
import json
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

OUT = Path(__file__).parent.parent / "gazelle" / "formats" / "sdf" / "schema.json"


def version_key(folder: Path) -> tuple[int, ...]:
    """Return the numbers of a version folder, for sorting."""
    return tuple(int(part) for part in folder.name.split("."))


def read(file: Path) -> ET.Element:
    """Read the root element of a schema file."""
    return ET.parse(file).getroot()  # the schema comes from its own project


def merge(types: dict[str, Any], folder: Path, key: str, element: ET.Element, version: str) -> None:
    """Add one element description under its key; later versions win."""
    entry = types.setdefault(key, {"attributes": {}, "children": {}})
    entry["type"] = element.get("type", "")
    if element.get("default"):
        entry["default"] = element.get("default")
    for attribute in element.findall("attribute"):
        entry["attributes"][attribute.get("name")] = [
            attribute.get("type", "string"),
            attribute.get("required", "0") == "1",
        ]
    for child in element:
        add_child(types, folder, key, entry, child, version)


def add_child(
    types: dict[str, Any],
    folder: Path,
    key: str,
    entry: dict[str, Any],
    child: ET.Element,
    version: str,
) -> None:
    """Add one ``<element>`` or ``<include>`` of a description."""
    if child.tag == "element" and child.get("name"):
        name = child.get("name", "")
        inner = f"{key}/{name}"
        if child.get("ref"):
            inner = child.get("ref", "").removesuffix("_shape")
    elif child.tag == "include":
        inner = Path(child.get("filename", "")).stem
        name = read(folder / child.get("filename", "")).get("name")
    else:
        return
    known = entry["children"].setdefault(name, [inner, version, version])
    known[0], known[2] = inner, version
    if child.tag == "element" and not child.get("ref"):
        merge(types, folder, inner, child, version)


def main() -> None:
    """Read all versions and write the union."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("schema", type=Path)
    root = parser.parse_args().schema
    types: dict[str, Any] = {}
    for folder in sorted((f for f in root.iterdir() if f.is_dir()), key=version_key):
        for file in sorted(folder.glob("*.sdf")):
            merge(types, folder, file.stem, read(file), folder.name)
    OUT.write_text(json.dumps(types, indent=0, sort_keys=True) + "\n")


if __name__ == "__main__":
    main()
