"""Writer of SDF: one function per element, the counterpart of the readers."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import Model, Parameters, World
from gazelle.formats.write.element import element
from gazelle.formats.write.sdf.model import write_model
from gazelle.formats.write.sdf.world import write_world
from gazelle.formats.write.writing import Writing

__all__ = ["write_sdf"]

_OLDEST = (1, 7)
# the version of SDF with the first such element without which a file makes no sense: others, such
# as <mimic>, are read by programs that know them and ignored by others
_SINCE = {"capsule": (1, 8), "ellipsoid": (1, 8), "cone": (1, 12)}
_WORLD_JOINTS = (1, 10)


def write_sdf(content: World | Model, writing: Writing) -> Parameters:
    """Write the root element, of the oldest version since 1.7 that can express all of it.

    Older programs read older versions only, so the oldest sufficient one is written.
    """
    body = (
        write_world(content, writing)
        if isinstance(content, World)
        else write_model(content, writing)
    )
    major, minor = max(_versions(body))
    return element("sdf", body, version=f"{major}.{minor}")


def _versions(body: Parameters) -> Iterator[tuple[int, int]]:
    yield _OLDEST
    if body.tag == "world" and "joint" in body:
        yield _WORLD_JOINTS
    waiting = [body]
    while waiting:
        node = waiting.pop()
        if node.tag in _SINCE:
            yield _SINCE[node.tag]
        waiting.extend(node.children)
