"""Errors of launch files."""

from __future__ import annotations

from gazelle_ros.base.errors import RosError


class LaunchError(RosError):
    """A launch file is malformed, or asks for something that is impossible."""


class SubstitutionError(LaunchError):
    """A ``$(...)`` in a launch file cannot be replaced by a value."""


class MissingPackageError(SubstitutionError):
    """A package is neither on ROS_PACKAGE_PATH nor built in.

    Attributes:
        package: Its name.
    """

    def __init__(self, message: str, *, package: str, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.package = package


class MissingArgumentError(SubstitutionError):
    """An argument has no value.

    Attributes:
        argument: Its name.
    """

    def __init__(self, message: str, *, argument: str, hint: str | None = None) -> None:
        super().__init__(message, hint=hint)
        self.argument = argument

    def add_location(self, file: str | None, line: int | None) -> None:
        """Add a hint that an <include> should set it, unless one is named already."""
        if self.hint and "include" not in self.hint:
            self.hint = f"give it in the <include> at {file}:{line}"
            self.args = (f"{self.args[0].rpartition('; ')[0]}; {self.hint}",)


def place_error(error: LaunchError, file: str, line: int, element: str) -> None:
    """Add the place of an error; one that knows its place keeps it."""
    if error.file is not None:
        return
    error.file, error.line, error.element = file, line, element
    from gazelle_ros.base.errors import describe

    text = describe(error.message, file=file, line=line, element=element, hint=error.hint)
    error.args = (text,)
