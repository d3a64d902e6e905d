"""Contacts that slide do not part: ``contact_laws.sliding_friction`` on the device; see its source there."""

import warp as wp

from gazelle.engines.mujoco.warp.constraint_rows import (
    ConstraintRows,
    last_acceleration,
    turn_pyramid,
)
from gazelle.engines.mujoco.warp.contact_data import ContactLaws, ContactList

wp.set_module_options({"enable_backward": False})

# As in ``contact_laws.sliding_friction``: slips and creeps [m/s], the share of creep, the most friction, what makes an
# impact in weights and in free fall [m/s²], and the most that errors are damped.
LEAST_SLIP = wp.constant(1.0e-4)
LEAST_CREEP = wp.constant(1.0e-6)
CREEP = wp.constant(0.25)
MOST_FRICTION = wp.constant(5.0)
IMPACT = wp.constant(4.0)
DAMPED = wp.constant(0.25)


@wp.func
def stay_down(rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int) -> None:
    """Set a sliding contact's normal velocity to that of one that holds."""
    if contacts.dim[contact] >= 3:
        if laws.cone != 0:
            _on_a_cone(rows, contacts, laws, contact)
        elif contacts.friction[contact][0] > 0.0:
            _on_a_pyramid(rows, contacts, laws, contact)


@wp.func
def _on_a_cone(
    rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int
) -> None:
    world = contacts.world[contact]
    friction = contacts.friction[contact]
    first = contacts.address[contact, 1]
    second = contacts.address[contact, 2]
    normal = contacts.address[contact, 0]
    along = friction[0] * rows.velocity[world, first]
    across = friction[1] * rows.velocity[world, second]
    size = wp.sqrt(along * along + across * across)
    most = wp.max(friction[0], friction[1])
    if most > 0.0:
        alike = _is_alike(contacts, laws, contact)
        share = _share(laws, world, size / most, most, alike)
        if share > 0.0:
            along = friction[0] * along / size
            across = friction[1] * across / size
            gained = along * last_acceleration(rows, world, first)
            gained += across * last_acceleration(rows, world, second)
            wanted = along * rows.reference[world, first]
            wanted += across * rows.reference[world, second]
            lacking = rows.reference[world, normal] - last_acceleration(rows, world, normal)
            mu = wp.sqrt(along * along + across * across)
            left = _lasting(laws, world, gained, size, alike) - wanted
            parting = _parting(laws, world, left, lacking, mu)
            rows.reference[world, normal] = rows.reference[world, normal] - share * parting


@wp.func
def _on_a_pyramid(
    rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int
) -> None:
    """Set the edges n ± mu t likewise, turned so that one direction is that of the slip."""
    world = contacts.world[contact]
    mu = contacts.friction[contact][0]
    row = wp.vec4i(
        contacts.address[contact, 0],
        contacts.address[contact, 1],
        contacts.address[contact, 2],
        contacts.address[contact, 3],
    )
    one = 0.5 * (rows.velocity[world, row[0]] - rows.velocity[world, row[1]]) / mu
    two = 0.5 * (rows.velocity[world, row[2]] - rows.velocity[world, row[3]]) / mu
    slip = wp.sqrt(one * one + two * two)
    if slip >= LEAST_CREEP:
        _turn_frame(contacts, contact, one / slip, two / slip)
        turn_pyramid(rows, world, row, one / slip, two / slip)
        alike = _is_alike(contacts, laws, contact)
        share = _share(laws, world, slip, mu, alike)
        if share > 0.0:
            left = float(0.0)
            lacking = float(0.0)
            for side in range(2):
                plus = row[2 * side]
                minus = row[2 * side + 1]
                ahead = last_acceleration(rows, world, plus)
                behind = last_acceleration(rows, world, minus)
                sign = wp.where(rows.velocity[world, plus] > rows.velocity[world, minus], 0.5, -0.5)
                wanted = sign * (rows.reference[world, plus] - rows.reference[world, minus])
                gained = _lasting(laws, world, sign * (ahead - behind), mu * slip, alike)
                left = wp.max(left, gained - wanted)
                both = rows.reference[world, plus] + rows.reference[world, minus]
                lacking = 0.5 * (both - ahead - behind)
            parting = share * _parting(laws, world, left, lacking, mu)
            for edge in range(2 * (contacts.dim[contact] - 1)):
                place = contacts.address[contact, edge]
                rows.reference[world, place] = rows.reference[world, place] - parting


@wp.func
def _is_alike(contacts: ContactList, laws: ContactLaws, contact: int) -> int:
    """Return whether all contacts of both bodies have the same, isotropic friction."""
    friction = contacts.friction[contact]
    geoms = contacts.geom[contact]
    if (
        friction[0] != friction[1]
        or contacts.margin[contact] < 0.0
        or wp.min(geoms[0], geoms[1]) < 0
    ):
        return 0
    return laws.alike[geoms[0]] * laws.alike[geoms[1]]


@wp.func
def _turn_frame(contacts: ContactList, contact: int, one: float, two: float) -> None:
    frame = contacts.frame[contact]
    along = one * frame[1] + two * frame[2]
    across = one * frame[2] - two * frame[1]
    contacts.frame[contact] = wp.matrix_from_rows(frame[0], along, across)


@wp.func
def _weight(laws: ContactLaws, world: int) -> float:
    return wp.length(laws.gravity[world % laws.gravity.shape[0]])


@wp.func
def _step(laws: ContactLaws, world: int) -> float:
    return laws.step[world % laws.step.shape[0]]


@wp.func
def _share(laws: ContactLaws, world: int, slip: float, friction: float, alike: int) -> float:
    """Return to what share a contact that slips slides: 0 as long as it may only creep."""
    if friction > MOST_FRICTION or slip < LEAST_CREEP:
        return 0.0
    if alike != 0:
        return 1.0
    if slip < LEAST_SLIP:
        return 0.0
    creep = wp.max(LEAST_SLIP, CREEP * friction * _weight(laws, world) * _step(laws, world))
    return wp.clamp(slip / creep - 1.0, 0.0, 1.0)


@wp.func
def _lasting(laws: ContactLaws, world: int, gained: float, slip: float, alike: int) -> float:
    """Return the acceleration along the slip to expect after that of the last step."""
    if gained <= 0.0 or alike != 0:
        return gained
    return gained * wp.max(1.0 - gained * _step(laws, world) / slip, 0.0)


@wp.func
def _parting(laws: ContactLaws, world: int, left: float, lacking: float, mu: float) -> float:
    """Return the normal acceleration that MuJoCo would add.

    See ``contact_laws.sliding_friction``.
    """
    square = mu * mu
    if wp.abs(lacking) < wp.max(IMPACT * _weight(laws, world), IMPACT):
        square = wp.min(square, DAMPED)
    return wp.max(left - square * lacking, 0.0)
