"""Reads launch files into a `ROSLaunchConfig`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle_ros.base.errors import Error
from gazelle_ros.compat.roslaunch.config import ROSLaunchConfig
from gazelle_ros.compat.roslaunch.core import RLException
from gazelle_ros.launch.loader import load_launch, load_launch_text
from gazelle_ros.names import split_arguments


class XmlParseException(RLException):
    """A launch file is malformed."""


class XmlLoader:
    """Reads launch files.

    Args:
        resolve_anon: Accepted; names are always made.
        args_only: Accepted; all is read.
    """

    def __init__(self, resolve_anon: bool = True, args_only: bool = False) -> None:  # noqa: FBT001, FBT002  # roslaunch's interface
        self.resolve_anon, self.args_only = resolve_anon, args_only
        self.root_context: Any = None

    def load(
        self,
        filename: str,
        ros_config: ROSLaunchConfig,
        core: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
        argv: Sequence[str] | None = None,
        verbose: bool = True,  # noqa: FBT001, FBT002  # roslaunch's interface
    ) -> None:
        """Add the content of a file; ``x:=1`` in `argv`, by default this process's, are arguments.

        Raises:
            XmlParseException: It is malformed.
        """
        import sys

        del core, verbose
        words = sys.argv if argv is None else argv
        try:
            plan = load_launch(filename, split_arguments(words)[1])
        except Error as error:
            raise XmlParseException(str(error)) from None
        ros_config.take(plan)

    def load_string(
        self,
        xml_text: str,
        ros_config: ROSLaunchConfig,
        core: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
        verbose: bool = True,  # noqa: FBT001, FBT002  # roslaunch's interface
    ) -> None:
        """Add the content of a text.

        Raises:
            XmlParseException: It is malformed.
        """
        del core, verbose
        try:
            plan = load_launch_text(xml_text)
        except Error as error:
            raise XmlParseException(str(error)) from None
        ros_config.take(plan)
