"""Saved layouts of the page: fixed frame, displays, panels and camera."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from gazelle.description import Vector3
from gazelle.errors import Error, did_you_mean
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.display_list import DisplayList
from gazelle.viewer.graph.fitting import ViewFitter
from gazelle.viewer.graph.panels import PanelSet
from gazelle_ros.base import bounded_yaml
from gazelle_ros.base.writing import write_text

_NAME = re.compile(r"[\w-][\w .-]{0,60}")
_NONE = "choose ..."


class LayoutFiles:
    """Layouts of this user, one YAML file each.

    Args:
        folder: Of the files; ``gazelle/layouts`` in the user's folder of configurations if None.
    """

    def __init__(self, folder: Path | None = None) -> None:
        base = os.environ.get("XDG_CONFIG_HOME", "")
        home = Path(base) if Path(base).is_absolute() else Path("~/.config").expanduser()
        self.folder = folder or home / "gazelle" / "layouts"

    @property
    def names(self) -> list[str]:
        """Names of the layouts, sorted."""
        return sorted(file.stem for file in self.folder.glob("*.yaml"))

    def save(self, name: str, layout: Mapping[str, Any]) -> None:
        """Write a layout.

        Raises:
            Error: The name is none, or the file cannot be written.
        """
        if not _NAME.fullmatch(name):
            raise Error(f"'{name}' is not a name of a layout", hint="use letters, digits, - and _")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            write_text(self.folder / f"{name}.yaml", yaml.safe_dump(dict(layout), sort_keys=False))
        except OSError as error:
            raise Error(f"the layout '{name}' cannot be written: {error}") from error

    def load(self, name: str) -> dict[str, Any]:
        """Read a layout.

        Raises:
            Error: There is none of that name, or it is not valid YAML.
        """
        if name not in self.names:
            raise Error(f"there is no layout '{name}'", hint=did_you_mean(name, self.names))
        file = self.folder / f"{name}.yaml"
        try:
            found = bounded_yaml.safe_load(file.read_text(encoding="utf-8"))
        except (OSError, ValueError, yaml.YAMLError) as error:
            raise Error(f"the layout {file} cannot be read: {error}") from error
        if not isinstance(found, dict):
            raise Error(f"the layout {file} is not a mapping")
        return found


class LayoutControls:
    """Saves and loads layouts for users.

    Args:
        context: Of the page.
        displays: All displays.
        panels: All panels.
        fitter: Of the camera.
    """

    def __init__(
        self, context: GraphContext, displays: DisplayList, panels: PanelSet, fitter: ViewFitter
    ) -> None:
        self._context, self._displays, self._panels = context, displays, panels
        self._fitter = fitter
        self._files = LayoutFiles()
        gui = context.gui
        with gui.add_folder("Layout", expand_by_default=False):
            self._load: Any = gui.add_dropdown("Load", (_NONE, *self._files.names))
            self._name: Any = gui.add_text("Name", "")
            button = gui.add_button("Save")
        context.on_user_change(self._load, self._load_chosen)
        context.on_user_click(button, lambda: self.save(self._name.value))

    def save(self, name: str) -> None:
        """Save what the page shows now.

        Raises:
            Error: The name is none, or the file cannot be written.
        """
        layout: dict[str, Any] = {
            "fixed_frame": self._context.requested_frame,
            "displays": self._displays.settings,
            "panels": self._panels.settings,
        }
        for client in self._context.page.get_clients().values():
            camera = client.camera
            layout["camera"] = {
                "position": [float(each) for each in camera.position],
                "look_at": [float(each) for each in camera.look_at],
            }
            break
        self._files.save(name, layout)
        self._load.options = (_NONE, *self._files.names)

    def load(self, name: str) -> None:
        """Show the page as it was saved.

        Raises:
            Error: There is no such layout, or it cannot be read.
        """
        layout = self._files.load(name)
        self._context.requested_frame = str(layout.get("fixed_frame") or "").lstrip("/")
        self._displays.restore(_mapping(layout.get("displays")))
        self._panels.restore(_mapping(layout.get("panels")))
        camera = _mapping(layout.get("camera"))
        places = [_point(camera.get(key)) for key in ("position", "look_at")]
        if places[0] is not None and places[1] is not None:
            self._fitter.place(places[0], places[1])

    def _load_chosen(self) -> None:
        name = self._load.value
        if name != _NONE:
            self._load.value = _NONE
            self._name.value = name
            self.load(name)


def _point(value: Any) -> Vector3 | None:
    try:
        x, y, z = (float(each) for each in value)
    except (TypeError, ValueError):
        return None
    return x, y, z


def _mapping(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}
