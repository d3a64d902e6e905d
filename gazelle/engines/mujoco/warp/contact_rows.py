"""Contacts on the device: directions of friction, treads of wheels, ways out of overlaps, bounces.

The laws are those of ``gazelle.engines.mujoco.contact_laws``, with their sources and limits.
"""

import warp as wp

from gazelle.engines.mujoco.warp.constraint_rows import (
    ConstraintRows,
    row_dof,
    row_entry,
    row_width,
    set_row_entry,
    turn_rows,
)
from gazelle.engines.mujoco.warp.contact_data import ContactLaws, ContactList, damping_of
from gazelle.engines.mujoco.warp.sliding_friction import stay_down

wp.set_module_options({"enable_backward": False})

# As in ``contact_laws.wheel_contacts``: the sine from level at which an axle is not a wheel's, what is near, and by how
# much a tread gives way at an edge [m].
STEEP = wp.constant(0.34)
NEAR = wp.constant(1.0e-7)
GIVES = wp.constant(1.0e-3)

# As in ``contact_laws.kernel``: steps of gravity that make rest, and MuJoCo's share of a bounce's force.
STEPS_TO_REST = wp.constant(2.0)
FULL = wp.constant(0.9999)

CONSTRAINT = wp.constant(1)  # what MuJoCo Warp calls ContactType.CONSTRAINT
ITS_OWN, BY_THE_NORMAL = wp.constant(1), wp.constant(2)
SLIDING = wp.constant(3)  # directions of a contact with friction


@wp.kernel
def correct_contacts(rows: ConstraintRows, contacts: ContactList, laws: ContactLaws) -> None:
    """Apply the laws to contacts before MuJoCo Warp solves for their forces."""
    contact = wp.tid()
    if contact >= contacts.total[0]:
        return
    if (contacts.kind[contact] & CONSTRAINT) == 0 or contacts.address[contact, 0] < 0:
        return
    geoms = contacts.geom[contact]
    if geoms[0] < 0 or geoms[1] < 0:
        return
    if laws.directional_friction != 0:
        _direct(rows, contacts, laws, contact)
    if laws.wheel_geoms != 0:
        _stand_in_the_middle(rows, contacts, laws, contact)
    if laws.touches != 0:
        _leave_slowly(rows, contacts, laws, contact)
    if contacts.solreffriction[contact][1] < 0.0:
        _bounce(rows, contacts, laws, contact)
    if laws.touches != 0:
        stay_down(rows, contacts, laws, contact)


@wp.func
def _direct(rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int) -> None:
    """Turn the two friction directions of a contact to those of its surfaces."""
    if contacts.dim[contact] >= SLIDING and laws.cone != 0:
        world = contacts.world[contact]
        frame = contacts.frame[contact]
        desired = _first_direction(contacts, laws, contact)
        one = wp.dot(desired, frame[1])
        two = wp.dot(desired, frame[2])
        size = wp.sqrt(one * one + two * two)
        if size >= 1.0e-3:
            one = one / size
            two = two / size
            first = contacts.address[contact, 1]
            second = contacts.address[contact, 2]
            turn_rows(rows, world, first, second, one, two)
            along = one * frame[1] + two * frame[2]
            across = one * frame[2] - two * frame[1]
            contacts.frame[contact] = wp.matrix_from_rows(frame[0], along, across)


@wp.func
def _first_direction(contacts: ContactList, laws: ContactLaws, contact: int) -> wp.vec3:
    """Return ODE's first direction of a contact in the world; zeros where it does not matter."""
    geoms = contacts.geom[contact]
    normal = contacts.frame[contact][0]
    chosen = int(-1)
    least = float(1.0e30)
    kind = int(0)
    for side in range(2):
        geom = geoms[side]
        own = laws.direction_kind[geom]
        if own == ITS_OWN and (kind != ITS_OWN or laws.coefficient[geom] < least):
            chosen = geom
            least = float(laws.coefficient[geom])
            kind = int(ITS_OWN)
        elif own == BY_THE_NORMAL and kind == 0:
            kind = int(BY_THE_NORMAL)
    if kind == ITS_OWN:
        return contacts.geom_xmat[contacts.world[contact], chosen] @ laws.direction[chosen]
    if kind == BY_THE_NORMAL:
        if wp.abs(normal[2]) > wp.sqrt(0.5):
            return wp.vec3(0.0, -normal[2], normal[1])
        return wp.vec3(-normal[1], normal[0], 0.0)
    return wp.vec3(0.0, 0.0, 0.0)


@wp.func
def _stand_in_the_middle(
    rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int
) -> None:
    """Move a contact with a wheel to the middle of its tread."""
    world = contacts.world[contact]
    geoms = contacts.geom[contact]
    moved = int(0)
    for side in range(2):
        geom = geoms[side]
        joint = laws.tread[geom] - 1
        if contacts.dim[contact] >= SLIDING and joint >= 0 and moved == 0:
            axle = contacts.xaxis[world, joint]
            place = contacts.position[contact]
            along = wp.dot(place - contacts.geom_xpos[world, geom], axle) - laws.middle[geom]
            lean = wp.dot(contacts.frame[contact][0], axle)
            share = 1.0 - wp.abs(lean * along) / GIVES
            if share > 0.0 and wp.abs(lean) < STEEP and wp.abs(along) > NEAR:
                shift = -share * along * axle
                contacts.position[contact] = place + shift
                _move(rows, contacts, laws, contact, shift)
                moved = 1


