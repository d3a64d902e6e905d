"""Topics with the structure and the active states of state machines, for ``smach_viewer``."""

from __future__ import annotations

import base64
import pickle
import threading

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.smach import Container, UserData
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import smach_msgs, std_msgs

_PERIOD_S = 2.0


class _Proxy:
    """Publisher of the structure and the active states of one container.

    Args:
        server: Its topics are below this.
        container: The container.
        path: Of the container within the outermost.
    """

    def __init__(self, server: str, container: Container, path: str) -> None:
        self._container, self._path, self._lock = container, path, threading.Lock()
        self._stopped = False
        status, structure, start = (
            load_message(f"smach_msgs/SmachContainer{kind}")
            for kind in ("Status", "Structure", "InitialStatusCmd")
        )
        self._status, self._structure = status, structure
        self._on_status = rospy.Publisher(f"{server}/smach/container_status", status, queue_size=10)
        self._on_structure = rospy.Publisher(
            f"{server}/smach/container_structure", structure, queue_size=10
        )
        self._commands = rospy.Subscriber(f"{server}/smach/container_init", start, self._command)
        container.register_start_cb(lambda *_: self.publish_status("Start"))
        container.register_transition_cb(lambda *_: self.publish_status("Transition"))
        container.register_termination_cb(lambda *_: self.publish_status("Termination"))

    def publish_status(self, info: str) -> None:
        """Publish which states are active, and the structure."""
        inside, now = self._container, std_msgs.msg.Header(stamp=rospy.get_rostime())
        edges = [[str(name) for name in edge] for edge in inside.get_internal_edges()]
        with self._lock:
            if self._stopped:
                return
            self._on_status.publish(
                self._status(
                    header=now,
                    path=self._path,
                    initial_states=inside.get_initial_states(),
                    active_states=inside.get_active_states(),
                    local_data=_packed(inside.userdata),
                    info=info,
                )
            )
            self._on_structure.publish(
                self._structure(
                    header=now,
                    path=self._path,
                    children=list(inside.get_children()),
                    internal_outcomes=[edge[0] for edge in edges],
                    outcomes_from=[edge[1] for edge in edges],
                    outcomes_to=[edge[2] for edge in edges],
                    container_outcomes=list(inside.get_registered_outcomes()),
                )
            )

    def _command(self, message: smach_msgs.msg.SmachContainerInitialStatusCmd) -> None:
        """Choose the initial states; userdata is not taken from the network, where it is pickled."""
        known = self._container.get_children()
        if message.path != self._path:
            return
        if not all(state in known for state in message.initial_states):
            rospy.logerr(f"'{self._path}' has no states {message.initial_states}")
            return
        self._container.set_initial_state(message.initial_states, UserData())
        self.publish_status("REMOTE_INIT")

    def stop(self) -> None:
        """Close the topics."""
        with self._lock:
            self._stopped = True
        for each in (self._commands, self._on_status, self._on_structure):
            each.unregister()


def _packed(userdata: UserData) -> str:
    """Return userdata as smach does: pickled, in base 64; without what cannot be pickled."""
    kept = {}
    for key in userdata.keys():  # noqa: SIM118  # it is no mapping
        try:
            pickle.dumps(userdata[key], 2)
        except Exception:  # noqa: BLE001, S112  # anything may be in it
            continue
        kept[key] = userdata[key]
    return base64.b64encode(pickle.dumps(kept, 2)).decode()


class IntrospectionServer:
    """Publisher of the structure and the active states of a container and those within it.

    Args:
        server_name: Its topics are below this.
        state: The outermost container.
        path: Path, such as ``/SM_ROOT``.
    """

    def __init__(self, server_name: str, state: Container, path: str) -> None:
        self._server, self._root, self._path = server_name, state, path
        self._proxies: list[_Proxy] = []
        self._stopped = threading.Event()

    def start(self) -> None:
        """Start the server."""
        self._stopped.clear()
        self._add(self._root, self._path)
        threading.Thread(target=self._repeat, name=f"{self._server}:status", daemon=True).start()

    def _add(self, container: Container, path: str) -> None:
        proxy = _Proxy(self._server, container, path)
        self._proxies.append(proxy)
        for label, child in container.get_children().items():
            if isinstance(child, Container):
                self._add(child, f"{path.rstrip('/')}/{label}")
        proxy.publish_status("Initial state")

    def _repeat(self) -> None:
        while not self._stopped.wait(_PERIOD_S) and not rospy.is_shutdown():
            for proxy in self._proxies:
                proxy.publish_status("HEARTBEAT")

    def stop(self) -> None:
        """Stop the server."""
        self._stopped.set()
        for proxy in self._proxies:
            proxy.stop()
        self.clear()

    def clear(self) -> None:
        """Discard all containers."""
        self._proxies = []
