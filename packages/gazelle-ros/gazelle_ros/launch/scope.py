"""Scope of an element in a launch file: namespace, arguments, remappings, environment."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field, replace
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.base.real_numbers import finite
from gazelle_ros.launch.document import Element
from gazelle_ros.launch.errors import LaunchError, place_error
from gazelle_ros.launch.plan import SourceLocation
from gazelle_ros.launch.substitution import Substitution
from gazelle_ros.launch.values import truth

_YES_NO = {"true": True, "false": False}


@dataclass(slots=True)
class LaunchScope:
    """Scope in a launch file."""

    namespace: str
    """With slashes at both ends."""
    words: Substitution
    private: list[tuple[str, Any, SourceLocation]] = field(default_factory=list)
    """Parameters ``~x`` for the nodes that follow."""
    remappings: dict[str, str] = field(default_factory=dict)
    environment: list[tuple[str, str]] = field(default_factory=list)
    declared: set[str] = field(default_factory=set)
    """Arguments that were declared in this file."""
    passes_all: bool = False
    """True below an include with ``pass_all_args``."""

    def child(self, namespace: str | None = None) -> LaunchScope:
        """Return the scope of a group: its settings stay in it."""
        return replace(
            self,
            namespace=self.namespace if namespace is None else self.below(namespace),
            words=replace(self.words, arguments=dict(self.words.arguments)),
            private=list(self.private),
            remappings=dict(self.remappings),
            environment=list(self.environment),
            declared=set(self.declared),
            passes_all=False,
        )

    def included(self, namespace: str | None, arguments: dict[str, str], file: str) -> LaunchScope:
        """Return the scope of an included file.

        It has its own arguments, and shares ``~`` parameters.
        """
        words = replace(self.words, arguments=arguments, file=file, anonymous={})
        scope = replace(self.child(namespace), words=words, private=self.private)
        scope.declared = set()
        return scope

    def below(self, name: str) -> str:
        """Return a namespace relative to this one, with slashes at both ends."""
        return names.as_namespace(names.join(self.namespace, name))

    def text(self, element: Element, key: str) -> str | None:
        """Return an attribute with its substitutions done; None if it is missing.

        Raises:
            SubstitutionError: A ``$(...)`` in it has no value.
        """
        raw = element.attributes.get(key)
        if raw is None:
            return None
        return self.resolve(raw, element)

    def resolve(self, text: str, element: Element) -> str:
        """Return text of an element with its substitutions done.

        Raises:
            SubstitutionError: A ``$(...)`` in it has no value.
        """
        try:
            return self.words.resolve(text)
        except LaunchError as error:
            place_error(error, element.file, element.line, element.label)
            raise

    def required(self, element: Element, *keys: str) -> tuple[str, ...]:
        """Return attributes that must be present.

        Raises:
            LaunchError: One is missing.
        """
        found = []
        for key in keys:
            value = self.text(element, key)
            if value is None:
                close = did_you_mean(key, set(element.attributes) - set(keys))
                hint = close if close.startswith("did you mean") else f'write {key}="..."'
                raise element.error(f"the attribute '{key}' is missing", hint)
            found.append(value)
        return tuple(found)

    def flag(self, element: Element, key: str) -> bool:
        """Return an attribute that is ``true`` or ``false``; false if it is missing.

        Raises:
            LaunchError: It is something else.
        """
        value = self.text(element, key)
        if value is None:
            return False
        if value.lower() not in _YES_NO:
            raise element.error(f"{key}='{value}' is neither true nor false")
        return _YES_NO[value.lower()]

    def number(self, element: Element, key: str, default: float) -> float:
        """Return an attribute that is a number.

        Raises:
            LaunchError: It is something else.
        """
        value = self.text(element, key)
        if value is None:
            return default
        with contextlib.suppress(ValueError):
            number = finite(float(value))
            if number is not None:
                return number
        raise element.error(f"{key}='{value:.60}' is not a finite number")

    def applies(self, element: Element) -> bool:
        """Return whether an element's ``if`` or ``unless`` includes it.

        Raises:
            LaunchError: It has both, or one that is not a boolean.
        """
        if "if" in element.attributes and "unless" in element.attributes:
            raise element.error("an element has 'if' or 'unless', not both")
        for key in ("if", "unless"):
            value = self.text(element, key)
            if value is not None:
                try:
                    return truth(value) == (key == "if")
                except LaunchError as error:
                    raise element.error(f"{key}: {error.message}") from None
        return True

    def declare(self, element: Element, name: str, value: str | None, default: str | None) -> None:
        """Declare an argument of the file.

        Raises:
            LaunchError: It was declared before, or is a constant with a given value.
        """
        if name in self.declared and not self.passes_all:
            raise element.error(f"the argument '{name}' was declared before")
        self.declared.add(name)
        given = self.words.arguments
        if value is not None:
            if name in given and not self.passes_all:
                raise element.error(
                    f"the argument '{name}' is a constant of this file and cannot be given",
                    "write default instead of value to let others set it",
                )
            given[name] = value
        elif default is not None:
            given.setdefault(name, default)

    def remap(self, element: Element, old: str, new: str) -> None:
        """Add a remapping; an earlier one of the same name is replaced.

        Raises:
            LaunchError: A name is not legal.
        """
        pair = []
        for key, name in (("from", old), ("to", new)):
            name = names.canonical(name.strip())  # noqa: PLW2901  # the same name, tidied
            if not names.is_legal(name) and name != "/":
                raise element.error(f"{key}='{name}' is not a legal name")
            pair.append(name)
        self.remappings.pop(pair[0], None)
        self.remappings[pair[0]] = pair[1]