@wp.func
def _move(
    rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int, shift: wp.vec3
) -> None:
    """Move where a contact acts: what turns a body about an axis w changes by w x shift."""
    world = contacts.world[contact]
    frame = contacts.frame[contact]
    geoms = contacts.geom[contact]
    change = wp.vec3(0.0, 0.0, 0.0)
    for side in range(2):
        sign = 1.0 if side == 1 else -1.0
        dof = _last_dof(laws, laws.geom_bodyid[geoms[side]])
        while dof >= 0:
            spin = contacts.cdof[world, dof]
            arm = sign * (frame @ wp.cross(wp.vec3(spin[0], spin[1], spin[2]), shift))
            change += arm * contacts.qvel[world, dof]
            parts = _by_rows(contacts, laws, contact, arm)
            for edge in range(_sliding_rows(laws)):
                row = contacts.address[contact, edge]
                for place in range(row_width(rows, world, row)):
                    if row_dof(rows, world, row, place) == dof:
                        value = row_entry(rows, world, row, place) + parts[edge]
                        set_row_entry(rows, world, row, place, value)
            dof = laws.dof_parentid[dof]
    parts = _by_rows(contacts, laws, contact, change)
    step = laws.step[world % laws.step.shape[0]]
    share = contacts.solimp[contact][1]
    normal = damping_of(laws, contacts.solref[contact], share, step)
    friction = normal
    if laws.cone != 0:
        own = contacts.solreffriction[contact]
        if own[0] != 0.0 or own[1] != 0.0:
            friction = damping_of(laws, own, share, step)
    for edge in range(_sliding_rows(laws)):
        row = contacts.address[contact, edge]
        damping = normal if edge == 0 else friction
        rows.velocity[world, row] = rows.velocity[world, row] + parts[edge]
        rows.reference[world, row] = rows.reference[world, row] - damping * parts[edge]


@wp.func
def _sliding_rows(laws: ContactLaws) -> int:
    """Return the number of rows of the normal and the two directions of sliding."""
    if laws.cone != 0:
        return 3
    return 4


@wp.func
def _by_rows(contacts: ContactList, laws: ContactLaws, contact: int, ways: wp.vec3) -> wp.vec4:
    """Transform (normal, first, second) directions to the rows of sliding: n ± mu t in a pyramid."""
    if laws.cone != 0:
        return wp.vec4(ways[0], ways[1], ways[2], 0.0)
    first = contacts.friction[contact][0] * ways[1]
    second = contacts.friction[contact][0] * ways[2]
    return wp.vec4(ways[0] + first, ways[0] - first, ways[0] + second, ways[0] - second)


@wp.func
def _last_dof(laws: ContactLaws, body: int) -> int:
    """Return the last velocity that moves a body; -1 without one."""
    part = int(body)
    while part > 0:
        count = laws.body_dofnum[part]
        if count > 0:
            return laws.body_dofadr[part] + count - 1
        part = laws.body_parentid[part]
    return -1


@wp.func
def _leave_slowly(
    rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int
) -> None:
    """Bound the velocity at which a contact pushes out what overlapped (``contact_laws.penetration_velocity``)."""
    if contacts.margin[contact] < 0.0 and contacts.solref[contact][0] > 0.0:
        world = contacts.world[contact]
        geoms = contacts.geom[contact]
        most = wp.min(laws.exit_speed[geoms[0]], laws.exit_speed[geoms[1]])
        row = contacts.address[contact, 0]
        desired = rows.reference[world, row]
        parting = rows.velocity[world, row]
        count = int(1)
        if contacts.dim[contact] > 1 and laws.cone == 0:
            other = contacts.address[contact, 1]
            desired = 0.5 * (desired + rows.reference[world, other])
            parting = 0.5 * (parting + rows.velocity[world, other])
            count = 2 * (contacts.dim[contact] - 1)
        step = laws.step[world % laws.step.shape[0]]
        damping = damping_of(laws, contacts.solref[contact], contacts.solimp[contact][1], step)
        excess = desired + damping * (parting - most)
        if excess > 0.0:
            for edge in range(count):
                place = contacts.address[contact, edge]
                rows.reference[world, place] = rows.reference[world, place] - excess


@wp.func
def _bounce(rows: ConstraintRows, contacts: ContactList, laws: ContactLaws, contact: int) -> None:
    """Set the bounce of two bodies in the step of the impact, to reach e² of the height."""
    world = contacts.world[contact]
    row = contacts.address[contact, 0]
    step = laws.step[world % laws.step.shape[0]]
    pull = _pull(contacts, laws, contact)
    speed = -rows.velocity[world, row]
    late = 0.5 * pull * step
    if speed > STEPS_TO_REST * wp.abs(pull) * step and speed > 0.0:
        e = -contacts.solref[contact][1] * step / FULL - 1.0
        height = contacts.distance[contact] - contacts.margin[contact]
        fallen = -2.0 * pull * wp.clamp(height, -speed * step, speed * step)
        parting = e * e * ((speed + late) * (speed + late) - fallen) + fallen
        if parting > late * late:
            rows.reference[world, row] = (wp.sqrt(parting) - late + speed) / step


@wp.func
def _pull(contacts: ContactList, laws: ContactLaws, contact: int) -> float:
    """Return the free acceleration by which two bodies approach each other."""
    world = contacts.world[contact]
    geoms = contacts.geom[contact]
    normal = contacts.frame[contact][0]
    gravity = laws.gravity[world % laws.gravity.shape[0]]
    along = float(0.0)
    for side in range(2):
        body = laws.geom_bodyid[geoms[side]]
        root = laws.body_rootid[body]
        if laws.body_jntnum[root] > 0 and laws.jnt_type[laws.body_jntadr[root]] == 0:
            borne = laws.body_gravcomp[world % laws.body_gravcomp.shape[0], body]
            sign = 1.0 if side == 0 else -1.0
            along += sign * (1.0 - borne) * wp.dot(gravity, normal)
    return along
