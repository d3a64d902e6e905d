"""Python code of catkin packages, as their ``setup.py`` names it.

The file is read and never run. What it computes is not known then, and the usual layout is taken
(http://docs.ros.org/en/noetic/api/catkin/html/user_guide/setup_dot_py.html).
"""

from __future__ import annotations

import ast
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

_MOST_BYTES = 1 << 20
_DEEPEST = 8
_LONGEST = 100_000
"""Characters of a text and items of a list that a file adds up."""
_CALLS = {"setup", "generate_distutils_setup"}
_COPIES = {"list", "sorted", "tuple", "set"}


@dataclass(frozen=True, slots=True)
class PythonCode:
    """The Python code of a package.

    Attributes:
        packages: Folders of Python packages by dotted name.
        modules: Files of top-level modules by name.
    """

    packages: Mapping[str, Path] = field(default_factory=dict)
    modules: Mapping[str, Path] = field(default_factory=dict)


def python_code(folder: Path) -> PythonCode:
    """Return what the ``setup.py`` in a folder names and is there; nothing if there is none."""
    file = folder / "setup.py"
    try:
        with file.open("rb") as opened:
            source = opened.read(_MOST_BYTES)
    except OSError:
        return PythonCode()
    try:
        reader = _SetupReader(folder)
        reader.execute(ast.parse(source).body)
        found = reader.found
    except (SyntaxError, ValueError, RecursionError, MemoryError):  # one for Python 2, say
        found = {"packages": _UNKNOWN, "package_dir": _UNKNOWN}
    folders = _folders(found.get("package_dir"), folder)
    names = found.get("packages", [])
    if names is _UNKNOWN:
        names = list(_packages_below(folder / folders.get("", "")))
    packages = {name: folder / _place(name, folders) for name in _texts(names)}
    modules = {
        name: folder / folders.get("", "") / f"{name.replace('.', '/')}.py"
        for name in _texts(found.get("py_modules", []))
    }
    return PythonCode(
        {name: at for name, at in packages.items() if at.is_dir()},
        {name: at for name, at in modules.items() if at.is_file()},
    )


class _Unknown:
    """A value that only running the file would reveal."""


_UNKNOWN = _Unknown()


