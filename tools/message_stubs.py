"""Write the type stubs of the bundled ROS messages and services into packages/gazelle-ros/gazelle_ros/msgs.

python tools/message_stubs.py
python tools/message_stubs.py --check    # list those out of date
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "packages" / "gazelle-ros"))

from gazelle_ros.messages.library import PackageDefinitions, bundled, bundled_packages  # noqa: E402
from gazelle_ros.messages.modules import KINDS  # noqa: E402
from gazelle_ros.messages.parse import parse_message, parse_service  # noqa: E402
from gazelle_ros.messages.spec import (  # noqa: E402
    FLOATS,
    INTEGER_BITS,
    OCTETS,
    Field,
    MessageSpec,
    python_name,
)

FOLDER = ROOT / "packages" / "gazelle-ros" / "gazelle_ros" / "msgs"
HEAD = "# Written by tools/message_stubs.py from the bundled definitions; not to be edited.\n"


def type_of(base: str, local: str) -> str:
    """Return the Python type of one element of a field; messages of the package `local` are bare."""
    if base in INTEGER_BITS:
        return "int"
    if base in FLOATS:
        return "float"
    if base in {"time", "duration"}:
        return f"_{base.capitalize()}"
    if base in {"string", "bool"}:
        return {"string": "str", "bool": "bool"}[base]
    home, _, name = base.partition("/")
    return name if home == local else f"_{home}.{name}"


def annotation(field: Field, local: str) -> str:
    """Return the Python type of a field.

    Arrays of numbers are lists by default, tuples in messages that were received, and may be
    numpy arrays.
    """
    element = type_of(field.base, local)
    if not field.is_array:
        return element
    if field.base in OCTETS:
        return "bytes"
    if element in {"int", "float"}:
        return f"_Sequence[{element}] | _NDArray[_Any]"
    return f"list[{element}]"


def message_stub(spec: MessageSpec, local: str) -> list[str]:
    """Return the lines of a message class."""
    fields = [(field.attribute, annotation(field, local)) for field in spec.fields]
    constants = [
        f"    {python_name(each.name)}: _ClassVar[{type(each.value).__name__}]"
        for each in spec.constants
    ]
    arguments = "".join(f", {name}: {kind} | None = ..." for name, kind in fields)
    return [
        f"class {spec.short_name}(_Message):",
        *constants,
        *(f"    {name}: {kind}" for name, kind in fields),
        f"    def __init__(self{arguments}) -> None: ...",
    ]


def service_stub(package: str, name: str, text: str) -> list[str]:
    """Return the lines of a service class and of its request and response."""
    spec = parse_service(f"{package}/{name}", text)
    return [
        *message_stub(spec.request, ""),
        *message_stub(spec.response, ""),
        f"class {name}(_ServiceDefinition):",
        f"    _request_class: _ClassVar[type[{name}Request]]",
        f"    _response_class: _ClassVar[type[{name}Response]]",
    ]


IMPORTS = {
    "_Sequence": "from collections.abc import Sequence as _Sequence",
    "_Any": "from typing import Any as _Any",
    "_ClassVar": "from typing import ClassVar as _ClassVar",
    "_NDArray": "from numpy.typing import NDArray as _NDArray",
    "_Message": "from gazelle_ros.messages import Message as _Message",
    "_ServiceDefinition": "from gazelle_ros.messages import ServiceDefinition as _ServiceDefinition",
    "_Duration": "from gazelle_ros.time import Duration as _Duration",
    "_Time": "from gazelle_ros.time import Time as _Time",
}
"""Lines that import the names which a stub may use."""


def module_stub(package: str, kind: str) -> str:
    """Return the stub of a package's messages (``msg``) or services (``srv``); empty for none."""
    found = bundled(package) or PackageDefinitions()
    if kind == "msg":
        classes = [
            message_stub(parse_message(f"{package}/{name}", each.text), package)
            for name, each in sorted(found.messages.items())
        ]
    else:
        classes = [
            service_stub(package, name, each.text) for name, each in sorted(found.services.items())
        ]
    if not classes:
        return ""
    body = "\n".join(line for lines in classes for line in lines) + "\n"
    used = set(re.findall(r"\b_\w+", body))
    lines = [line for name, line in IMPORTS.items() if name in used]
    homes = sorted(name[1:] for name in used if name[1:] in bundled_packages())
    lines += [f"from gazelle_ros.msgs.{home} import msg as _{home}" for home in homes]
    return HEAD + "\n".join(lines) + "\n\n" + body


def stubs() -> dict[str, str]:
    """Return the text of every stub by its path below the folder."""
    found = {}
    for package in sorted(bundled_packages()):
        texts = {kind: module_stub(package, kind) for kind in KINDS}
        kinds = [kind for kind, text in texts.items() if text]
        lines = [f"from . import {kind} as {kind}" for kind in kinds]
        found[f"{package}/__init__.pyi"] = HEAD + "\n".join(lines) + "\n"
        found |= {f"{package}/{kind}.pyi": texts[kind] for kind in kinds}
    return found


def main() -> int:
    """Write the stubs, or compare them with the files."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="change nothing; fail if they differ")
    args = parser.parse_args()
    wanted = stubs()
    there = {
        path.relative_to(FOLDER).as_posix(): path.read_text(encoding="utf-8")
        for path in FOLDER.glob("*/*.pyi")
    }
    stale = sorted(name for name in wanted.keys() | there if wanted.get(name) != there.get(name))
    for name in stale:
        print(name)
        if not args.check:
            write(FOLDER / name, wanted.get(name))
    return 1 if args.check and stale else 0


def write(path: Path, text: str | None) -> None:
    """Write a stub; None removes it."""
    if text is None:
        path.unlink()
    else:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
