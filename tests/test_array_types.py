"""Names for arrays are given once."""

from __future__ import annotations

import re
from pathlib import Path

import gazelle
import gazelle_ros

PACKAGE = Path(gazelle.__file__).parent
ROS = Path(gazelle_ros.__file__).parent
HOMES = {PACKAGE / "array_types.py", ROS / "base" / "array_types.py"}
ALIAS = re.compile(r"^\w+ *(?:: *TypeAlias)? *= *(?:npt\.)?NDArray\[np\.(\w+)\]$", re.MULTILINE)

COMPILED = re.compile(r"^engines/mujoco/contact_laws/")
"""What is compiled reads the types of arguments from annotations of its own file."""


def test_no_module_names_arrays_for_itself():
    named = {
        str(path.relative_to(folder)): ALIAS.findall(path.read_text(encoding="utf-8"))
        for folder in (PACKAGE, ROS)
        for path in folder.rglob("*.py")
        if path not in HOMES and not COMPILED.match(str(path.relative_to(folder)))
    }
    assert {path: kinds for path, kinds in named.items() if kinds} == {}
