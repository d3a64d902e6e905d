"""Limits of what a file may hold, for what no format limits by itself."""

from __future__ import annotations

import stat
from pathlib import Path

from gazelle.errors import FormatError

MAX_XML_BYTES = 64 * 2**20
"""Size of an XML file."""

MAX_XML_DEPTH = 256
"""Elements of an XML file in each other."""

MAX_XML_ELEMENTS = 250_000
"""Elements of an XML file: to read one and to make what it describes takes 20 to 80 us."""

MAX_NAME = 2_000
"""Characters of a name and those of all elements around it: each part is named by all of them."""

MAX_PLACE = 200
"""Characters of a name in the path of an element; five times as many of the whole path."""

MAX_NODES = 100_000
"""Nodes of a COLLADA scene, each counted as often as it is put somewhere."""

MAX_TRIANGLES = 10_000_000
"""Triangles of a mesh, each counted as often as it is put somewhere."""

LONGEST = 1e10
"""Greatest length of a shape [m]: what is farther away is broken for engines."""

HEAVIEST = 1e15
"""Greatest mass [kg] or moment of inertia [kg m²]: squares of such are still numbers."""


MAX_TEXT = 4_000_000
"""Characters that an expression of a xacro file makes."""

MAX_FILES = 10_000
"""Included files of a world, each counted as often as it is read."""

MAX_POINTS = 10_000
"""Points of a polyline."""

MAX_BYTES = 512 * 2**20
"""Size of a file of a mesh, a picture or elevations."""


class LimitError(FormatError):
    """A file exceeds a limit."""


def read_bounded(path: Path, most: int = MAX_BYTES) -> bytes:
    """Return the content of a file.

    Raises:
        FormatError: It is larger, or it is a pipe, a socket or a device.
        OSError: It cannot be read.
    """
    refuse_special(path)
    if path.stat().st_size > most:
        raise FormatError(f"the file is larger than {most} bytes", file=str(path))
    return path.read_bytes()


def refuse_special(path: Path) -> None:
    """Raise an error for a pipe, a socket or a device, which may never end.

    Raises:
        FormatError: It is one of them.
    """
    try:
        mode = path.stat().st_mode
    except OSError:
        return  # its opening reports why
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise FormatError("this is a pipe, a socket or a device, and no file", file=str(path))
