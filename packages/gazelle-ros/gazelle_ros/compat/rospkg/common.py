"""Names of files, and what is raised for packages that are not there."""

from __future__ import annotations

MANIFEST_FILE = "manifest.xml"
PACKAGE_FILE = "package.xml"
STACK_FILE = "stack.xml"


class ResourceNotFound(Exception):  # noqa: N818  # rospkg's names
    """There is no such package.

    Args:
        msg: Its name, or a text.
        ros_paths: Searched places.
    """

    def __init__(self, msg: str, ros_paths: list[str] | None = None) -> None:
        super().__init__(msg)
        self.ros_paths = ros_paths

    def __str__(self) -> str:
        text = str(self.args[0])
        for place, path in enumerate(self.ros_paths or ()):
            text += f"\nROS path [{place}]={path}"
        return text
