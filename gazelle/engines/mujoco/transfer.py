"""Carry the state of a batch over to another batch, name by name."""

from __future__ import annotations

from mujoco.batch import Batch

from gazelle.engines.mujoco.layout import Layout, Slot

# Arrays with one column a degree of freedom.
_BY_DOF = ("qvel", "qacc_warmstart", "qfrc_applied")


def carry_over(old: Batch, old_layout: Layout, new: Batch, new_layout: Layout) -> None:
    """Copy the state of every joint, kinematic body and motor that both batches have."""
    new.time[:] = old.time
    for name, slots in new_layout.joints.items():
        for here, there in zip(slots, old_layout.joints.get(name, ()), strict=False):
            _copy_joint(old, there, new, here)
    for name, link in new_layout.links.items():
        former = old_layout.links.get(name)
        if former is None:
            continue
        if link.free is not None and former.free is not None:
            _copy_joint(old, former.free, new, link.free)
        if link.mocap is not None and former.mocap is not None:
            new.mocap_pos[:, link.mocap] = old.mocap_pos[:, former.mocap]
            new.mocap_quat[:, link.mocap] = old.mocap_quat[:, former.mocap]
        elif link.mocap is not None and former.free is not None:
            pose = old.qpos[:, former.free.position]
            new.mocap_pos[:, link.mocap] = pose[:, :3]
            new.mocap_quat[:, link.mocap] = pose[:, 3:]
        if link.body and former.body:
            new.xfrc_applied[:, link.body] = old.xfrc_applied[:, former.body]
    for name, column in new_layout.motors.items():
        if name in old_layout.motors:
            new.ctrl[:, column] = old.ctrl[:, old_layout.motors[name]]


def _copy_joint(old: Batch, there: Slot, new: Batch, here: Slot) -> None:
    new.qpos[:, here.position] = old.qpos[:, there.position]
    for field in _BY_DOF:
        getattr(new, field)[:, here.velocity] = getattr(old, field)[:, there.velocity]
