"""Contacts of all worlds, their forces, and the collisions they belong to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.engines.mujoco.joint_wrenches import JointReactions
from gazelle.engines.mujoco.layout import MujocoLayout, look_up
from gazelle.engines.mujoco.step_forces import ForcedSteps
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.reactions import ContactTable

# What ``_read_contacts`` says of a world where nothing touches.
_NOTHING = tuple(
    np.zeros(shape, kind)
    for shape, kind in (
        ((0, 2), np.int32),
        (0, np.int32),
        (0, np.int32),
        ((0, 3), np.float64),
        (0, np.float64),
        ((0, 9), np.float64),
        ((0, 5), np.float64),
        (0, np.float64),
    )
)


@dataclass(frozen=True, slots=True)
class _ContactRows:
    """All contacts of some worlds, world by world; see ``_read_contacts``.

    Attributes:
        worlds: World of each, shape (k,).
        starts: Start of its world's constraints among ``forces``, shape (k,).
    """

    worlds: Worlds
    starts: Indices
    geoms: NDArray[np.int32]
    address: NDArray[np.int32]
    dims: NDArray[np.int32]
    points: Floats
    depth: Floats
    axes: Floats
    frictions: Floats
    forces: Floats


@dataclass(frozen=True, slots=True)
class _Layer:
    """Sets of collisions that have none in common.

    Attributes:
        sets: Set of each geom's collision, shape (geoms + 1,); -1 for none.
        ranks: Rank in that list, likewise.
    """

    sets: Indices
    ranks: Indices


class _GeomList:
    """Collisions that MuJoCo's geoms stand for.

    Attributes:
        names: Scoped names of their collisions.
        distinct: The same, each once.
        numbers: Their numbers.
    """

    def __init__(self, layout: MujocoLayout, count: int) -> None:
        self.names = np.empty(count, np.object_)
        self.distinct = list(layout.collisions)
        self.numbers = np.full(count, -1)
        for number, (name, geoms) in enumerate(layout.collisions.items()):
            self.names[geoms], self.numbers[geoms] = name, number
        self._layers: dict[tuple[tuple[str, ...], ...], list[_Layer]] = {}

    def layers(self, layout: MujocoLayout, sets: tuple[tuple[str, ...], ...]) -> list[_Layer]:
        """Return sets of collisions in as few layers as possible: no collision twice in a layer.

        Raises:
            EngineError: There is no such collision.
        """
        known = self._layers.get(sets)
        if known is None:
            known = self._layers[sets] = []
            for number, collisions in enumerate(sets):
                found = [look_up("collision", name, layout.collisions) for name in collisions]
                pieces = [np.asarray(each, np.intp) for each in found]
                every = np.concatenate([np.zeros(0, np.intp), *pieces])
                layer = next((each for each in known if (each.sets[every] < 0).all()), None)
                if layer is None:
                    layer = _Layer(*np.full((2, len(self.names) + 1), -1))
                    known.append(layer)
                for rank, geoms in enumerate(found):
                    layer.sets[geoms], layer.ranks[geoms] = number, rank
        return known


class ContactAccess:
    """The part of ``gazelle.engines.engine.Engine`` that knows what touches.

    Args:
        run: Running worlds.
        stepper: Applies the forces of a moment.
        reactions: Has single worlds with all their forces.
    """

    def __init__(self, run: RunningWorlds, stepper: ForcedSteps, reactions: JointReactions) -> None:
        self._run, self._stepper, self._reactions = run, stepper, reactions
        # The layout for which geoms were listed last, and the list.
        self._listed: tuple[MujocoLayout, _GeomList] | None = None

    def contacts(self, sets: Sequence[Sequence[str]], worlds: Worlds | None = None) -> ContactTable:
        """Return the contacts of each of some sets of collisions; see the protocol."""
        layout = self._run.up_to_date()
        listed = self._list_of(layout)
        found = self._all_contacts(np.arange(self._run.nworld) if worlds is None else worlds)
        acting = np.flatnonzero(found.address >= 0)
        parts = [
            _touches_of(layer, found.geoms[acting])
            for layer in listed.layers(layout, tuple(map(tuple, sets)))
        ]
        which, rows, mine = (np.concatenate(each) for each in zip(*parts, strict=True))
        chosen = acting[rows]
        order = np.lexsort((chosen, which))  # contacts are listed world by world
        which, chosen, mine = which[order], chosen[order], mine[order]
        numbers = listed.numbers[found.geoms[chosen]]
        index = np.arange(len(chosen))
        return ContactTable(
            which,
            found.worlds[chosen],
            listed.distinct,
            numbers[index, mine],
            numbers[index, 1 - mine],
            self._terms(found, chosen, mine),
        )

    def _all_contacts(self, worlds: Worlds) -> _ContactRows:
        """Return all contacts of some worlds, in this order."""
        chosen = np.asarray(worlds)
        with self._stepper.forced():
            found = [_read_contacts(self._reactions.probe(world)[1]) for world in chosen.tolist()]
        every = [np.concatenate(part) for part in zip(*(found or [_NOTHING]), strict=True)]
        counts = np.array([(len(each[0]), len(each[-1])) for each in found], np.intp).reshape(-1, 2)
        starts = np.repeat(counts[:, 1].cumsum() - counts[:, 1], counts[:, 0])
        return _ContactRows(np.repeat(chosen, counts[:, 0]), starts, *every)

    def _terms(self, found: _ContactRows, rows: Indices, mine: Indices) -> Floats:
        """Return what acts in contacts on one of their two geoms, as ``ContactTable.terms``."""
        axes = found.axes[rows].reshape(-1, 3, 3)
        cone = self._run.batch.model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
        frictions = None if cone else found.frictions[rows]
        address = found.address[rows] + found.starts[rows]
        wrench = _contact_forces(found.forces, address, found.dims[rows], frictions)
        # MuJoCo's normals and forces are those from the first geom on the second.
        sign = np.where(mine == 1, 1.0, -1.0)[:, None]
        force = sign * (wrench[:, None, :3] @ axes)[:, 0]
        torque = sign * (wrench[:, None, 3:] @ axes)[:, 0]
        depth = -found.depth[rows]
        return np.column_stack((found.points[rows], sign * axes[:, 0], depth, force, torque))

    def _list_of(self, layout: MujocoLayout) -> _GeomList:
        if self._listed is None or self._listed[0] is not layout:
            self._listed = (layout, _GeomList(layout, int(self._run.batch.model.ngeom)))
        return self._listed[1]


def _touches_of(layer: _Layer, geoms: NDArray[np.int32]) -> tuple[Indices, Indices, Indices]:
    """Return the sets that contacts are of, their indices, and which of the two geoms is the set's.

    A contact between two of one set is listed once, for the one that is named first; one between
    two sets for both.
    """
    sets, ranks = layer.sets[geoms], layer.ranks[geoms]
    own = sets[:, 0] == sets[:, 1]
    first = (sets[:, 0] >= 0) & ~(own & (ranks[:, 1] < ranks[:, 0]))
    second = (sets[:, 1] >= 0) & ~(own & (ranks[:, 0] <= ranks[:, 1]))
    rows = [np.flatnonzero(first), np.flatnonzero(second)]
    which = [sets[row, side] for side, row in enumerate(rows)]
    mine = [np.full(len(row), side) for side, row in enumerate(rows)]
    return np.concatenate(which), np.concatenate(rows), np.concatenate(mine)


def _read_contacts(data: mujoco.MjData) -> tuple[NDArray[Any], ...]:
    """Return the contacts of one world.

    They are geoms, addresses, widths, points, distances, axes and coefficients.

    Last come the forces of all constraints. Copies: the next world is computed in the same
    memory.
    """
    found = data.contact
    return (
        found.geom.reshape(-1, 2).copy(),
        found.efc_address.copy(),
        found.dim.copy(),
        found.pos.reshape(-1, 3).copy(),
        found.dist.copy(),
        found.frame.reshape(-1, 9).copy(),
        found.friction.reshape(-1, 5).copy(),
        data.efc_force.copy(),
    )


def _contact_forces(
    forces: Floats, address: NDArray[Any], dims: NDArray[Any], frictions: Floats | None
) -> Floats:
    """Return force and torque of contacts, each in its own frame, shape (k, 6).

    Args:
        forces: Of all constraints.
        address: Of each contact's first, shape (k,).
        dims: Number of directions of each contact, shape (k,).
        frictions: Coefficients of friction where friction is a pyramid, shape (k, 5); each of its
            edges is the normal and one direction times its coefficient. None for a cone.
    """
    wrench = np.zeros((len(address), 6))
    for width in sorted(set(dims.tolist())):
        rows = np.flatnonzero(dims == width)
        edges = None if width == 1 else frictions
        count = width if edges is None else 2 * (width - 1)
        values = forces[address[rows, None] + np.arange(count)]
        if edges is not None:
            wrench[rows, 0] = values.sum(axis=1)
            lean = values[:, 0::2] - values[:, 1::2]
            wrench[rows[:, None], np.arange(1, width)] = lean * edges[rows, : width - 1]
        else:
            wrench[rows[:, None], np.arange(width)] = values
    return wrench
