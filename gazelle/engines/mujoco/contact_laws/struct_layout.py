"""Memory layout of MuJoCo's structs, from MuJoCo's own description of them.

Compiled code that MuJoCo calls in the middle of a step gets bare addresses of its model and
data. The offsets are worked out by ``ctypes`` from ``mujoco.introspect``, which comes with
every release, and compared with what MuJoCo says of a model before they are used.
"""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import Any, NamedTuple

import mujoco
from mujoco.introspect import ast_nodes, structs

from gazelle.engines.mujoco.library import address_of_struct
from gazelle.errors import EngineError

_PLAIN: dict[str, Any] = {
    "mjtNum": ctypes.c_double,
    "double": ctypes.c_double,
    "float": ctypes.c_float,
    "int": ctypes.c_int,
    "mjtSize": ctypes.c_int64,
    "size_t": ctypes.c_size_t,
    "uintptr_t": ctypes.c_size_t,
    "uint64_t": ctypes.c_uint64,
    "unsigned int": ctypes.c_uint,
    "mjtByte": ctypes.c_uint8,
    "mjtBool": ctypes.c_uint8,
    "char": ctypes.c_char,
}


class Offsets(NamedTuple):
    """Bytes from the start of a struct to each field, and the size of a contact.

    Those named ``contact_...`` are in ``mjContact``, ``model_...`` in ``mjModel`` and the others
    in ``mjData``.
    """

    ncon: int
    ne: int
    nf: int
    contact: int
    kind: int
    owner: int
    softness: int
    stiffness: int
    frictionloss: int
    userdata: int
    mocap_pos: int
    mocap_quat: int
    nisland: int
    to_island: int
    island_softness: int
    island_stiffness: int
    bias: int
    applied: int
    constraint: int
    smooth: int
    acceleration: int
    rownnz: int
    rowadr: int
    colind: int
    jacobian: int
    velocity: int
    reference: int
    qpos: int
    qvel: int
    warmstart: int
    passive: int
    xmat: int
    geom_xmat: int
    geom_xpos: int
    xaxis: int
    cdof: int
    cvel: int
    terms: int
    contact_size: int
    contact_dist: int
    contact_frame: int
    contact_margin: int
    contact_pos: int
    contact_friction: int
    contact_mu: int
    contact_solref: int
    contact_solreffriction: int
    contact_dim: int
    contact_geom: int
    contact_address: int
    model_nv: int
    model_njnt: int
    model_nnumeric: int
    model_numeric: int
    model_timestep: int
    model_gravity: int
    model_cone: int
    model_impratio: int
    model_bodyid: int
    model_rootid: int
    model_parentid: int
    model_dofnum: int
    model_dofadr: int
    model_dof_parentid: int
    model_jntadr: int
    model_jntnum: int
    model_jnt_type: int
    model_jnt_bodyid: int
    model_jnt_dofadr: int
    model_inertia: int
    model_iquat: int
    model_gravcomp: int
    model_nuser_geom: int
    model_geom_user: int
    model_geom_size: int


@lru_cache(maxsize=1)
def offsets() -> Offsets:
    """Return the offsets in the running MuJoCo.

    Raises:
        EngineError: MuJoCo has an unexpected memory layout.
    """
    model, data, contact = (_struct(f"mj{name}") for name in ("Model", "Data", "Contact"))
    option = _struct("mjOption")
    found = Offsets(
        ncon=data.ncon.offset,
        ne=data.ne.offset,
        nf=data.nf.offset,
        contact=data.contact.offset,
        kind=data.efc_type.offset,
        owner=data.efc_id.offset,
        softness=data.efc_R.offset,
        stiffness=data.efc_D.offset,
        frictionloss=data.efc_frictionloss.offset,
        userdata=data.userdata.offset,
        mocap_pos=data.mocap_pos.offset,
        mocap_quat=data.mocap_quat.offset,
        nisland=data.nisland.offset,
        to_island=data.map_efc2iefc.offset,
        island_softness=data.iefc_R.offset,
        island_stiffness=data.iefc_D.offset,
        bias=data.qfrc_bias.offset,
        applied=data.qfrc_applied.offset,
        constraint=data.qfrc_constraint.offset,
        smooth=data.qfrc_smooth.offset,
        acceleration=data.qacc_smooth.offset,
        rownnz=data.efc_J_rownnz.offset,
        rowadr=data.efc_J_rowadr.offset,
        colind=data.efc_J_colind.offset,
        jacobian=data.efc_J.offset,
        velocity=data.efc_vel.offset,
        reference=data.efc_aref.offset,
        qpos=data.qpos.offset,
        qvel=data.qvel.offset,
        warmstart=data.qacc_warmstart.offset,
        passive=data.qfrc_passive.offset,
        xmat=data.xmat.offset,
        geom_xmat=data.geom_xmat.offset,
        geom_xpos=data.geom_xpos.offset,
        xaxis=data.xaxis.offset,
        cdof=data.cdof.offset,
        cvel=data.cvel.offset,
        terms=data.efc_KBIP.offset,
        contact_size=ctypes.sizeof(contact),
        contact_dist=contact.dist.offset,
        contact_frame=contact.frame.offset,
        contact_margin=contact.includemargin.offset,
        contact_pos=contact.pos.offset,
        contact_friction=contact.friction.offset,
        contact_mu=contact.mu.offset,
        contact_solref=contact.solref.offset,
        contact_solreffriction=contact.solreffriction.offset,
        contact_dim=contact.dim.offset,
        contact_geom=contact.geom.offset,
        contact_address=contact.efc_address.offset,
        model_nv=model.nv.offset,
        model_njnt=model.njnt.offset,
        model_nnumeric=model.nnumeric.offset,
        model_numeric=model.numeric_data.offset,
        model_timestep=model.opt.offset + option.timestep.offset,
        model_gravity=model.opt.offset + option.gravity.offset,
        model_cone=model.opt.offset + option.cone.offset,
        model_impratio=model.opt.offset + option.impratio.offset,
        model_bodyid=model.geom_bodyid.offset,
        model_rootid=model.body_rootid.offset,
        model_parentid=model.body_parentid.offset,
        model_dofnum=model.body_dofnum.offset,
        model_dofadr=model.body_dofadr.offset,
        model_dof_parentid=model.dof_parentid.offset,
        model_jntadr=model.body_jntadr.offset,
        model_jntnum=model.body_jntnum.offset,
        model_jnt_type=model.jnt_type.offset,
        model_jnt_bodyid=model.jnt_bodyid.offset,
        model_jnt_dofadr=model.jnt_dofadr.offset,
        model_inertia=model.body_inertia.offset,
        model_iquat=model.body_iquat.offset,
        model_gravcomp=model.body_gravcomp.offset,
        model_nuser_geom=model.nuser_geom.offset,
        model_geom_user=model.geom_user.offset,
        model_geom_size=model.geom_size.offset,
    )
    _verify(found)
    return found


