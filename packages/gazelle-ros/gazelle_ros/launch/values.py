"""Text of launch files as values: numbers, booleans, YAML."""

from __future__ import annotations

import math
import re
import warnings
from typing import Any

from gazelle_ros.base import characters
from gazelle_ros.base.bounded_yaml import bounded, refuse_deep
from gazelle_ros.base.errors import FormatWarning, describe
from gazelle_ros.launch.errors import LaunchError

_TRUE, _FALSE = {"true", "1"}, {"false", "0"}
KINDS = ("auto", "str", "string", "int", "double", "bool", "boolean", "yaml")
_ANGLE = re.compile(r"(deg|rad)\(([^()]*)\)")
_COMMENT = re.compile(r"(?m)(?:^|(?<=\s))#.*$")
_CURLY_QUOTED = re.compile("(?m)(?:^|[:,{\\[-])[ \\t]*([\u2018\u201c])[^\n]*[\u2019\u201d]")
_PLAIN_NUMBER = re.compile(r"[-+*/ .0-9eEpi]+")


def convert(text: str, kind: str) -> Any:
    """Convert text to a value of a kind (`KINDS`).

    Raises:
        LaunchError: The kind is unknown, or the text is no such value.
    """
    try:
        return _convert(text, kind)
    except ValueError:
        raise LaunchError(f"'{text}' is not of type {kind}") from None


def _convert(text: str, kind: str) -> Any:
    if kind == "auto":
        return automatic(text)
    if kind in {"str", "string"}:
        return text
    if kind == "int":
        return int(text)
    if kind == "double":
        return float(text)
    if kind in {"bool", "boolean"}:
        return truth(text)
    if kind == "yaml":
        return load_yaml(text)
    raise LaunchError(f"'{kind}' is not a type", hint="types are: " + ", ".join(KINDS))


def automatic(text: str) -> Any:
    """Return text as the number or boolean it looks like, else as it is."""
    try:
        if "." in text:
            return float(text)
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    lower = text.lower()
    return lower == "true" if lower in {"true", "false"} else text


def truth(text: str) -> bool:
    """Return ``true``, ``1``, ``false`` or ``0`` as a boolean.

    Raises:
        LaunchError: It is none of them.
    """
    lower = text.strip().lower()
    if lower in _TRUE:
        return True
    if lower in _FALSE:
        return False
    raise LaunchError(f"'{text}' is neither true (1) nor false (0)")


def parse_yaml(text: str) -> Any:
    """Parse like `load_yaml`, but raise PyYAML's errors; LaunchError for an invalid angle."""
    import yaml

    refuse_deep(text)
    return yaml.load(text, _loader())  # noqa: S506  # a safe loader, with angles


def parse_yaml_documents(text: str) -> list[Any]:
    """Parse like `load_yaml_documents`, but raise PyYAML's errors."""
    import yaml

    refuse_deep(text)
    return list(yaml.load_all(text, _loader()))  # a safe loader, with angles


def load_yaml(text: str, name: str = "", first: int = 1) -> Any:
    """Load YAML with rosparam's extras.

    They are ``!degrees 90``, ``!radians pi/2``, ``deg(90)`` and ``rad(pi/2)``.

    All angles come out in radians (http://wiki.ros.org/rosparam#YAML_Format). No-break spaces and
    the like are taken as spaces, with a warning.

    Args:
        text: The YAML.
        name: The file that it is from, for warnings.
        first: The line in that file that it begins in.

    Raises:
        LaunchError: It is not YAML.
    """
    import yaml

    text = _plain(text, name, first)
    try:
        return parse_yaml(text)
    except yaml.YAMLError as error:
        raise _no_yaml(text, error) from None
    except RecursionError:
        raise LaunchError("this YAML is nested too deep") from None


def load_yaml_documents(text: str, name: str = "") -> list[Any]:
    """Load all documents of YAML text, like `load_yaml`.

    Raises:
        LaunchError: It is not YAML.
    """
    import yaml

    text = _plain(text, name)
    try:
        return parse_yaml_documents(text)
    except yaml.YAMLError as error:
        raise _no_yaml(text, error) from None


def _plain(text: str, name: str, first: int = 1) -> str:
    """Return text with plain blanks; unusual ones and curly quotes give a warning."""
    clean, line = characters.plain(text, _COMMENT)
    if line is not None:
        _warn(characters.MESSAGE, name, line + first - 1)
    quoted = _CURLY_QUOTED.search(_COMMENT.sub("", clean))
    if quoted is not None:
        line = quoted.string.count("\n", 0, quoted.start(1)) + first
        said = f"{quoted[1]} is a curly quote, and so a part of the value: write a straight one"
        _warn(said, name, line)
    return clean


def _warn(message: str, name: str, line: int) -> None:
    said = message if name else f"line {line} of this YAML: {message}"
    text = describe(said, file=name or None, line=line)
    warnings.warn(text, FormatWarning, stacklevel=4)


def _no_yaml(text: str, error: Exception) -> LaunchError:
    mark = getattr(error, "problem_mark", None)
    lines = text.splitlines()
    here = lines[mark.line] if mark is not None and mark.line < len(lines) else ""
    line = f" in line {mark.line + 1}" if mark is not None else ""
    problem = getattr(error, "problem", None) or str(error)
    hint = characters.curly_hint(here)
    if here[: len(here) - len(here.lstrip())].count("\t"):
        hint = "indent by spaces: YAML takes no tabs"
    return LaunchError(f"this is not valid YAML{line}: {problem}", hint=hint)


_loaders: list[Any] = []


def _loader() -> Any:
    """Return the YAML loader, made once and when it is needed."""
    if _loaders:
        return _loaders[0]
    import yaml

    base: Any = bounded(getattr(yaml, "CSafeLoader", yaml.SafeLoader))

    class Loader(base):  # type: ignore[misc]  # the base is chosen above
        """Safe YAML with angles."""

    def degrees(loader: Any, node: Any) -> float:
        return math.radians(angle(loader.construct_scalar(node), "deg"))

    def radians(loader: Any, node: Any) -> float:
        return angle(loader.construct_scalar(node), "rad")

    def written(loader: Any, node: Any) -> float:
        text = loader.construct_scalar(node)
        value = angle(text, text[:3])
        return math.radians(value) if text.startswith("deg") else value

    Loader.add_constructor("!degrees", degrees)
    Loader.add_constructor("!radians", radians)
    Loader.add_constructor("!angle", written)
    Loader.add_implicit_resolver("!angle", re.compile(r"^(deg|rad)\([^()]*\)$"), list("dr"))
    _loaders.append(Loader)
    return Loader


def angle(text: str, unit: str) -> float:
    """Return a number, or a product of numbers and ``pi``, with or without ``deg(...)`` around it.

    Raises:
        LaunchError: It is something else.
    """
    match = _ANGLE.fullmatch(text.strip())
    inner = match.group(2) if match else text
    try:
        return float(inner)
    except ValueError:
        pass
    if not _PLAIN_NUMBER.fullmatch(inner) or "**" in inner:
        raise LaunchError(f"'{text}' is not a number ({unit})")
    try:
        return float(eval(inner, {"__builtins__": {}}, {"pi": math.pi}))  # noqa: S307  # digits and pi only
    except Exception:  # noqa: BLE001  # whatever an expression may raise
        raise LaunchError(f"'{text}' is not a number ({unit})") from None
