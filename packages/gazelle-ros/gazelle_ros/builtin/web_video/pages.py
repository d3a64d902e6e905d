"""Pages of ``web_video_server``: a list of the streams, and one with a stream."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from urllib.parse import quote

_CAMERA = "camera_info"


def stream_list(images: Sequence[str], cameras: Iterable[str]) -> str:
    """Return the page of all streams, those of a camera below its namespace.

    Args:
        images: Topics of images.
        cameras: Topics of ``CameraInfo``.
    """
    left = list(images)
    groups = []
    for camera in sorted(cameras):
        if camera.endswith(f"/{_CAMERA}"):
            base = camera.removesuffix(_CAMERA)
            own = [topic for topic in left if topic.startswith(base)]
            left = [topic for topic in left if topic not in own]
            items = "".join(_item(topic, topic.removeprefix(base)) for topic in own)
            groups.append(f"<li>{escape(base)}<ul>{items}</ul></li>")
    others = "".join(_item(topic, topic) for topic in left)
    return _page(
        "ROS Image Topic List",
        f"<h1>Available ROS Image Topics:</h1><ul>{''.join(groups)}</ul><ul>{others}</ul>",
    )


def viewer(topic: str, query: str) -> str:
    """Return the page that shows a stream.

    Args:
        topic: Of the images.
        query: Query of the stream's address.
    """
    source = escape(f"/stream?{query}", quote=True)
    return _page(topic, f'<h1>{escape(topic)}</h1><img src="{source}">')


def _item(topic: str, name: str) -> str:
    at = escape(quote(topic), quote=True)
    return (
        f'<li><a href="/stream_viewer?topic={at}">{escape(name)}</a> '
        f'(<a href="/stream?topic={at}">Stream</a>) '
        f'(<a href="/snapshot?topic={at}">Snapshot</a>)</li>'
    )


def _page(title: str, body: str) -> str:
    return f"<html><head><title>{escape(title)}</title></head><body>{body}</body></html>"
