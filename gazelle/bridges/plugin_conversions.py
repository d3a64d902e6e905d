"""Values of plugins' ports to ROS messages and back; imported for what it teaches."""

from __future__ import annotations

from typing import Any

from gazelle.bridges.conversions import (
    Decoder,
    ServiceCodec,
    add_decoder,
    add_service,
    point,
)
from gazelle.simulation.values import LinkPair, Push


def _push(message: Any) -> Push:
    return Push(point(message.force), point(message.torque))


def _link_pair(request: Any) -> LinkPair:
    return LinkPair(
        request.model_name_1, request.link_name_1, request.model_name_2, request.link_name_2
    )


add_decoder(Push, Decoder("geometry_msgs/Wrench", _push))
add_service(
    LinkPair,
    bool,
    ServiceCodec("gazebo_ros_link_attacher/Attach", _link_pair, lambda answer: {"ok": answer}),
)
