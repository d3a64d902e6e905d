"""The node ``tf2_web_republisher``: transforms at a rate, for web pages (http://wiki.ros.org/tf2_web_republisher)."""

from __future__ import annotations

import itertools
import math
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.actions import ActionServer, ServerGoalHandle
from gazelle_ros.base.parameter_values import positive
from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.speeds import repeat
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import geometry_msgs, tf2_web_republisher
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform
from gazelle_ros.tf.listening import FrameListener
from gazelle_ros.time import Time

_QUEUE = 10

Transforms = list[geometry_msgs.msg.TransformStamped]


def main(arguments: Sequence[str]) -> int:
    """Publish transforms until shutdown; returns the exit code."""
    return run_node(arguments, "tf2_web_republisher", TransformRepublisher)


@dataclass(slots=True)
class FramePair:
    """Two frames, and the transform between them that was sent last.

    Attributes:
        source: Child frame.
        target: Parent frame.
        least_turn: Half the angle from which a change is sent [rad]; 0: always.
        least_shift: Distance from which a change is sent [m]; 0: always.
    """

    source: str
    target: str
    least_turn: float = 0.0
    least_shift: float = 0.0
    _sent: StampedTransform | None = None

    def take(self, transform: StampedTransform) -> bool:
        """Return whether a transform has to be sent, which then is the last one."""
        if self._sent is not None and self.least_turn and self.least_shift:
            shift = math.dist(self._sent.translation, transform.translation)
            product = sum(map(float.__mul__, self._sent.rotation, transform.rotation))
            turn = math.acos(min(1.0, abs(product)))
            if shift <= self.least_shift and turn <= self.least_turn:
                return False
        self._sent = transform
        return True


class TransformRepublisher(CallbackWork):
    """Transforms as feedback of the action of the node's name, and on topics of ``republish_tfs``.

    Args:
        node: On the graph.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self._frames = FrameListener(node)
        self._goals: dict[ServerGoalHandle, threading.Event] = {}
        self._numbers = itertools.count()
        messages = tf2_web_republisher
        node.serve("republish_tfs", messages.srv.RepublishTFs, self._serve)
        action = messages.msg.TFSubscriptionAction
        self._server = ActionServer(node, node.name, action, self._begin, self._cancel)

    def _begin(self, handle: ServerGoalHandle) -> None:
        goal = handle.get_goal()
        try:
            rate = positive("rate", goal.rate)
        except RosError as error:
            handle.set_rejected(text=error.message)
            return
        handle.set_accepted()
        stop = self._goals[handle] = threading.Event()

        def send(transforms: Transforms) -> None:
            kind = tf2_web_republisher.msg.TFSubscriptionFeedback
            handle.publish_feedback(kind(transforms=transforms))

        self._start(goal, rate, send, stop)

    def _cancel(self, handle: ServerGoalHandle) -> None:
        stop = self._goals.pop(handle, None)
        if stop is not None:
            stop.set()
            handle.set_canceled()

    def _serve(
        self, request: tf2_web_republisher.srv.RepublishTFsRequest
    ) -> tf2_web_republisher.srv.RepublishTFsResponse:
        rate = positive("rate", request.rate)
        kind, stop = tf2_web_republisher.msg.TFArray, threading.Event()
        name = f"~tf_repub_{next(self._numbers)}"
        publisher = self.node.advertise(name, kind, queue_size=_QUEUE, latch=True)
        wait_ns, alone_since = request.timeout.to_nsec(), self.node.clock.now()

        def send(transforms: Transforms) -> None:
            nonlocal alone_since
            now = self.node.clock.now()
            if publisher.has_subscribers:
                alone_since = now
            elif now - alone_since > wait_ns:
                stop.set()
                publisher.close()
                return
            if transforms:
                publisher.publish(kind(transforms=transforms))

        self._start(request, rate, send, stop, always=True)
        return tf2_web_republisher.srv.RepublishTFsResponse(topic_name=self.node.resolve(name))

    def _start(
        self,
        request: Any,
        rate: float,
        send: Callable[[Transforms], None],
        stop: threading.Event,
        *,
        always: bool = False,
    ) -> None:
        """Send changed transforms at a rate, in a thread; `always` also when there are none."""
        target = request.target_frame.removeprefix("/")
        limits = request.angular_thres, request.trans_thres
        pairs = [
            FramePair(each.removeprefix("/"), target, *limits) for each in request.source_frames
        ]

        def work() -> None:
            changed = self._changed(pairs)
            if changed or always:
                send(changed)

        threading.Thread(target=repeat, args=(self.node, rate, work, stop), daemon=True).start()

    def _changed(self, pairs: Sequence[FramePair]) -> Transforms:
        found: Transforms = []
        now = Time(nsecs=self.node.clock.now())
        for pair in pairs:
            transform = self._frames.find(pair.target, pair.source)
            if transform is not None and pair.take(transform):
                found.append(_message(pair, transform, now))
        return found


def _message(
    pair: FramePair, transform: StampedTransform, now: Time
) -> geometry_msgs.msg.TransformStamped:
    made = geometry_msgs.msg.TransformStamped(child_frame_id=pair.source)
    made.header.frame_id, made.header.stamp = pair.target, now
    place, turn = made.transform.translation, made.transform.rotation
    place.x, place.y, place.z = transform.translation
    turn.x, turn.y, turn.z, turn.w = transform.rotation
    return made
