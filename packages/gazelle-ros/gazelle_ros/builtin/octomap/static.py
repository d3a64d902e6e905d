"""The node ``octomap_server_static``: a map of a file by services (http://wiki.ros.org/octomap_server)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.parameter_values import value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import CallbackWork, parse_arguments, run_node
from gazelle_ros.builtin.octomap.codec import binary_tree, full_tree
from gazelle_ros.builtin.octomap.messages import octomap
from gazelle_ros.builtin.octomap.reader import read_octomap
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.msgs import octomap_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time


class StaticOctomap(CallbackWork):
    """Services ``octomap_binary`` and ``octomap_full`` of a map that does not change.

    Args:
        node: On the graph.
        file: A ``.bt`` or ``.ot`` file.

    Raises:
        Error: A parameter is wrong, or the file cannot be read.
    """

    def __init__(self, node: Node, file: str) -> None:
        super().__init__(node)
        values = private_values(node)
        warn_of_unknown(node.resolve("~"), values, ["frame_id"])
        self._frame = value_of(values, "frame_id", "map")
        found = read_octomap(Path(file))
        self._resolution = found.resolution
        trees = {
            "octomap_binary": binary_tree(found.codes, found.values >= 0.0),
            "octomap_full": full_tree(found.codes, found.values),
        }
        for name, data in trees.items():
            self._serve(name, data)

    def _serve(self, name: str, data: bytes) -> None:
        def answer(_request: octomap_msgs.srv.GetOctomapRequest) -> list[octomap_msgs.msg.Octomap]:
            stamp = Time(nsecs=self.node.clock.now())
            header = std_msgs.msg.Header(stamp=stamp, frame_id=self._frame)
            binary = name == "octomap_binary"
            return [octomap(header, self._resolution, data, binary=binary)]

        self.node.serve(name, octomap_msgs.srv.GetOctomap, answer)


def main(arguments: Sequence[str]) -> int:
    """Serve the map of a file until shutdown; returns 0.

    Raises:
        RosError: No file is named, or several are.
    """
    plain = parse_arguments(arguments, "octomap_server_static").plain
    if len(plain) != 1:
        raise RosError("it takes one file", hint="octomap_server_static MAP.bt|MAP.ot")
    return run_node(arguments, "octomap_server_static", lambda node: StaticOctomap(node, plain[0]))
