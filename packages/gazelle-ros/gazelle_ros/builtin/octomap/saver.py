"""The program ``octomap_saver``: a map as a file of OctoMap."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.writing import replacing
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.msgs import octomap_msgs

USAGE = "octomap_saver [-f] FILE.bt|FILE.ot"
_SUFFIXES = {True: ".bt", False: ".ot"}
_NODE_BYTES = 5
_LOG = logging.getLogger("gazelle.ros.octomap")


def main(arguments: Sequence[str]) -> int:
    """Write the map of a running server; ``-f`` writes likelihoods, too; returns the exit code."""
    found = parse_arguments(arguments, "octomap_saver", anonymous=True)
    files = [each for each in found.plain if each != "-f"]
    full = "-f" in found.plain
    if len(files) != 1:
        raise RosError("it takes one file", hint=USAGE)
    path = Path(files[0])
    if path.suffix != _SUFFIXES[not full]:
        hint = f"{_SUFFIXES[True]} without -f, {_SUFFIXES[False]} with it"
        raise RosError(f"'{path.name}' is not a name of such a map", hint=hint)
    with found.start() as node:
        name = "octomap_full" if full else "octomap_binary"
        node.wait_for_service(name)
        client = node.client(name, octomap_msgs.srv.GetOctomap)
        tree = client.call(octomap_msgs.srv.GetOctomapRequest()).map
    write_octomap(path, tree)
    _LOG.info("the map is written to %s", path)
    return 0


def write_octomap(path: Path, tree: octomap_msgs.msg.Octomap) -> None:
    """Write a tree, with the head that OctoMap reads.

    Raises:
        RosError: The file cannot be written.
    """
    data = np.array(tree.data, np.int8).tobytes()
    kind = " binary" if tree.binary else ""
    head = (
        f"# Octomap {tree.id}{kind} file\n"
        f"id {tree.id}\nsize {_node_count(data, binary=tree.binary)}\nres {tree.resolution:g}\ndata\n"
    )
    try:
        with replacing(path) as draft:
            draft.write_bytes(head.encode() + data)
    except OSError as error:
        raise RosError(f"the map cannot be written: {error}", file=str(path)) from error


def _node_count(data: bytes, *, binary: bool) -> int:
    """Return the number of nodes of a tree."""
    if not binary:
        return len(data) // _NODE_BYTES
    words = np.frombuffer(data, "<u2")
    children = sum(int(np.count_nonzero(words >> 2 * child & 3)) for child in range(8))
    return children + bool(len(words))
