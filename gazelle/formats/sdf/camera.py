"""``<camera>`` of a sensor."""

from __future__ import annotations

from gazelle.description import Camera, Parameters
from gazelle.formats import values
from gazelle.formats.sdf.leftover import Pattern
from gazelle.formats.sdf.noise import read_noise
from gazelle.formats.sdf.pose import read_pose

_DISTORTION = ("k1", "k2", "k3", "p1", "p2")

CAMERA: Pattern = {
    "@name": None,
    "pose": None,
    "horizontal_fov": None,
    "image": dict.fromkeys(("width", "height", "format")),
    "clip": dict.fromkeys(("near", "far")),
    "depth_camera": {"clip": dict.fromkeys(("near", "far"))},
    "noise": None,
    "distortion": dict.fromkeys((*_DISTORTION, "center")),
    "lens": None,
}
"""Pattern of the elements that ``read_camera`` reads."""


def read_camera(node: Parameters) -> Camera:
    """Read one camera; defaults are SDF 1.7's."""
    k1, k2, k3, p1, p2 = (values.real(node, f"distortion/{tag}", 0.0) for tag in _DISTORTION)
    center = node.find("distortion/center")
    cx, cy = (0.5, 0.5)
    if center is not None and center.text:
        cx, cy = values.parse_reals(center, center.text, "<center>", 2)
    return Camera(
        name=node.attributes.get("name", ""),
        pose=read_pose(node.find("pose")),
        horizontal_fov=values.real(node, "horizontal_fov", 1.047),
        width=_pixels(node, "image/width", 320),
        height=_pixels(node, "image/height", 240),
        format=values.word(node, "image/format", "R8G8B8"),
        near=values.real(node, "clip/near", 0.1),
        far=values.limit(node, "clip/far", 100.0),
        depth_near=_optional(node, "depth_camera/clip/near"),
        depth_far=_optional(node, "depth_camera/clip/far"),
        noise=read_noise(node.find("noise"), "gaussian"),
        distortion=(k1, k2, k3, p1, p2),
        distortion_center=(cx, cy),
        lens=node.find("lens"),
    )


def _pixels(node: Parameters, path: str, default: int) -> int:
    count = values.whole(node, path, default)
    if count < 0:
        raise values.fail(node.find(path) or node, f"<{path}> must not be negative, found {count}")
    return count


def _optional(node: Parameters, path: str) -> float | None:
    child = node.find(path)
    return None if child is None or not child.text else values.limit(node, path, 0.0)