class _SetupReader:
    """Follows the statements of a file as far as their values stand in it.

    Attributes:
        found: The keywords of the call of ``setup`` or ``generate_distutils_setup``.
    """

    def __init__(self, folder: Path) -> None:
        self.found: dict[str, Any] = {}
        self._folder = folder
        self._names: dict[str, Any] = {}

    def execute(self, statements: list[ast.stmt]) -> None:
        """Execute statements; the branches of ``if`` and ``try`` one after the other."""
        for statement in statements:
            match statement:
                case ast.Assign(targets=targets, value=value):
                    for target in targets:
                        self._assign(target, self.value(value))
                case ast.AnnAssign(target=target, value=ast.expr() as value):
                    self._assign(target, self.value(value))
                case ast.AugAssign(target=ast.Name(id=name), value=value):
                    self._names[name] = _sum(self._names.get(name), self.value(value))
                case ast.Expr(value=value):
                    self.value(value)
                case ast.If(body=body, orelse=other):
                    self.execute(body + other)
                case ast.Try(body=body, finalbody=last):
                    self.execute(body + last)
                case ast.With(body=body):
                    self.execute(body)

    def _assign(self, target: ast.expr, value: Any) -> None:
        match target:
            case ast.Name(id=name):
                self._names[name] = value
            case ast.Subscript(value=ast.Name(id=name), slice=key):
                known, place = self._names.get(name), self.value(key)
                if isinstance(known, dict) and isinstance(place, str):
                    known[place] = value

    def value(self, node: ast.expr) -> Any:
        """Return the value of an expression, or ``_UNKNOWN``."""
        match node:
            case ast.Constant(value=value):
                return value
            case ast.Name(id=name):
                return self._names.get(name, _UNKNOWN)
            case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items):
                return self._items(items)
            case ast.Dict(keys=keys, values=values):
                return self._pairs(keys, values)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return _sum(self.value(left), self.value(right))
            case ast.JoinedStr(values=parts):
                return self._text(parts)
            case ast.Subscript(value=inner, slice=key):
                known, place = self.value(inner), self.value(key)
                found = isinstance(known, dict) and isinstance(place, str)
                return known.get(place, _UNKNOWN) if found else _UNKNOWN
            case ast.Call():
                return self._call(node)
        return _UNKNOWN

    def _text(self, parts: list[ast.expr]) -> Any:
        """Return the text of an f-string that formats texts alone."""
        plain = [each.value if isinstance(each, ast.FormattedValue) else each for each in parts]
        texts = [self.value(each) for each in plain]
        known = all(isinstance(each, str) for each in texts)
        return "".join(texts) if known and sum(map(len, texts)) <= _LONGEST else _UNKNOWN

    def _items(self, items: list[ast.expr]) -> Any:
        found: list[Any] = []
        for item in items:
            value = self.value(item.value if isinstance(item, ast.Starred) else item)
            if value is _UNKNOWN:
                return _UNKNOWN
            found += value if isinstance(item, ast.Starred) and isinstance(value, list) else [value]
            if len(found) > _LONGEST:
                return _UNKNOWN
        return found

    def _pairs(self, keys: list[ast.expr | None], values: list[ast.expr]) -> dict[Any, Any]:
        found: dict[Any, Any] = {}
        for key, value in zip(keys, map(self.value, values), strict=True):
            if key is None:
                found |= value if isinstance(value, dict) else {}
                continue
            name = self.value(key)
            found[name if isinstance(name, str) else _UNKNOWN] = value
        return found

    def _call(self, node: ast.Call) -> Any:
        name = node.func.attr if isinstance(node.func, ast.Attribute) else ""
        name = node.func.id if isinstance(node.func, ast.Name) else name
        given = [self.value(argument) for argument in node.args]
        keywords: dict[str, Any] = {}
        for keyword in node.keywords:
            value = self.value(keyword.value)
            if keyword.arg is not None:
                keywords[keyword.arg] = value
            elif isinstance(value, dict):
                keywords |= value
        if name in _CALLS:
            self.found |= keywords
            return keywords
        if name == "dict":
            return keywords
        if name == "update" and isinstance(node.func, ast.Attribute):
            self._update(node.func.value, given, keywords)
        if name == "find_packages":
            return self._find_packages(given, keywords)
        if name == "join" and all(isinstance(each, str) for each in given):
            return os.path.join(*given) if given else _UNKNOWN  # noqa: PTH118  # text to text
        return given[0] if name in _COPIES and len(given) == 1 else _UNKNOWN

    def _update(self, target: ast.expr, values: list[Any], keywords: dict[str, Any]) -> None:
        known = self.value(target)
        if isinstance(known, dict):
            for each in (*values, keywords):
                known |= each if isinstance(each, dict) else {}

    def _find_packages(self, arguments: list[Any], keywords: dict[str, Any]) -> Any:
        """Return what setuptools finds: folders with an ``__init__.py``, and those in them."""
        where = arguments[0] if arguments else keywords.get("where", ".")
        without = arguments[1] if len(arguments) > 1 else keywords.get("exclude", [])
        only = arguments[2] if len(arguments) > 2 else keywords.get("include", ["*"])
        if not isinstance(where, str) or _UNKNOWN in (without, only):
            return _UNKNOWN
        return [
            name
            for name in _packages_below(self._folder / where)
            if any(fnmatch(name, pattern) for pattern in _texts(only))
            and not any(fnmatch(name, pattern) for pattern in _texts(without))
        ]


def _sum(left: Any, right: Any) -> Any:
    alike = isinstance(left, (str, list)) and type(left) is type(right)
    return left + right if alike and len(left) + len(right) <= _LONGEST else _UNKNOWN


def _texts(value: Any) -> list[str]:
    return [each for each in value if isinstance(each, str)] if isinstance(value, list) else []


def _folders(value: Any, package: Path) -> dict[str, str]:
    """Return ``package_dir``; the folder that catkin's packages have by custom if it is computed."""
    given = value if isinstance(value, dict) else {}
    known = {k: v for k, v in given.items() if isinstance(k, str) and isinstance(v, str)}
    computed = value is _UNKNOWN or len(known) < len(given)
    return {"": "src", **known} if computed and (package / "src").is_dir() else known


def _place(package: str, folders: Mapping[str, str]) -> str:
    """Return where distutils looks for a package: by the longest name that ``package_dir`` has."""
    parts, rest = package.split("."), list[str]()
    while parts:
        folder = folders.get(".".join(parts))
        if folder is not None:
            return "/".join([folder, *rest])
        rest.insert(0, parts.pop())
    return "/".join(filter(None, [folders.get("", ""), *rest]))


def _packages_below(root: Path, prefix: str = "", depth: int = _DEEPEST) -> Iterator[str]:
    try:
        folders = sorted(each for each in root.iterdir() if (each / "__init__.py").is_file())
    except OSError:
        return
    for each in folders:
        yield prefix + each.name
        if depth:
            yield from _packages_below(each, f"{prefix}{each.name}.", depth - 1)
