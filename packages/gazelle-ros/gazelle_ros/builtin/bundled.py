"""The ROS packages among the data that comes with Gazelle: every folder there with a manifest.

Programs of theirs that Gazelle runs itself stand in the manifest, one a line::

    <export>
      <gazelle>
        <node type="gzserver" main="module:function"/>
        <node type="gazebo" main="module:function" process="gzserver"/>
        <nodelet class="Filter" make="module:function"/>
      </gazelle>
    </export>

``process`` is what the process is called, where that is not the type. The modules may be of rooms
that this one knows nothing of; they are imported when the node runs.
"""

from __future__ import annotations

import functools
import xml.etree.ElementTree as ET
from pathlib import Path

from gazelle_ros.base.bundled_packages import bundled_folders
from gazelle_ros.builtin.package import BuiltinPackage


@functools.cache
def folders() -> dict[str, Path]:
    """Return the folders of the packages by name."""
    return bundled_folders()


@functools.cache
def package(name: str) -> BuiltinPackage | None:
    """Return the package of a name, or None."""
    folder = folders().get(name)
    if folder is None:
        return None
    manifest = ET.parse(folder / "package.xml")  # noqa: S314  # a file of our own
    nodes = manifest.findall("export/gazelle/node")
    return BuiltinPackage(
        name,
        {node.attrib["type"]: node.attrib["main"] for node in nodes},
        {
            each.attrib["class"]: each.attrib["make"]
            for each in manifest.findall("export/gazelle/nodelet")
        },
        folder,
        process_names={
            node.attrib["type"]: node.attrib["process"]
            for node in nodes
            if "process" in node.attrib
        },
    )
