"""The rows of constraints on the device, and what laws of contacts do to them.

A row has its Jacobian (dense, or the columns that ``column_index`` lists), its velocity, and the
acceleration that it is to have (``reference``). ``before`` has the joints' accelerations of the step before.
"""

import warp as wp

wp.set_module_options({"enable_backward": False})


@wp.struct
class ConstraintRows:
    """Arrays of all rows, with a leading axis over worlds."""

    sparse: int
    nv: int
    jacobian: wp.array3d[float]
    count: wp.array2d[int]
    address: wp.array2d[int]
    column_index: wp.array3d[int]
    velocity: wp.array2d[float]
    reference: wp.array2d[float]
    before: wp.array2d[float]


@wp.func
def row_width(rows: ConstraintRows, world: int, row: int) -> int:
    """Return the number of entries in the Jacobian of a row."""
    if rows.sparse != 0:
        return rows.count[world, row]
    return rows.nv


@wp.func
def row_dof(rows: ConstraintRows, world: int, row: int, place: int) -> int:
    """Return the velocity index of an entry in a row's Jacobian."""
    if rows.sparse != 0:
        return rows.column_index[world, 0, rows.address[world, row] + place]
    return place


@wp.func
def row_entry(rows: ConstraintRows, world: int, row: int, place: int) -> float:
    """Return a number of a row's Jacobian."""
    if rows.sparse != 0:
        return rows.jacobian[world, 0, rows.address[world, row] + place]
    return rows.jacobian[world, row, place]


@wp.func
def set_row_entry(rows: ConstraintRows, world: int, row: int, place: int, value: float) -> None:
    """Write a number of a row's Jacobian."""
    if rows.sparse != 0:
        rows.jacobian[world, 0, rows.address[world, row] + place] = value
    else:
        rows.jacobian[world, row, place] = value


@wp.func
def last_acceleration(rows: ConstraintRows, world: int, row: int) -> float:
    """Return the acceleration of the step before along a row."""
    found = float(0.0)
    for place in range(row_width(rows, world, row)):
        dof = row_dof(rows, world, row, place)
        found += row_entry(rows, world, row, place) * rows.before[world, dof]
    return found


@wp.func
def turn_rows(
    rows: ConstraintRows, world: int, first: int, second: int, one: float, two: float
) -> None:
    """Turn two directions of a cone by the cosine ``one`` and the sine ``two``."""
    _turn_pair(rows.velocity, world, first, second, one, two)
    _turn_pair(rows.reference, world, first, second, one, two)
    for place in range(row_width(rows, world, first)):
        a = row_entry(rows, world, first, place)
        b = row_entry(rows, world, second, place)
        set_row_entry(rows, world, first, place, one * a + two * b)
        set_row_entry(rows, world, second, place, one * b - two * a)


@wp.func
def _turn_pair(
    array: wp.array2d[float], world: int, first: int, second: int, one: float, two: float
) -> None:
    a = float(array[world, first])
    b = float(array[world, second])
    array[world, first] = one * a + two * b
    array[world, second] = one * b - two * a


@wp.func
def turn_edges(edges: wp.vec4, one: float, two: float) -> wp.vec4:
    """Turn the numbers of a pyramid's edges, n + t1, n - t1, n + t2 and n - t2."""
    normal = 0.5 * (edges[0] + edges[1])
    a = 0.5 * (edges[0] - edges[1])
    b = 0.5 * (edges[2] - edges[3])
    along = one * a + two * b
    across = one * b - two * a
    return wp.vec4(normal + along, normal - along, normal + across, normal - across)


@wp.func
def turn_pyramid(rows: ConstraintRows, world: int, row: wp.vec4i, one: float, two: float) -> None:
    """Turn a pyramid's first direction, with all data of its four edges."""
    turned = turn_edges(_four(rows.velocity, world, row), one, two)
    reference = turn_edges(_four(rows.reference, world, row), one, two)
    for edge in range(4):
        rows.velocity[world, row[edge]] = turned[edge]
        rows.reference[world, row[edge]] = reference[edge]
    for place in range(row_width(rows, world, row[0])):
        numbers = wp.vec4(
            row_entry(rows, world, row[0], place),
            row_entry(rows, world, row[1], place),
            row_entry(rows, world, row[2], place),
            row_entry(rows, world, row[3], place),
        )
        numbers = turn_edges(numbers, one, two)
        for edge in range(4):
            set_row_entry(rows, world, row[edge], place, numbers[edge])


@wp.func
def _four(array: wp.array2d[float], world: int, row: wp.vec4i) -> wp.vec4:
    return wp.vec4(
        array[world, row[0]], array[world, row[1]], array[world, row[2]], array[world, row[3]]
    )
