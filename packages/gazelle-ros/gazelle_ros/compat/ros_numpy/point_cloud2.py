"""Point clouds: arrays of records, a field for each of the cloud's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.compat.ros_numpy.registry import converts_from_numpy, converts_to_numpy
from gazelle_ros.compat.sensor_msgs.point_cloud2 import PointCloud2, PointField, split_columns

DUMMY_FIELD_PREFIX = "__"
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
_CODES = {np.dtype(kind): code for code, kind in _KINDS.items()}


@converts_to_numpy(PointField, plural=True)
def fields_to_dtype(fields: Sequence[Any], point_step: int) -> np.dtype[np.void]:
    """Return the record type of a cloud's points."""
    kinds = [np.dtype((_KINDS[f.datatype], (f.count,) if f.count > 1 else ())) for f in fields]
    return np.dtype(
        {
            "names": [field.name for field in fields],
            "formats": kinds,
            "offsets": [field.offset for field in fields],
            "itemsize": point_step,
        }
    )


@converts_from_numpy(PointField, plural=True)
def dtype_to_fields(dtype: np.dtype[np.void]) -> list[Any]:
    """Return the ``PointField`` messages of a record type."""
    made = []
    for name in dtype.names or ():
        fields: Any = dtype.fields
        kind, offset = fields[name][:2]
        base, shape = kind.subdtype or (kind, ())
        made.append(PointField(name, offset, _CODES[base], int(np.prod(shape)) if shape else 1))
    return made


@converts_to_numpy(PointCloud2)
def pointcloud2_to_array(cloud_msg: Any, squeeze: bool = True) -> NDArray[np.void]:  # noqa: FBT001, FBT002  # ros_numpy's interface
    """Return the points: (width,) for one row on request, else (height, width)."""
    columns = split_columns(cloud_msg)
    kind = fields_to_dtype(cloud_msg.fields, cloud_msg.point_step)
    cloud = np.zeros((cloud_msg.height, cloud_msg.width), kind)
    if cloud.size:
        for name, column in columns.items():
            cloud[name] = column
    return cloud[0] if squeeze and cloud_msg.height == 1 else cloud


@converts_from_numpy(PointCloud2)
def array_to_pointcloud2(
    cloud_arr: NDArray[np.void], stamp: Any = None, frame_id: str | None = None
) -> Any:
    """Return the ``PointCloud2`` of records, (width,) or (height, width)."""
    rows = np.atleast_2d(cloud_arr)
    message = PointCloud2()
    if stamp is not None:
        message.header.stamp = stamp
    if frame_id is not None:
        message.header.frame_id = frame_id
    message.height, message.width = rows.shape
    message.fields = dtype_to_fields(rows.dtype)
    message.point_step = rows.dtype.itemsize
    message.row_step = message.point_step * message.width
    names = rows.dtype.names or ()
    message.is_dense = all(bool(np.isfinite(rows[name]).all()) for name in names)
    message.data = rows.tobytes()
    return message


def get_xyz_points(
    cloud_array: NDArray[np.void],
    remove_nans: bool = True,  # noqa: FBT001, FBT002  # ros_numpy's interface
    dtype: Any = float,
) -> NDArray[Any]:
    """Return the places of records, (..., 3), on request without those that are not finite."""
    if remove_nans:
        good = np.isfinite(cloud_array["x"])
        good &= np.isfinite(cloud_array["y"]) & np.isfinite(cloud_array["z"])
        cloud_array = cloud_array[good]
    return np.stack([cloud_array[axis].astype(dtype) for axis in "xyz"], axis=-1)


def pointcloud2_to_xyz_array(cloud_msg: Any, remove_nans: bool = True) -> NDArray[Any]:  # noqa: FBT001, FBT002  # ros_numpy's interface
    """Return the places of a cloud's points, (n, 3) [m]."""
    return get_xyz_points(pointcloud2_to_array(cloud_msg), remove_nans)


def split_rgb_field(cloud_arr: NDArray[np.void]) -> NDArray[np.void]:
    """Return records with ``r``, ``g`` and ``b`` in place of the packed ``rgb``."""
    packed = np.ascontiguousarray(cloud_arr["rgb"]).view(np.uint32)
    kept = [name for name in cloud_arr.dtype.names or () if name != "rgb"]
    fields: Any = cloud_arr.dtype.fields
    kind = [(name, fields[name][0]) for name in kept] + [(c, np.dtype("u1")) for c in "rgb"]
    made = np.zeros(cloud_arr.shape, kind)
    for name in kept:
        made[name] = cloud_arr[name]
    for shift, name in ((16, "r"), (8, "g"), (0, "b")):
        made[name] = packed >> shift & 255
    return made


def merge_rgb_fields(cloud_arr: NDArray[np.void]) -> NDArray[np.void]:
    """Return records with the packed ``rgb`` in place of ``r``, ``g`` and ``b``."""
    r, g, b = (np.asarray(cloud_arr[name], dtype=np.uint32) for name in "rgb")
    kept = [name for name in cloud_arr.dtype.names or () if name not in set("rgb")]
    fields: Any = cloud_arr.dtype.fields
    made = np.zeros(
        cloud_arr.shape, [*((name, fields[name][0]) for name in kept), ("rgb", np.dtype("f4"))]
    )
    for name in kept:
        made[name] = cloud_arr[name]
    made["rgb"] = np.ascontiguousarray(r << 16 | g << 8 | b).view(np.float32)
    return made
