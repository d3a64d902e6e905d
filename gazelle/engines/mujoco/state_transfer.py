"""Transfer of the state of a batch to another batch, name by name."""

from __future__ import annotations

from mujoco.batch import Batch

from gazelle.engines.mujoco.layout import LinkSlot, MujocoLayout, Slot

# Arrays with one column a degree of freedom.
_BY_DOF = ("qvel", "qacc_warmstart", "qfrc_applied")


def transfer_state(
    old: Batch, old_layout: MujocoLayout, new: Batch, new_layout: MujocoLayout
) -> None:
    """Copy the state of all joints, kinematic bodies, motors, attachments and slip bodies of both."""
    new.time[:] = old.time
    for name, slots in new_layout.joints.items():
        for here, there in zip(slots, old_layout.joints.get(name, ()), strict=False):
            _copy_joint(old, there, new, here)
    for name, link in new_layout.links.items():
        former = old_layout.links.get(name)
        if former is not None:
            _copy_link(old, former, new, link)
    _copy_slip_bodies(old, old_layout, new, new_layout)
    for name, motor in new_layout.motors.items():
        former_motor = old_layout.motors.get(name)
        if former_motor is not None:
            new.userdata[:, motor.targets] = old.userdata[:, former_motor.targets]
            new.userdata[:, motor.deflections] = old.userdata[:, former_motor.deflections]
    for name, column in new_layout.attachments.items():
        if name in old_layout.attachments:
            new.eq_active[:, column] = old.eq_active[:, old_layout.attachments[name]]


def _copy_slip_bodies(
    old: Batch, old_layout: MujocoLayout, new: Batch, new_layout: MujocoLayout
) -> None:
    for name, slip_body in new_layout.slip_links.items():
        former = old_layout.slip_links.get(name)
        if former is not None:
            for field in _BY_DOF:
                there = getattr(old, field)[:, list(former.dofs)]
                getattr(new, field)[:, list(slip_body.dofs)] = there


def _copy_link(old: Batch, there: LinkSlot, new: Batch, here: LinkSlot) -> None:
    if here.free is not None and there.free is not None:
        _copy_joint(old, there.free, new, here.free)
    if here.mocap is not None and there.mocap is not None:
        new.mocap_pos[:, here.mocap] = old.mocap_pos[:, there.mocap]
        new.mocap_quat[:, here.mocap] = old.mocap_quat[:, there.mocap]
    elif here.mocap is not None and there.free is not None:
        pose = old.qpos[:, there.free.position]
        new.mocap_pos[:, here.mocap] = pose[:, :3]
        new.mocap_quat[:, here.mocap] = pose[:, 3:]
    if here.body and there.body:
        new.xfrc_applied[:, here.body] = old.xfrc_applied[:, there.body]


def _copy_joint(old: Batch, there: Slot, new: Batch, here: Slot) -> None:
    new.qpos[:, here.position] = old.qpos[:, there.position]
    for field in _BY_DOF:
        getattr(new, field)[:, here.velocity] = getattr(old, field)[:, there.velocity]
