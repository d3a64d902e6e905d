"""List the plugins that files can name, and what they do."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from gazelle.cli import showing

if TYPE_CHECKING:
    from collections.abc import Callable

    from gazelle.description import Plugin


def configure(parser: argparse.ArgumentParser) -> None:
    """There are no arguments."""
    del parser


def _purpose(find: Callable[[Plugin], type | None], plugin: Plugin) -> str:
    """What a plugin does, or why it cannot be had: another package may have a broken one."""
    try:
        found = find(plugin)
    except Exception as error:  # noqa: BLE001  anything may go wrong in an import
        return f"cannot be had: {error}"
    return (found.__doc__ or "").strip().partition("\n")[0] if found else ""


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    del args
    from gazelle.description import Plugin
    from gazelle.simulation import registry

    rows = [("PLUGIN", "WHAT IT DOES")]
    plugins = [Plugin(name=name, filename=name) for name in registry.names()]
    rows += [(plugin.name, _purpose(registry.find, plugin)) for plugin in plugins]
    sys.stdout.write(showing.table(rows))
    return 0
