"""Errors of the modules behind ROS's tools, in place of ours."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from gazelle_ros.errors import MasterUnreachableError, RosError

_Given = ParamSpec("_Given")
_Result = TypeVar("_Result")
_Function = Callable[_Given, _Result]


def raising(
    unreachable: type[Exception], otherwise: type[Exception] | None = None
) -> Callable[[_Function[_Given, _Result]], _Function[_Given, _Result]]:
    """Wrap a function to raise the errors that programs for ROS expect.

    Args:
        unreachable: Raised where the master does not answer.
        otherwise: Raised instead of other errors of ours, which else stay as they are.
    """

    def decorate(function: _Function[_Given, _Result]) -> _Function[_Given, _Result]:
        @functools.wraps(function)
        def call(*args: _Given.args, **keywords: _Given.kwargs) -> _Result:
            try:
                return function(*args, **keywords)
            except MasterUnreachableError as error:
                raise unreachable(str(error)) from None
            except RosError as error:
                if otherwise is None:
                    raise
                raise otherwise(str(error)) from None

        return call

    return decorate
