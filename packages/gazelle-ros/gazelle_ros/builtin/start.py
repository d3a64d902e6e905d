"""``python -m gazelle_ros.builtin.start PACKAGE TYPE ...``: run a built-in node."""

from __future__ import annotations

import sys
import warnings
from typing import TextIO

from gazelle_ros.base.errors import Error, GazelleWarning
from gazelle_ros.base.interrupts import end_process, interruptible, requested
from gazelle_ros.builtin.registry import main_of
from gazelle_ros.builtin.registry import package as built_in
from gazelle_ros.errors import NodeClosedError
from gazelle_ros.process_name import call_process


def main(arguments: list[str]) -> int:
    """Run the node that the first two arguments name; returns the exit code."""
    package, kind, *rest = arguments
    known = built_in(package)
    call_process(known.process_names.get(kind, kind) if known else kind)
    warnings.showwarning = _show_warning
    try:
        with interruptible(ends_process=True):
            return main_of(package, kind)(rest)
    except NodeClosedError:
        return 0  # the node was requested to end while it began
    except Error as error:
        sys.stderr.write(f"[{package}/{kind}] {error}\n")
        return 1
    except KeyboardInterrupt:
        return 0


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Show our warnings as one line, as rospy's are; others as Python shows them."""
    text = f"[WARN] {message}\n"
    if not issubclass(category, GazelleWarning):
        text = warnings.formatwarning(message, category, filename, lineno, line)
    (file or sys.stderr).write(text)


if __name__ == "__main__":
    code = main(sys.argv[1:])
    if requested():
        end_process(code)
    sys.exit(code)
