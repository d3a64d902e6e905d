"""Names for arrays are given once."""

from __future__ import annotations

import re
from pathlib import Path

import gazelle

PACKAGE = Path(gazelle.__file__).parent
HOME = PACKAGE / "array_types.py"
ALIAS = re.compile(r"^\w+ *(?:: *TypeAlias)? *= *(?:npt\.)?NDArray\[np\.(\w+)\]$", re.MULTILINE)

COMPILED = re.compile(r"^engines/mujoco/contact_laws/")
"""What is compiled reads the types of arguments from annotations of its own file."""


def test_no_module_names_arrays_for_itself():
    named = {
        str(path.relative_to(PACKAGE)): ALIAS.findall(path.read_text(encoding="utf-8"))
        for path in PACKAGE.rglob("*.py")
        if path != HOME and not COMPILED.match(str(path.relative_to(PACKAGE)))
    }
    assert {path: kinds for path, kinds in named.items() if kinds} == {}
