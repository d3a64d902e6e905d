"""Floor plans of bundled worlds: what a horizontal ray would meet, worked out from the XML alone."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

from lxml import etree

from gazelle import assets


@dataclass(frozen=True)
class Shape:
    """A box or cylinder as seen from above, with the heights it spans."""

    x: float
    y: float
    yaw: float
    half: tuple[float, float]
    radius: float
    low: float
    high: float
    static: bool

    def distance(self, x, y, angle):
        """Return the distance along a ray from (x, y) [m], or infinity; 0 from inside."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        px, py = x - self.x, y - self.y
        start = (cos * px + sin * py, cos * py - sin * px)
        way = (math.cos(angle - self.yaw), math.sin(angle - self.yaw))
        return self._circle(start, way) if self.radius else self._box(start, way)

    def _circle(self, start, way):
        middle = -(start[0] * way[0] + start[1] * way[1])
        aside = self.radius**2 - (start[0] ** 2 + start[1] ** 2 - middle**2)
        if aside < 0 or middle + math.sqrt(aside) < 0:
            return math.inf
        return max(0.0, middle - math.sqrt(aside))

    def _box(self, start, way):
        near, far = 0.0, math.inf
        for at, along, half in zip(start, way, self.half, strict=True):
            if abs(along) < 1e-12:
                if abs(at) > half:
                    return math.inf
                continue
            ends = sorted(((-half - at) / along, (half - at) / along))
            near, far = max(near, ends[0]), min(far, ends[1])
        return near if near <= far else math.inf


def pose(element):
    text = element.findtext("pose", "0 0 0 0 0 0")
    return tuple(float(word) for word in text.split())


def root(path):
    return etree.parse(str(path)).getroot()


def models(world):
    """Return each model of a world as (name, pose, element), includes followed, in file order."""
    found = []
    for child in root(assets.world(world)).find("world"):
        if child.tag == "model":
            found.append((child.get("name"), pose(child), child))
        elif child.tag == "include":
            uri = child.findtext("uri").removeprefix("model://")
            model = root(assets.models()[uri]).find("model")
            if model is not None:
                where = pose(child) if child.find("pose") is not None else pose(model)
                found.append((child.findtext("name") or model.get("name"), where, model))
    return found


@functools.cache
def shapes(world):
    """Return every box and cylinder that a robot can collide with."""
    return [
        shape(where, pose(link), collision, static=model.findtext("static") == "true")
        for _, where, model in models(world)
        for link in model.findall("link")
        for collision in link.findall("collision")
        if collision.find("geometry/plane") is None
    ]


def shape(*parts, static):
    *poses, collision = parts
    x = y = z = yaw = 0.0
    for px, py, pz, roll, pitch, turn in (*poses, pose(collision)):
        assert roll == pitch == 0
        x, y = (
            x + math.cos(yaw) * px - math.sin(yaw) * py,
            y + math.sin(yaw) * px + math.cos(yaw) * py,
        )
        z, yaw = z + pz, yaw + turn
    size = collision.findtext("geometry/box/size")
    if size:
        sx, sy, height = (float(word) for word in size.split())
        half, radius = (sx / 2, sy / 2), 0.0
    else:
        radius = float(collision.findtext("geometry/cylinder/radius"))
        height = float(collision.findtext("geometry/cylinder/length"))
        half = (0.0, 0.0)
    return Shape(x, y, yaw, half, radius, z - height / 2, z + height / 2, static)


def range_at(world, angle, *, x=0.0, y=0.0, height=0.182, only_static=True):
    """Return the range of an ideal lidar at a height [m]; infinity without a hit."""
    return min(
        (
            each.distance(x, y, angle)
            for each in shapes(world)
            if each.low <= height <= each.high and (each.static or not only_static)
        ),
        default=math.inf,
    )
