"""PyPI's ``xacro`` package as ROS 1 has it.

The package is the one for ROS 2: it looks for packages of ROS 2, and expands only tags with the prefix
``xacro:``. Up to ROS Melodic the prefix could be left out, and published robots do
(https://wiki.ros.org/xacro#Deprecated_Syntax). All that expands files here goes through `adapted`.
"""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from gazelle_ros.base.bundled_packages import published, published_hint

PREFIX = "xacro:"
NO_PREFIX = "lacks the prefix 'xacro:', and was expanded as up to ROS Melodic; ROS Noetic does not"

_KEYWORDS = {
    "arg": {"name", "default"},
    "if": {"value"},
    "include": {"filename"},
    "insert_block": {"name"},
    "macro": {"name"},
    "property": {"name"},
    "unless": {"value"},
}
"""Tags of xacro, and attributes that distinguish them from others, such as SDF's include."""

_NOT_CALLED = frozenset({
    "actuator", "axis", "bodyName", "box", "calibration", "camera", "capsule", "child", "collision",
    "color", "cylinder", "dynamics", "frame", "gazebo", "include", "inertia", "joint", "light", "limit",
    "link", "mass", "material", "mesh", "mimic", "model", "noise", "origin", "param", "parent", "pose",
    "plugin", "projector", "robot", "ros2_control", "safety_controller", "script", "sensor", "sphere",
    "texture", "transmission", "verbose", "visual", "world",
})  # fmt: skip
"""Elements of URDF and SDF with attributes of their own: they stay, even if a macro has their name."""

_MISSING = object()

Report = Callable[[str, Any], None]
"""Is given a tag without the prefix, and its DOM element."""


def engine() -> Any:
    """Return the package, imported now."""
    return importlib.import_module("xacro")


def lacks_prefix(tag: str, attributes: Mapping[str, str]) -> bool:
    """Return whether an element is one of xacro's without the prefix."""
    needed = _KEYWORDS.get(tag)
    return needed is not None and needed <= attributes.keys()


@contextlib.contextmanager
def adapted(find: Callable[[str], str], report: Report) -> Iterator[Any]:
    """Adapt the package to expand files as that of ROS 1 does; yields the package.

    Args:
        find: Returns the folder of a ROS package.
        report: Called for each tag without the prefix that is expanded.
    """
    package = engine()
    arguments = importlib.import_module("xacro.substitution_args")
    parse, expand_macro = package.parse, package.handle_macro_call

    def parse_old(document: Any, filename: str | None = None) -> Any:
        if document is not None or filename is None:
            return prefix(parse(document, filename), report)
        try:
            return prefix(parse(None, str(published(filename))), report)
        except package.XacroException as error:
            error.suffix = error.suffix or published_hint(filename)
            raise

    def expand_old_macro(node: Any, macros: Any, symbols: Any) -> Any:
        if ":" not in node.tagName and _calls(package, node, macros, symbols):
            report(node.tagName, node)
            _rename(node)
        return expand_macro(node, macros, symbols)

    with contextlib.ExitStack() as stack:
        for names, values in (
            (vars(package), {"parse": parse_old, "handle_macro_call": expand_old_macro}),
            (vars(arguments), {"_eval_find": find}),
            (arguments._eval_dict, {"find": find}),  # noqa: SLF001  # the package has no other way
        ):
            stack.enter_context(replaced(names, values))
        yield package


def prefix(document: Any, report: Report) -> Any:
    """Add the prefix to tags of xacro in a DOM that lack it; returns the document."""
    open_nodes = [document.documentElement]
    while open_nodes:
        node = open_nodes.pop()
        children = [child for child in node.childNodes if child.nodeType == child.ELEMENT_NODE]
        open_nodes += reversed(children)
        settings = getattr(node.parentNode, "tagName", "") == "plugin"
        if lacks_prefix(node.tagName, node.attributes) and not settings:
            report(node.tagName, node)
            _rename(node)
    return document


@contextlib.contextmanager
def replaced(names: dict[str, Any], values: Mapping[str, Any]) -> Iterator[None]:
    """Replace values of a namespace while it lasts."""
    before = {name: names.get(name, _MISSING) for name in values}
    names.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is _MISSING:
                del names[name]
            else:
                names[name] = value


def _rename(node: Any) -> None:
    node.tagName = node.nodeName = PREFIX + node.tagName


def _calls(package: Any, node: Any, macros: Any, symbols: Any) -> bool:
    """Return whether an element without the prefix has the name and the parameters of a macro."""
    if node.tagName in _NOT_CALLED:
        return False
    try:
        *_, macro = package.resolve_macro(node.tagName, macros, symbols)
    except (KeyError, TypeError):
        return False
    if not isinstance(macro, package.Macro) or macro in package.macrostack:
        return False
    blocks = [each for each in macro.params if each.startswith("*")]
    inner = [child for child in node.childNodes if child.nodeType == child.ELEMENT_NODE]
    values = set(macro.params) - set(blocks)
    given = set(node.attributes.keys())
    needed = values - set(macro.defaultmap)
    return needed <= given <= values and len(inner) == len(blocks)
