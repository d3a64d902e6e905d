"""State of contacts and geoms for contact laws on the device."""

import warp as wp

wp.set_module_options({"enable_backward": False})

# MuJoCo Warp's type of five coefficients.
vec5 = wp.types.vector(length=5, dtype=float)

# mjDSBL_REFSAFE
REFSAFE = wp.constant(1 << 12)


@wp.struct
class ContactList:
    """All contacts of all worlds, and what of the state they need.

    The fields are those of MuJoCo Warp's ``Data.contact``, and of ``Data``.
    """

    total: wp.array[int]
    kind: wp.array[int]
    world: wp.array[int]
    dim: wp.array[int]
    geom: wp.array[wp.vec2i]
    address: wp.array2d[int]
    distance: wp.array[float]
    margin: wp.array[float]
    position: wp.array[wp.vec3]
    frame: wp.array[wp.mat33]
    friction: wp.array[vec5]
    solref: wp.array[wp.vec2]
    solreffriction: wp.array[wp.vec2]
    solimp: wp.array[vec5]
    geom_xpos: wp.array2d[wp.vec3]
    geom_xmat: wp.array2d[wp.mat33]
    xaxis: wp.array2d[wp.vec3]
    cdof: wp.array2d[wp.spatial_vector]
    qvel: wp.array2d[float]


@wp.struct
class ContactLaws:
    """Contact laws that apply, and their parameters.

    Of a geom there are: whether it has a direction of friction of its own (1) or takes it from the
    normal (2), which, and its coefficient; as a wheel's tread one more than its joint, and where its
    middle is along the axle [m]; the velocity at which it leaves an overlap [m/s]; and whether all that
    it moves with rubs alike.
    """

    directional_friction: int
    wheel_geoms: int
    touches: int
    cone: int
    disabled: int
    step: wp.array[float]
    gravity: wp.array[wp.vec3]
    body_gravcomp: wp.array2d[float]
    direction_kind: wp.array[int]
    direction: wp.array[wp.vec3]
    coefficient: wp.array[float]
    tread: wp.array[int]
    middle: wp.array[float]
    exit_speed: wp.array[float]
    alike: wp.array[int]
    geom_bodyid: wp.array[int]
    body_rootid: wp.array[int]
    body_parentid: wp.array[int]
    body_dofnum: wp.array[int]
    body_dofadr: wp.array[int]
    body_jntnum: wp.array[int]
    body_jntadr: wp.array[int]
    jnt_type: wp.array[int]
    dof_parentid: wp.array[int]


@wp.func
def damping_of(laws: ContactLaws, solref: wp.vec2, share: float, step: float) -> float:
    """Return the damping B of a contact's reference, -B v - K d.

    It is for the largest share of its force [1/s].
    """
    most = wp.clamp(share, 1.0e-4, 0.9999)
    if solref[1] <= 0.0:
        return -solref[1] / most
    constant = solref[0]
    if (laws.disabled & REFSAFE) == 0:
        constant = wp.max(constant, 2.0 * step)
    return 2.0 / (most * constant)
