"""The node ``spawn_model`` of the package ``gazebo_ros``: puts a model into a running world."""

from __future__ import annotations

import argparse
import contextlib
import logging
import re
import sys
import time
from collections.abc import Iterator, Sequence
from typing import Any
from xml.sax.saxutils import escape

from gazelle.clients.poses import pose_message
from gazelle.errors import RosError
from gazelle_ros import Node, load_service
from gazelle_ros.base.argument_types import NumberParser
from gazelle_ros.base.bundled_packages import published, published_hint
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.path_texts import expanded
from gazelle_ros.base.text_files import read_text
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.compat.rosgraph.roslogging import RosStreamHandler
from gazelle_ros.errors import RosTimeoutError

# After this wall time without Gazebo's services a word is said; they are waited for all the same [s].
_PATIENCE_S = 10.0
_POLL_S = 0.05
_MESH = re.compile(r"""(<mesh\b[^>]*\bfilename\s*=\s*["'])package://""")
_FROM_DATABASE = """<sdf version="1.6"><world name="default">
<include><uri>model://{}</uri></include></world></sdf>"""
_log = logging.getLogger("gazelle.clients")


def main(arguments: Sequence[str]) -> int:
    """Spawn a model; returns 0 if it is there, else 1."""
    found = parse_arguments(arguments, "spawn_model", anonymous=True)
    options = parse_options(found.plain)
    with _speaking(), found.start() as node:
        spawner = _Spawner(node, options)
        try:
            if not spawner.spawn():
                return 1
            if options.bond:
                _log.info("Waiting for shutdown to delete model %s", options.model)
                _wait_for_the_end(node)
        finally:
            # Ctrl-C may come at any time from the call on.
            if options.bond and spawner.called:
                spawner.delete()
    return 0


class _Spawner:
    """One run of the program.

    Attributes:
        called: Whether the model may be there because of this.
    """

    def __init__(self, node: Node, options: argparse.Namespace) -> None:
        self._node = node
        self._options = options
        self.called = False
        self._gazebo = "/" + options.gazebo_namespace.strip("/")

    def spawn(self) -> bool:
        """Spawn the model of the command line; False if Gazebo fails."""
        options = self._options
        if options.wait:
            self._wait_for(options.wait)
        text = _read(self._node, options)
        kind = "urdf" if options.urdf else "sdf"
        service = f"spawn_{kind}_model"
        _log.info("Waiting for service %s/%s", self._gazebo, service)
        self._wait_for_service(f"{self._gazebo}/{service}")
        _log.info("Calling service %s/%s", self._gazebo, service)
        self.called = True
        answer = self._call(
            service,
            "SpawnModel",
            model_name=options.model,
            model_xml=text,
            robot_namespace=options.robot_namespace or self._node.namespace,
            initial_pose=pose_message(
                (options.x, options.y, options.z), (options.roll, options.pitch, options.yaw)
            ),
            reference_frame=options.reference_frame,
        )
        _log.info("Spawn status: %s", answer.status_message)
        if not answer.success:
            self.called = False
            _log.error("Spawn service failed. Exiting.")
            return False
        return self._configure() and self._unpause()

    def delete(self) -> None:
        """Delete the model again."""
        _log.info("Deleting model %s", self._options.model)
        self._call("delete_model", "DeleteModel", model_name=self._options.model)

    def _configure(self) -> bool:
        joints = self._options.joints
        if not joints:
            return True
        _log.info("Calling service %s/set_model_configuration", self._gazebo)
        answer = self._call(
            "set_model_configuration",
            "SetModelConfiguration",
            model_name=self._options.model,
            urdf_param_name="",
            joint_names=[name for name, _ in joints],
            joint_positions=[float(position) for _, position in joints],
        )
        _log.info("Set model configuration status: %s", answer.status_message)
        if not answer.success:
            _log.error("SetModelConfiguration service failed. Exiting.")
        return bool(answer.success)

    def _unpause(self) -> bool:
        if self._options.unpause:
            _log.info("Unpausing physics")
            self._call("unpause_physics", "Empty", package="std_srvs")
        return True

    def _wait_for(self, model: str) -> None:
        """Wait for a model, however long it takes."""
        _log.info("Waiting for model %s before proceeding.", model)
        while True:
            answer = self._call("get_world_properties", "GetWorldProperties")
            if model in answer.model_names:
                return
            time.sleep(_POLL_S)

    def _call(self, name: str, kind: str, package: str = "gazebo_msgs", **fields: Any) -> Any:
        service = load_service(f"{package}/{kind}")
        full = f"{self._gazebo}/{name}"
        self._wait_for_service(full)
        request = service._request_class(**fields)
        return self._node.client(full, service).call(request)

    def _wait_for_service(self, name: str) -> None:
        """Wait for Gazebo, however long it takes."""
        try:
            self._node.wait_for_service(name, timeout=_PATIENCE_S)
        except RosTimeoutError:
            _log.warning("still waiting for service %s", name)
            self._node.wait_for_service(name)


