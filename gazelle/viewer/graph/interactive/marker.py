"""One interactive marker: its pictures, and gizmos for the motions that it allows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.rotations import rotate
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.drawing import Drawing, pose_of
from gazelle.viewer.graph.markers import draw_marker
from gazelle.viewer.graph.styles import DisplayStyle
from gazelle_ros.msgs import geometry_msgs, std_msgs, visualization_msgs
from gazelle_ros.tf import TransformException

Control = visualization_msgs.msg.InteractiveMarkerControl
Feedback = visualization_msgs.msg.InteractiveMarkerFeedback

_MOVE_AXIS, _MOVE_PLANE, _ROTATE_AXIS, _MOVE_ROTATE = 3, 4, 5, 6
_MOVE_3D, _ROTATE_3D, _BOTH_3D = 7, 8, 9
_MENU, _BUTTON = 1, 2
_POSE_UPDATE, _MENU_SELECT, _CLICK, _DOWN, _UP = 1, 2, 3, 4, 5
_EVENTS = {"start": _DOWN, "update": _POSE_UPDATE, "end": _UP}

Axes = tuple[bool, bool, bool]


class PageMarker:
    """Shows an interactive marker, and reports what users do with it.

    Args:
        context: Of the page.
        root: Name of its node in the scene.
        message: The marker.
        send: Called with feedback.
    """

    def __init__(
        self, context: GraphContext, root: str, message: Any, send: Callable[[Feedback], None]
    ) -> None:
        self._context, self._message, self._send = context, message, send
        self._held = False
        scene = context.scene
        self._anchor = scene.add_frame(root, show_axes=False)
        self._body = scene.add_frame(f"{root}/body", show_axes=False)
        self._gizmos: dict[str, Any] = {}
        self._drawings = [
            self._draw(f"{root}/body/{number}", control)
            for number, control in enumerate(message.controls)
        ]
        moves, turns = allowed(message.controls)
        scale = float(message.scale) or 1.0
        if any(moves):
            self._add_gizmo(f"{root}/move", scale, moves, disable_rotations=True)
        for axis in np.flatnonzero(turns).tolist():
            # viser has a ring about an axis where both others are active.
            others = _axes(number != axis for number in range(3))
            self._add_gizmo(
                f"{root}/turn{axis}", scale, others, disable_axes=True, disable_sliders=True
            )
        if message.description:
            scene.add_label(f"{root}/body/name", message.description, position=(0.0, 0.0, scale))
        self.move(message.header, message.pose)

    @property
    def frame(self) -> str:
        """Frame of the marker's pose."""
        return str(self._message.header.frame_id).lstrip("/")

    def move(self, header: std_msgs.msg.Header, pose: geometry_msgs.msg.Pose) -> None:
        """Take a pose from the server, unless a user moves it at the moment."""
        if self._held:
            return
        self._message.header, self._message.pose = header, pose
        at, turned = pose_of(pose)
        for node in (self._body, *self._gizmos.values()):
            node.position, node.wxyz = at, turned

    def place(self, fixed: str, *, shown: bool) -> str:
        """Move it to its frame; returns why it is not shown, "" if it is."""
        if self.frame and self.frame != fixed:
            try:
                found = self._context.tree.lookup(fixed, self.frame)
            except TransformException:
                self._anchor.visible = False
                return f"no transform from {self.frame} to {fixed}"
            x, y, z, w = found.rotation
            self._anchor.position, self._anchor.wxyz = np.array(found.translation), (w, x, y, z)
        self._anchor.visible = shown
        return ""

    def remove(self) -> None:
        """Remove it from the page."""
        for drawing in self._drawings:
            drawing.clear()
        self._anchor.remove()

    def _draw(self, name: str, control: Control) -> Drawing:
        """Draw the pictures of a control; a click on one is reported."""
        self._context.scene.add_frame(name, show_axes=False)
        drawing = Drawing(self._context.page, name, control.name, DisplayStyle())
        for each in control.markers:
            draw_marker(drawing, each)
        if control.interaction_mode in {_MENU, _BUTTON}:
            for part in drawing.parts:
                if hasattr(part, "on_click"):
                    part.on_click(lambda event: self._clicked(control, event))
        return drawing

    def _add_gizmo(self, name: str, scale: float, axes: Axes, **options: Any) -> None:
        gizmo = self._context.scene.add_transform_controls(
            name, scale=scale, active_axes=axes, depth_test=False, **options
        )
        gizmo.on_update(self._dragged)
        self._gizmos[name] = gizmo

    async def _dragged(self, event: Any) -> None:
        """Move all of it with one gizmo, and report it."""
        moved = event.target
        position, turned = np.array(moved.position), np.array(moved.wxyz)
        for node in (self._body, *self._gizmos.values()):
            if node is not moved:
                node.position, node.wxyz = position, turned
        pose = self._message.pose
        pose.position.x, pose.position.y, pose.position.z = position.tolist()
        turn = pose.orientation
        turn.w, turn.x, turn.y, turn.z = turned.tolist()
        self._held = event.phase != "end"
        self._report(_EVENTS[event.phase])

    def _clicked(self, control: Control, event: Any) -> None:
        if control.interaction_mode == _BUTTON:
            self._report(_CLICK, control.name)
        elif self._message.menu_entries:
            self._offer_menu(control, event.client)

    def _offer_menu(self, control: Control, client: Any) -> None:
        """Show the marker's menu as buttons."""
        parents = {each.parent_id for each in self._message.menu_entries}
        with client.gui.add_modal(self._message.description or self._message.name) as modal:
            for entry in self._message.menu_entries:
                if entry.id in parents:
                    client.gui.add_markdown(f"**{entry.title}**")
                    continue
                button = client.gui.add_button(entry.title)

                def choose(_event: Any, chosen: int = entry.id) -> None:
                    modal.close()
                    self._report(_MENU_SELECT, control.name, chosen)

                button.on_click(choose)
            client.gui.add_button("Cancel", color="gray").on_click(lambda _event: modal.close())

    def _report(self, event: int, control: str = "", entry: int = 0) -> None:
        header = std_msgs.msg.Header(
            stamp=self._context.stamp(), frame_id=self._message.header.frame_id
        )
        self._send(Feedback(
            header=header, client_id=self._context.node.name, marker_name=self._message.name,
            control_name=control, event_type=event, pose=self._message.pose, menu_entry_id=entry,
        ))  # fmt: skip


