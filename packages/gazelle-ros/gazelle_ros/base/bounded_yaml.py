"""Untrusted YAML: safe values, with a limit on those that aliases make.

``[*a, *a]`` shares a list that a traversal meets twice, so a file of a kilobyte can hold
more values than any memory. What contains itself holds values without end.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.characters import can_be_written

if TYPE_CHECKING:
    import yaml

MAX_VALUES = 1_000_000
"""Values in a document, each counted as often as aliases repeat it."""


MAX_DEPTH = 100
"""Levels of lists and mappings; loaders call themselves for each, and some crash."""


def safe_load(text: str) -> Any:
    """Return the value of a YAML document.

    Raises:
        yaml.YAMLError: It is not valid YAML, holds more than ``MAX_VALUES`` values on more than
            ``MAX_DEPTH`` levels, or contains itself.
    """
    import yaml

    refuse_deep(text)
    return yaml.load(text, bounded(yaml.SafeLoader))  # noqa: S506  # a safe loader


def safe_load_all(text: str) -> Iterator[Any]:
    """Yield the values of all documents; see ``safe_load``."""
    import yaml

    refuse_deep(text)
    yield from yaml.load_all(text, bounded(yaml.SafeLoader))  # a safe loader


def refuse_deep(text: str | bytes) -> None:
    """Raise an error for text of more than ``MAX_DEPTH`` levels, without any recursion.

    Raises:
        yaml.YAMLError: It has more, or is not valid YAML.
    """
    import yaml

    if isinstance(text, str) and not can_be_written(text):
        raise yaml.YAMLError("it holds bytes that are not UTF-8, or a null")
    depth = 0
    for event in yaml.parse(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > MAX_DEPTH:
                problem = f"this is nested more than {MAX_DEPTH} levels deep"
                raise yaml.MarkedYAMLError(problem=problem, problem_mark=event.start_mark)
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


def compose(text: str | bytes) -> yaml.Node | None:
    """Return the root node of a document; see ``safe_load``."""
    import yaml

    refuse_deep(text)
    root: yaml.Node | None = yaml.compose(
        text, bounded(getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    )
    return root


@functools.cache
def bounded(loader: type[Any]) -> type[Any]:
    """Return a loader like another that counts values before it makes them.

    Text for it has passed ``refuse_deep``.
    """

    class Bounded(loader):  # type: ignore[misc]  # of a class that is given
        def get_node(self) -> yaml.Node | None:
            return _counted(super().get_node())

        def get_single_node(self) -> yaml.Node | None:
            return _counted(super().get_single_node())

        def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:  # noqa: FBT001, FBT002
            try:
                return super().construct_object(node, deep)
            except _NO_VALUE as error:
                raise _no_value(node) from error

    return Bounded


_SHOWN = 60  # characters of a value in an error
_NO_VALUE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""Errors of PyYAML's constructors for text that a tag does not allow, such as ``!!int ''``."""


def _no_value(node: yaml.Node) -> yaml.YAMLError:
    """Return the error for a node that is no value of its tag."""
    import yaml

    kind = str(node.tag).rpartition(":")[2]
    shown = f"'{node.value[:_SHOWN]}'" if isinstance(node, yaml.ScalarNode) else "this"
    problem = f"{shown} is not a value of the kind '{kind}'"
    return yaml.MarkedYAMLError(problem=problem, problem_mark=node.start_mark)


def _counted(node: yaml.Node | None) -> yaml.Node | None:
    if node is not None:
        _refuse_large(node)
    return node


def _refuse_large(root: yaml.Node) -> None:
    """Count the values below a node, those of shared ones once for each place.

    Raises:
        yaml.YAMLError: There are too many, or a node is below itself.
    """
    import yaml

    sizes: dict[int, int | None] = {}

    def size(node: yaml.Node) -> int:
        known = sizes.get(id(node), 0)
        if known is None:
            raise yaml.MarkedYAMLError(problem="this contains itself", problem_mark=node.start_mark)
        if known:
            return known
        sizes[id(node)] = None
        total = 1
        for child in _children(node):
            total += size(child)
        if total > MAX_VALUES:
            raise yaml.MarkedYAMLError(
                problem=f"aliases and lists make {total:,} values of this, "
                f"more than the limit of {MAX_VALUES:,}",
                problem_mark=node.start_mark,
            )
        sizes[id(node)] = total
        return total

    size(root)


def _children(node: yaml.Node) -> Iterator[yaml.Node]:
    if isinstance(node.value, list):
        for child in node.value:
            yield from child if isinstance(child, tuple) else (child,)
