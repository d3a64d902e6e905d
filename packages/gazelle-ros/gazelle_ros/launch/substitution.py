"""``$(env X)``, ``$(find PKG)``, ``$(arg X)`` and the like in attributes of launch files.

The rules are those of http://wiki.ros.org/roslaunch/XML#substitution_args.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle_ros import names
from gazelle_ros.base import bounded_expressions, bounded_texts
from gazelle_ros.base.errors import FormatError, did_you_mean
from gazelle_ros.launch.errors import MissingArgumentError, SubstitutionError
from gazelle_ros.launch.limits import check_text
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.values import automatic

_EVAL = "$(eval "
_COMMANDS = ("find", "env", "optenv", "dirname", "anon", "arg", "eval")
_OPENING = re.compile(r"\$\((?!\))")
_FIND = re.compile(r"\$\(find ([^()$]*)\)([^ ]*)")
_BUILTINS = {
    each.__name__: each
    for each in (
        abs, all, any, bool, dict, divmod, enumerate, filter, float, int, len, list, map, max, min,
        pow, repr, reversed, round, set, sorted, sum, tuple, zip,
    )
} | {"range": bounded_expressions.bounded_range, "str": bounded_texts.text}  # fmt: skip
_MATH = {name: value for name, value in vars(math).items() if not name.startswith("_")}


@dataclass(slots=True)
class Substitution:
    """Values of the names in ``$(...)`` in one launch file."""

    packages: Packages
    file: str | None = None
    """The launch file; None for text that is not from a file."""
    arguments: dict[str, str] = field(default_factory=dict)
    environment: Mapping[str, str] = field(default_factory=lambda: os.environ)
    anonymous: dict[str, str] = field(default_factory=dict)
    """Names that ``$(anon X)`` gave, by X."""

    def resolve(self, text: str) -> str:
        """Return `text` with every ``$(...)`` replaced.

        Raises:
            SubstitutionError: One is malformed, unknown, or has no value.
        """
        if "$(" not in text:
            return text
        if text.startswith(_EVAL) and text.endswith(")"):
            return check_text(str(self.evaluate(text[len(_EVAL) : -1])))
        # An argument's value may hold $(find), as users give it on the command line.
        return self._find_all(check_text(self._replace_all(text)))

    def evaluate(self, expression: str) -> Any:
        """Return the value of the expression of ``$(eval EXPRESSION)``.

        Raises:
            SubstitutionError: It is not valid, or uses a name that is not there.
        """
        if "__" in expression:
            raise SubstitutionError("an expression of $(eval) may not have a double underscore")
        scope = self._names()
        try:
            bounded_expressions.begin()
            return bounded_expressions.evaluate(expression, {**_BUILTINS, **scope})
        except SubstitutionError:
            raise
        except FormatError as error:
            raise SubstitutionError(f"$(eval {expression}): {error.message}") from None
        except NameError as error:
            name = getattr(error, "name", None) or "?"
            raise SubstitutionError(
                f"'{name}' in $(eval {expression}) is not defined",
                hint=did_you_mean(name, self.arguments),
            ) from None
        except Exception as error:  # noqa: BLE001  # whatever an expression may raise
            raise SubstitutionError(
                f"$(eval {expression}) fails: {type(error).__name__}: {error}"
            ) from None

    def _names(self) -> dict[str, Any]:
        typed = {name: automatic(value) for name, value in self.arguments.items()}
        constants = {"true": True, "false": False, "True": True, "False": False}
        functions: dict[str, Callable[..., Any]] = {
            "arg": lambda name: automatic(self._argument(name)),
            "env": self._env,
            "optenv": lambda name, default="": self.environment.get(name, default),
            "find": lambda package: str(self.packages.folder(package)),
            "anon": self._anon,
            "dirname": self._dirname,
        }
        return {**typed, **_MATH, **constants, **functions}

    def _replace_all(self, text: str) -> str:
        """Replace all but ``$(find)``."""
        done, position = [], 0
        for command, start, end in _collect(text):
            done.append(text[position:start])
            name, *words = command.split()
            if name == "eval":
                raise SubstitutionError(
                    f"$({command}) must be the whole of the attribute",
                    hint="put all of it into the expression: $(eval 'a' + str(arg('b')))",
                )
            if name not in _COMMANDS:
                raise SubstitutionError(
                    f"'{name}' in $({command}) is unknown", hint=did_you_mean(name, _COMMANDS)
                )
            keep = name == "find"
            done.append(text[start:end] if keep else self._replace(name, words, command))
            position = end
        done.append(text[position:])
        return "".join(done)

    def _replace(self, name: str, words: list[str], command: str) -> str:
        if name == "dirname":
            return self._dirname()
        if not words:
            raise SubstitutionError(f"$({command}) needs a name")
        if name == "optenv":
            return self.environment.get(words[0], " ".join(words[1:]))
        if len(words) > 1:
            raise SubstitutionError(f"$({command}) takes one name only")
        return {"env": self._env, "anon": self._anon, "arg": self._argument}[name](words[0])

    def _find_all(self, text: str) -> str:
        for command, _start, _end in _collect(text):
            words = command.split()
            if words[0] == "find" and len(words) != 2:
                raise SubstitutionError(f"$({command}) takes one package")

        # One after the other: what follows a $(find) may hold the next one.
        while match := _FIND.search(text):
            package, rest = match.group(1).strip(), match.group(2)
            path, mark, more = rest.partition("$(")
            found = self.packages.locate(package, path, followed=bool(mark))
            text = text[: match.start()] + found + mark + more + text[match.end() :]
        return text

    def _env(self, name: str) -> str:
        if name not in self.environment:
            raise SubstitutionError(
                f"the environment variable '{name}' is not set", hint=f"export {name}=..."
            )
        return self.environment[name]

    def _argument(self, name: str) -> str:
        if name not in self.arguments:
            close = did_you_mean(name, self.arguments)
            hint = close if close.startswith("did you mean") else f"give it as {name}:=VALUE"
            raise MissingArgumentError(
                f"the argument '{name}' has no value", argument=name, hint=hint
            )
        return self.arguments[name]

    def _anon(self, name: str) -> str:
        if name not in self.anonymous:
            self.anonymous[name] = names.anonymous(name)
        return self.anonymous[name]

    def _dirname(self) -> str:
        if not self.file:
            raise SubstitutionError("$(dirname) needs a launch file, and this text has none")
        return os.path.dirname(os.path.abspath(self.file))  # noqa: PTH100, PTH120  # text to text


def _collect(text: str) -> list[tuple[str, int, int]]:
    """Return the contents of ``$(...)``, with their start and end.

    Raises:
        SubstitutionError: There is a dollar sign or parenthesis in one.
    """
    found, position = [], 0
    while match := _OPENING.search(text, position):
        end = text.find(")", match.end())
        if end < 0:
            break
        inner = text[match.end() : end]
        for sign in ("$", "("):
            if sign in inner:
                raise SubstitutionError(f"there is a '{sign}' inside of $({inner}...")
        if inner.strip():
            found.append((inner, match.start(), end + 1))
        position = end + 1
    return found
