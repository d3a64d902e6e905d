"""All displays of the page: topics of the graph that can be shown, and its robots."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import Error
from gazelle.viewer.graph.adding import DisplayAdder
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.display import KINDS, TopicDisplay
from gazelle.viewer.graph.frames import FrameAxes
from gazelle.viewer.graph.robots import DescribedRobot

_FRAMES, _NEW = "frames", "new topics"  # keys of a layout; topics begin with a slash


class DisplayList:
    """Displays of all topics with a type that is shown, and of all robot descriptions.

    Args:
        context: Of the page.

    Attributes:
        topics: Displays by topic.
        robots: By the parameters of their descriptions.
    """

    def __init__(self, context: GraphContext) -> None:
        self._context = context
        self.topics: dict[str, TopicDisplay] = {}
        self.robots = context.robots
        self._switches: dict[str, Any] = {}  # of robots
        self._refused: dict[str, tuple[str, str]] = {}
        self._wanted: dict[str, Any] = {}
        self._removed: set[str] = set()
        self._requests: deque[Callable[[], None]] = deque()  # of users, for the page's thread
        self._count = 0
        self._folder = context.gui.add_folder("Displays")
        with self._folder:
            self._frames = FrameAxes(context)
            self._new: Any = context.gui.add_checkbox(
                "New topics",
                initial_value=True,
                hint="Shows each topic that begins to be published",
            )
            self._adder = DisplayAdder(context, KINDS, self.add)

    @property
    def faults(self) -> list[str]:
        """Faults of displays and robots, each with its name."""
        context = self._context
        return [
            *(fault for _, fault in self._refused.values()),
            *(f"{name}: {each.status.text}" for name, each in self.topics.items() if each.status.fault),
            *(
                f"{name}: no transform from any of its links to {context.fixed}, so it is not shown"
                for name, robot in self.robots.items()
                if not robot.placed
            ),
        ]  # fmt: skip

    @property
    def _all(self) -> list[TopicDisplay | DescribedRobot]:
        return [*self.topics.values(), *self.robots.values()]

    @property
    def shown_count(self) -> int:
        """Number of displays and robots that show something."""
        return sum(each.extent is not None for each in self._all)

    @property
    def extent(self) -> Floats | None:
        """Lowest and highest corner of all that is shown [m], shape (2, 3); None without any."""
        boxes = [each.extent for each in self._all]
        known = np.array([box for box in boxes if box is not None])
        if not len(known):
            return None
        return np.array([known[:, 0].min(axis=0), known[:, 1].max(axis=0)])

    @property
    def settings(self) -> dict[str, dict[str, Any] | None]:
        """Settings of the displays, for a saved layout; None for a topic whose display was removed."""
        general = {_FRAMES: {"shown": self._frames.box.value}, _NEW: {"shown": self._new.value}}
        robots = {name: {"shown": box.value} for name, box in self._switches.items()}
        removed = dict.fromkeys(sorted(self._removed))
        return (
            general
            | robots
            | removed
            | {topic: each.settings for topic, each in self.topics.items()}
        )

    def restore(self, settings: Mapping[str, Any]) -> None:
        """Take the settings of a saved layout, those of topics that are not there yet later."""
        self._wanted = dict(settings)
        frames = self._wanted.pop(_FRAMES, None)
        self._frames.box.value = isinstance(frames, dict) and frames.get("shown") is True
        new = self._wanted.pop(_NEW, None)
        self._new.value = not (isinstance(new, dict) and new.get("shown") is False)
        self._removed = {topic for topic, each in self._wanted.items() if each is None}
        for topic in tuple(self.topics):
            if topic in self._removed:
                self.remove(topic)
            self._restore(topic)
        for name in tuple(self._switches):
            self._restore_robot(name)
        for topic, each in tuple(self._wanted.items()):
            kind = each.get("type") if isinstance(each, dict) else None
            if kind in KINDS and topic not in self.topics:
                self.add(topic, kind)

    def add(self, topic: str, kind: str) -> None:
        """Show a topic with the next picture, whether it is published or not; called by any thread."""
        self._requests.append(lambda: self._add(topic, kind))

    def remove(self, topic: str) -> None:
        """Remove a display with the next picture, until it is added by hand."""
        self._requests.append(lambda: self._remove(topic))

    def discover(self) -> None:
        """Show topics and robots that are new, and update every status."""
        node = self._context.node
        published, _, _ = node.master.system_state()
        types = dict(node.master.topic_types())
        others = {
            topic: len(nodes) for topic, nodes in published.items() if set(nodes) != {node.name}
        }
        for topic in others if self._new.value else ():
            if types.get(topic) in KINDS and topic not in {*self.topics, *self._removed}:
                self._add(topic, types[topic])
        self._adder.offer({
            topic: kind
            for topic, kind in types.items()
            if topic in others and kind in KINDS and topic not in self.topics
        })  # fmt: skip
        described = [
            name for name in node.param_names() if name.rpartition("/")[2] == "robot_description"
        ]
        for name in {*self.robots, *self._refused} - set(described):
            self._forget(name)
            self._switches.pop(name).remove()
        for name in described:
            self._read_description(name)
        for topic, display in self.topics.items():
            publishers = others.get(topic, 0)
            display.report(types.get(topic, "") if publishers else "", publishers)

    @property
    def points(self) -> Floats:
        """Points of scans and clouds that are shown, in the fixed frame [m], shape (n, 3)."""
        return np.vstack([np.zeros((0, 3)), *(each.points for each in self.topics.values())])

    def pause(self) -> None:
        """Receive nothing until the next ``draw``."""
        for display in self.topics.values():
            display.pause()

    def draw(self) -> None:
        """Draw new messages at their places."""
        while self._requests:
            self._requests.popleft()()
        fixed = self._context.fixed
        for display in self.topics.values():
            display.draw()
        self._frames.draw(fixed)
        for robot in self.robots.values():
            robot.show(self._context.tree, fixed)
        for display in self.topics.values():
            display.place(fixed, self.robots)

    def _add(self, topic: str, kind: str) -> None:
        self._removed.discard(topic)
        if topic in self.topics:
            return
        with self._folder:
            self.topics[topic] = TopicDisplay(
                self._context, topic, kind, lambda: self.remove(topic)
            )
        self._restore(topic)

    def _remove(self, topic: str) -> None:
        self._removed.add(topic)
        if topic in self.topics:
            self.topics.pop(topic).remove()

    def _restore(self, topic: str) -> None:
        saved = self._wanted.pop(topic, None)
        if isinstance(saved, dict):
            self.topics[topic].restore(saved)

    def _forget(self, name: str) -> None:
        """Remove the robot of a parameter, or its error."""
        self._refused.pop(name, None)
        if name in self.robots:
            self.robots.pop(name).remove()

    def _read_description(self, name: str) -> None:
        """Read the robot of a robot_description parameter, if it is new or has changed."""
        node = self._context.node
        text = str(node.get_param(name, ""))
        known = self.robots.get(name)
        if text in (None if known is None else known.text, self._refused.get(name, ("",))[0]):
            return
        self._forget(name)
        if name not in self._switches:
            label = f"Robot {name.rpartition('/')[0]}".rstrip()
            with self._folder:
                box = self._context.gui.add_checkbox(label, initial_value=True, hint=name)
            box.on_update(lambda _event: self._switch_robot(name))
            self._switches[name] = box
            self._restore_robot(name)
        prefix = str(node.get_param(f"{name.rpartition('/')[0]}/tf_prefix", "")).strip("/")
        self._count += 1
        root = f"/robots/{self._count}"
        try:
            self.robots[name] = robot = DescribedRobot(
                self._context.scene, root, text, f"{prefix}/" if prefix else ""
            )
            self._switch_robot(name)
            robot.show(self._context.tree, self._context.fixed)
        except Error as error:
            self._refused[name] = text, f"{name}: {error}"

    def _switch_robot(self, name: str) -> None:
        """Show or hide a robot, as its switch is."""
        if name in self.robots:
            self.robots[name].shown = self._switches[name].value

    def _restore_robot(self, name: str) -> None:
        saved = self._wanted.pop(name, None)
        if isinstance(saved, dict):
            self._switches[name].value = saved.get("shown") is not False