@lru_cache(maxsize=1)
def memory_offset() -> int:
    """Return the bytes from the start of a model to the size of its data's memory.

    Raises:
        EngineError: MuJoCo has an unexpected memory layout.
    """
    model, offset = mujoco.MjSpec().compile(), int(_struct("mjModel").narena.offset)
    if ctypes.c_int64.from_address(address_of_struct(model) + offset).value != model.narena:
        raise EngineError(f"MuJoCo {mujoco.__version__} has an unexpected memory layout")
    return offset


@lru_cache(maxsize=32)
def _struct(name: str) -> Any:
    """Return a struct of MuJoCo's as ``ctypes`` lays it out."""
    return _lay_out(name, structs.STRUCTS[name].fields)


def _lay_out(name: str, fields: Any) -> Any:
    parts = [
        (getattr(field, "name", "") or f"unnamed{place}", _type_of(getattr(field, "type", field)))
        for place, field in enumerate(fields)
    ]
    return type(name, (ctypes.Structure,), {"_fields_": parts})


def _type_of(kind: Any) -> Any:
    if isinstance(kind, ast_nodes.PointerType):
        return ctypes.c_void_p
    if isinstance(kind, ast_nodes.ArrayType):
        made = _type_of(kind.inner_type)
        for extent in reversed(kind.extents):
            made = made * extent
        return made
    if isinstance(kind, ast_nodes.AnonymousStructDecl):
        return _lay_out("anonymous", kind.fields)
    if kind.name in structs.STRUCTS:
        return _struct(kind.name)
    return _PLAIN.get(kind.name, ctypes.c_int)  # all others are enumerations


def _verify(found: Offsets) -> None:
    """Compare the offsets with a small model with addresses reported by MuJoCo.

    Raises:
        EngineError: They differ.
    """
    spec = mujoco.MjSpec()
    spec.nuser_geom = 1
    spec.nuserdata = 1
    spec.add_numeric(name="here", data=[1.0], size=1)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[1, 1, 1])
    spec.worldbody.add_body(mocap=True, pos=[0, 0, 9])
    body = spec.worldbody.add_body(pos=[0, 0, 0.09])
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0, 0])
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    here, there = address_of_struct(model), address_of_struct(data)
    reported = [
        (there + found.qvel, data.qvel),
        (there + found.passive, data.qfrc_passive),
        (there + found.contact, data.contact.dist),
        (there + found.velocity, data.efc_vel),
        (there + found.kind, data.efc_type),
        (there + found.owner, data.efc_id),
        (there + found.softness, data.efc_R),
        (there + found.stiffness, data.efc_D),
        (there + found.to_island, data.map_efc2iefc),
        (there + found.island_softness, data.iefc_R),
        (there + found.island_stiffness, data.iefc_D),
        (there + found.cvel, data.cvel),
        (there + found.frictionloss, data.efc_frictionloss),
        (there + found.userdata, data.userdata),
        (there + found.mocap_pos, data.mocap_pos),
        (there + found.mocap_quat, data.mocap_quat),
        (there + found.bias, data.qfrc_bias),
        (there + found.applied, data.qfrc_applied),
        (there + found.constraint, data.qfrc_constraint),
        (there + found.smooth, data.qfrc_smooth),
        (there + found.acceleration, data.qacc_smooth),
        (there + found.reference, data.efc_aref),
        (there + found.jacobian, data.efc_J),
        (there + found.warmstart, data.qacc_warmstart),
        (here + found.model_numeric, model.numeric_data),
        (here + found.model_geom_user, model.geom_user),
        (here + found.model_geom_size, model.geom_size),
        (there + found.geom_xpos, data.geom_xpos),
        (there + found.cdof, data.cdof),
        (there + found.xaxis, data.xaxis),
        (there + found.terms, data.efc_KBIP),
        (here + found.model_dof_parentid, model.dof_parentid),
        (there + found.geom_xmat, data.geom_xmat),
        (here + found.model_inertia, model.body_inertia),
    ]
    right = all(
        ctypes.c_int64.from_address(place).value == array.ctypes.data for place, array in reported
    )
    step = ctypes.c_double.from_address(here + found.model_timestep).value
    count = ctypes.c_int.from_address(there + found.ncon).value
    islands = ctypes.c_int.from_address(there + found.nisland).value
    counted = count == data.ncon == 1 and islands == data.nisland == 1
    if not (right and step == model.opt.timestep and counted):
        raise EngineError(
            f"MuJoCo {mujoco.__version__} has an unexpected memory layout",
            hint="motors, bounces, turning friction and tumbling bodies need a release from PyPI",
        )
