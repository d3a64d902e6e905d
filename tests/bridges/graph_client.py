"""A client of a simulation on a graph, and what it sends."""

from __future__ import annotations

import math

from gazelle_ros import Node, WallClock, load_message, load_service

BALL = """<sdf version="1.6"><model name="ball"><link name="link"><inertial><mass>2</mass></inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model></sdf>"""


class Client:
    """A node that calls services by short names, over connections that stay open."""

    def __init__(self, uri, name="client"):
        self.node = Node(name, master_uri=uri, clock=WallClock())
        self._clients = {}

    def call(self, name, kind, **fields):
        service = load_service(kind if "/" in kind else f"gazebo_msgs/{kind}")
        full = name if name.startswith("/") else f"/gazebo/{name}"
        if full not in self._clients:
            self._clients[full] = self.node.client(full, service, persistent=True)
        return self._clients[full].call(service._request_class(**fields), timeout=60.0)

    def listen(self, topic, kind):
        """Return the list of a topic's messages from now on."""
        heard = []
        self.node.subscribe(topic, load_message(kind), heard.append)
        return heard


def pose(x=0.0, y=0.0, z=0.0, yaw=0.0):
    message = load_message("geometry_msgs/Pose")()
    message.position.x, message.position.y, message.position.z = x, y, z
    message.orientation.z, message.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def model_state(name, place, frame="", linear=(0.0, 0.0, 0.0)):
    state = load_message("gazebo_msgs/ModelState")()
    state.model_name, state.pose, state.reference_frame = name, place, frame
    state.twist.linear.x, state.twist.linear.y, state.twist.linear.z = linear
    return state
