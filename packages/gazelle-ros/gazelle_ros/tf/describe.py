"""A tree of frames as text: YAML for tools, dot for pictures; the forms are tf2's."""

from __future__ import annotations

from gazelle_ros.tf.cache import FrameCache
from gazelle_ros.tf.core import FrameTree

_SECOND = 1e-9
_SHORTEST = 0.0001


def _rate(cache: FrameCache) -> tuple[float, float, float, float]:
    """Return average rate [Hz], latest and oldest time [s], and the time between them [s]."""
    count, oldest, latest = cache.span()
    length = (latest - oldest) * _SECOND
    return count / max(length, _SHORTEST), latest * _SECOND, oldest * _SECOND, length


def as_yaml(tree: FrameTree) -> str:
    """Return parent, broadcaster and times of each frame, as YAML."""
    parts = []
    for name, authority, cache in tree.known():
        latest = cache.latest()
        if latest is None:
            continue
        rate, newest, oldest, length = _rate(cache)
        parts.append(
            f"{name}: \n"
            f"  parent: '{latest[1]}'\n"
            f"  broadcaster: '{authority}'\n"
            f"  rate: {rate:.3f}\n"
            f"  most_recent_transform: {newest:.3f}\n"
            f"  oldest_transform: {oldest:.3f}\n"
            f"  buffer_length: {length:.3f}\n"
        )
    return "".join(parts) or "{}"


def as_dot(tree: FrameTree, now: int | None = None) -> str:
    """Return the tree as a graph in the dot language.

    Args:
        tree: Its frames.
        now: The present [ns], to say how old data is; None to leave that out.
    """
    known = tree.known()
    if not known:
        return 'digraph G { "no tf data recieved" }'
    parents: dict[str, str] = {}
    lines = ["digraph G {\n"]
    for name, authority, cache in known:
        latest = cache.latest()
        if latest is None:
            continue
        parents[name] = latest[1]
        rate, newest, _, length = _rate(cache)
        age = "" if now is None else f"( {now * _SECOND - newest:.3f} sec old)"
        lines.append(
            f'"{latest[1]}" -> "{name}"[label="Broadcaster: {authority}\\n'
            f"Average rate: {rate:.3f} Hz\\n"
            f"Most recent transform: {newest:.3f} {age}\\n"
            f'Buffer length: {length:.3f} sec\\n"];\n'
        )
    if now is not None:
        roots = dict.fromkeys(p for p in parents.values() if p not in parents)
        lines += [_legend(root, now) for root in roots]
    return "".join([*lines, "}"])


def _legend(root: str, now: int) -> str:
    return (
        "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; "
        'label ="view_frames Result";\n'
        f'"Recorded at time: {now * _SECOND:.3f}"[ shape=plaintext ] ;\n }}->"{root}";\n'
    )