def allowed(controls: Sequence[Control]) -> tuple[Axes, Axes]:
    """Return the axes along which controls move a marker, and those about which they turn it."""
    moves, turns = np.zeros(3, np.bool_), np.zeros(3, np.bool_)
    for control in controls:
        mode = control.interaction_mode
        axis = _axis(control)
        if mode in {_MOVE_3D, _BOTH_3D}:
            moves[:] = True
        if mode in {_ROTATE_3D, _BOTH_3D}:
            turns[:] = True
        if mode == _MOVE_AXIS:
            moves[axis] = True
        if mode in {_MOVE_PLANE, _MOVE_ROTATE}:
            moves[[each for each in range(3) if each != axis]] = True
        if mode in {_ROTATE_AXIS, _MOVE_ROTATE}:
            turns[axis] = True
    return _axes(moves), _axes(turns)


def _axes(flags: Any) -> Axes:
    x, y, z = (bool(each) for each in flags)
    return x, y, z


def _axis(control: Control) -> int:
    """Return the number of the axis that is nearest to the control's."""
    _, turned = pose_of(geometry_msgs.msg.Pose(orientation=control.orientation))
    along: Floats = rotate(np.roll(turned, -1)[None], np.array([[1.0, 0.0, 0.0]]))[0]
    return int(np.argmax(np.abs(along)))