def parse_options(arguments: Sequence[str]) -> argparse.Namespace:
    """Parse the command line of ``spawn_model``."""
    parser = NumberParser(
        "spawn_model", description="Put a model into a running world.", allow_abbrev=False
    )
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("-urdf", action="store_true", help="the description is URDF")
    kind.add_argument("-sdf", action="store_true", help="the description is SDF")
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("-file", metavar="FILE")
    source.add_argument("-param", metavar="NAME", help="a parameter holds the description")
    source.add_argument("-database", metavar="MODEL", help="a model that Gazebo finds by its name")
    source.add_argument("-stdin", action="store_true")
    parser.add_argument("-model", metavar="NAME", required=True)
    parser.add_argument("-reference_frame", metavar="NAME", default="")
    parser.add_argument("-gazebo_namespace", metavar="NS", default="/gazebo")
    parser.add_argument("-robot_namespace", metavar="NS", default="")
    parser.add_argument("-unpause", action="store_true", help="let the world run afterwards")
    parser.add_argument("-wait", metavar="MODEL", help="until that model is there")
    for flag, meaning in zip("xyzRPY", ("x", "y", "z", "roll", "pitch", "yaw"), strict=True):
        parser.add_argument(f"-{flag}", dest=meaning, type=float, default=0.0)
    parser.add_argument(
        "-J", dest="joints", nargs=2, action="append", default=[], metavar=("JOINT", "POSITION")
    )
    parser.add_argument(
        "-package_to_model",
        action="store_true",
        help="look for meshes at model:// instead of package://",
    )
    parser.add_argument("-b", dest="bond", action="store_true", help="delete it at the end")
    return parser.parse_args(list(arguments))


def _read(node: Node, options: argparse.Namespace) -> str:
    """Return the description.

    Raises:
        RosError: There is none, or it is empty.
    """
    _log.info("Loading model XML from %s", _source(options))
    if options.param:
        found = node.get_param(options.param, None)
        if not isinstance(found, str):
            raise RosError(f"the parameter '{options.param}' holds no description")
        text = found
    elif options.stdin:
        text = sys.stdin.read()
    elif options.database:
        text = _FROM_DATABASE.format(escape(options.database))
    else:
        text = _read_file(options.file)
    if not text.strip():
        raise RosError("the description is empty", file=options.file)
    return _MESH.sub(r"\1model://", text) if options.package_to_model else text


def _source(options: argparse.Namespace) -> str:
    """Return the source of the description, in the words of gazebo_ros."""
    if options.param:
        return f"ros parameter {options.param}"
    if options.database:
        return "Gazebo Model Database"
    return "stdin" if options.stdin else f"file {options.file}"


@contextlib.contextmanager
def _speaking() -> Iterator[None]:
    """Print log messages in the format of rospy."""
    screen, former = RosStreamHandler(), _log.level
    _log.addHandler(screen)
    _log.setLevel(logging.INFO)
    try:
        yield
    finally:
        _log.setLevel(former)
        _log.removeHandler(screen)


def _read_file(path: str) -> str:
    try:
        return read_text(published(expanded(path)))
    except OSError as error:
        message = f"the model cannot be read: {error.strerror}"
        raise RosError(message, file=path, hint=published_hint(path)) from None


def _wait_for_the_end(node: Node) -> None:
    """Wait for Ctrl-C, or for a request to shut down."""
    with stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        stop.wait()
