"""``$(find PKG)`` and the like in any text."""

from __future__ import annotations

from typing import Any

from gazelle_ros.launch.errors import LaunchError, MissingArgumentError, MissingPackageError
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.substitution import Substitution


class SubstitutionException(Exception):  # noqa: N818  # roslaunch's name
    """A ``$(...)`` is malformed or has no value."""


class ArgException(SubstitutionException):
    """An argument has no value."""


def resolve_args(
    arg_str: str | None,
    context: dict[str, Any] | None = None,
    resolve_anon: bool = True,  # noqa: FBT001, FBT002  # roslaunch's interface
    filename: str | None = None,
) -> Any:
    """Return the text with every ``$(...)`` replaced.

    Args:
        arg_str: The text; one that is empty or None is returned as it is.
        context: Keeps what belongs together over calls: ``arg`` has the values of arguments, ``anon``
            the names that were made.
        resolve_anon: Make names for ``$(anon X)``; else they stay.
        filename: The file that ``$(dirname)`` is about.

    Raises:
        SubstitutionException: One is malformed or has no value.
        ResourceNotFound: There is no such package.
    """
    if not arg_str:
        return arg_str
    kept = {} if context is None else context
    words = Substitution(
        Packages(),
        filename or kept.get("filename"),
        arguments=kept.setdefault("arg", {}),
        anonymous=kept.setdefault("anon", {}),
    )
    if not resolve_anon:
        parts = _split_anon(arg_str)
        return "".join(
            part
            if part.startswith("$(anon ")
            else resolve_args(part, kept, filename=filename) or ""
            for part in parts
        )
    try:
        return words.resolve(arg_str)
    except MissingArgumentError as error:
        raise ArgException(error.argument) from None
    except MissingPackageError as error:
        from gazelle_ros.compat.rospkg import ResourceNotFound, get_ros_paths

        raise ResourceNotFound(error.package, ros_paths=get_ros_paths()) from None
    except LaunchError as error:
        raise SubstitutionException(str(error)) from None


def _split_anon(text: str) -> list[str]:
    import re

    return [part for part in re.split(r"(\$\(anon [^()]*\))", text) if part]
