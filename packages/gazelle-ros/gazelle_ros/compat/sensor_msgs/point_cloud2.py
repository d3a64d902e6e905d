"""Reads and makes ``PointCloud2`` messages, as sensor_msgs.point_cloud2 does.

Values come in the order of their offsets in the cloud, whatever the order of the wanted names; a field
with a count of more than one gives as many values.
"""

from __future__ import annotations

import itertools
from collections import namedtuple
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.msgs import sensor_msgs, std_msgs

PointField = sensor_msgs.msg.PointField
PointCloud2 = sensor_msgs.msg.PointCloud2

_KINDS = {
    PointField.INT8: "i1",
    PointField.UINT8: "u1",
    PointField.INT16: "i2",
    PointField.UINT16: "u2",
    PointField.INT32: "i4",
    PointField.UINT32: "u4",
    PointField.FLOAT32: "f4",
    PointField.FLOAT64: "f8",
}


def read_points(
    cloud: sensor_msgs.msg.PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,  # noqa: FBT001, FBT002  # sensor_msgs's interface
    uvs: Iterable[Sequence[int]] = (),
) -> Iterator[tuple[Any, ...]]:
    """Yield the points of a cloud, one tuple each.

    Args:
        cloud: The ``PointCloud2``.
        field_names: Fields, by default all.
        skip_nans: Leave out points with a value that is not a number.
        uvs: Only the points in these columns and rows (column first).

    Raises:
        TypeError: `cloud` is no ``PointCloud2``.
        ValueError: It has no such field, or less data than its sizes say.
    """
    columns = _columns(cloud, field_names)
    chosen = list(uvs)
    if chosen:
        across, down = np.array(chosen, dtype=np.intp).T
        columns = [column[down, across] for column in columns]
    flat = [column.ravel() for column in columns]
    if skip_nans and flat:
        good = ~np.any([np.isnan(column) for column in flat], axis=0)
        flat = [column[good] for column in flat]
    return zip(*(column.tolist() for column in flat), strict=True)


def read_points_list(
    cloud: sensor_msgs.msg.PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,  # noqa: FBT001, FBT002  # sensor_msgs's interface
    uvs: Iterable[Sequence[int]] = (),
) -> list[Any]:
    """Read the points of a cloud as named tuples ``Point``; see `read_points`."""
    if field_names is None:
        field_names = [field.name for field in cloud.fields]
    point = namedtuple("Point", field_names)  # type: ignore[misc]  # noqa: PYI024  # names come with the cloud
    return [point._make(each) for each in read_points(cloud, field_names, skip_nans, uvs)]


def create_cloud(
    header: std_msgs.msg.Header, fields: Sequence[Any], points: Any
) -> sensor_msgs.msg.PointCloud2:
    """Create a ``PointCloud2`` of one row.

    Args:
        header: Its header.
        fields: Its ``PointField`` messages.
        points: One sequence of values a point, in the order of the offsets.

    Raises:
        ValueError: A point has another number of values than the fields.
    """
    parts = _parts(fields, big_endian=False)
    size = max((offset + np.dtype(kind).itemsize for _, offset, kind in parts), default=0)
    layout = np.dtype(
        {
            "names": [f"f{place}" for place in range(len(parts))],
            "formats": [kind for _, _, kind in parts],
            "offsets": [offset for _, offset, _ in parts],
            "itemsize": size,
        }
    )
    data = np.zeros(len(points), layout)
    if isinstance(points, np.ndarray) and points.dtype.names is None:
        points = points.reshape(len(points), -1) if len(points) else points.reshape(0, len(parts))
        if points.shape[1] != len(parts):
            raise ValueError(f"points have {points.shape[1]} values, fields {len(parts)}")
        for place, name in enumerate(layout.names or ()):
            data[name] = points[:, place]
    elif len(points):
        data[:] = [tuple(point) for point in points]
    return PointCloud2(
        header=header,
        height=1,
        width=len(data),
        is_dense=False,
        is_bigendian=False,
        fields=list(fields),
        point_step=size,
        row_step=size * len(data),
        data=data.tobytes(),
    )


def create_cloud_xyz32(header: std_msgs.msg.Header, points: Any) -> sensor_msgs.msg.PointCloud2:
    """Create a ``PointCloud2`` of points with x, y and z [m] in single precision."""
    fields = [
        PointField(name, 4 * place, PointField.FLOAT32, 1) for place, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points)


def _parts(
    fields: Sequence[Any], *, big_endian: bool, names: Sequence[str] | None = None
) -> list[tuple[str, int, str]]:
    """Return name, offset and numpy type of every single value of a point, by offset."""
    found = []
    for field in sorted(fields, key=lambda each: each.offset):
        if names is not None and field.name not in names:
            continue
        kind = _KINDS.get(field.datatype)
        if kind is None:
            raise ValueError(f"the field '{field.name}' has the unknown type {field.datatype}")
        size = np.dtype(kind).itemsize
        for number in range(max(1, field.count)):
            order = ">" if big_endian else "<"
            found.append((field.name, field.offset + number * size, order + kind))
    return found


def _columns(cloud: sensor_msgs.msg.PointCloud2, names: Sequence[str] | None) -> list[NDArray[Any]]:
    """Return the values of the wanted fields, each (height, width).

    Views of the message's data.
    """
    if getattr(cloud, "_type", None) != PointCloud2._type:
        raise TypeError(f"this is no sensor_msgs/PointCloud2: {type(cloud).__name__}")
    known = {field.name for field in cloud.fields}
    missing = [name for name in names or () if name not in known]
    if missing:
        raise ValueError(f"the cloud has no field '{missing[0]}'; it has {sorted(known)}")
    parts = _parts(cloud.fields, big_endian=bool(cloud.is_bigendian), names=names)
    data = np.frombuffer(bytes(cloud.data), np.uint8)
    rows, across = cloud.height, cloud.width
    if rows and across:
        end = max((offset + np.dtype(kind).itemsize for _, offset, kind in parts), default=0)
        if (rows - 1) * cloud.row_step + (across - 1) * cloud.point_step + end > data.size:
            raise ValueError(f"the cloud's data of {data.size} bytes is too short for its sizes")
    strides = (cloud.row_step, cloud.point_step)
    shape = (rows, across) if rows and across else (0, 0)
    return [
        np.ndarray(shape, kind, data, offset if data.size else 0, strides)
        for _, offset, kind in parts
    ]


def split_columns(cloud: sensor_msgs.msg.PointCloud2) -> dict[str, NDArray[Any]]:
    """Return the fields of a cloud as arrays.

    Shapes are (height, width) or, with a count, (height, width, count).
    """
    columns = _columns(cloud, None)
    names = [name for name, _, _ in _parts(cloud.fields, big_endian=bool(cloud.is_bigendian))]
    pairs = itertools.groupby(zip(names, columns, strict=True), key=lambda pair: pair[0])
    found = {name: [column for _, column in group] for name, group in pairs}
    return {name: g[0] if len(g) == 1 else np.stack(g, axis=-1) for name, g in found.items()}
