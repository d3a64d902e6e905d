"""Each episode of an evaluation by itself, and which of them are the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle.array_types import UInts64
from gazelle.training.episodes import Episodes
from gazelle.training.statistics import SuccessRate, clustered_rate, rate_between_worlds

_ENDS = ("collisions", "timeouts", "others")
_NAMES = {"collisions": "collision", "timeouts": "time-out", "others": "other"}
_ODD = np.uint64(0x9E3779B97F4A7C15)


@dataclass(frozen=True, slots=True)
class EpisodePlace:
    """Place of an episode in an evaluation without workers."""

    reset: int
    """Number of the reset of all copies before it, from 0."""
    copy: int
    """Copy of the environment that it ran in."""
    turn: int
    """Episodes that ended in this copy since that reset."""


@dataclass(frozen=True, slots=True)
class EpisodeRecord:
    """One episode."""

    outcome: str
    """Outcome: ``success``, ``collision``, ``time-out``, ``other``, or ``undecided`` where time ran
    out on the way to one more goal.
    """
    goals: int
    """Goals that were reached."""
    length: int
    """Control steps."""
    sum_of_rewards: float
    """Its return."""
    scenario: dict[str, float]
    """Initial conditions, as far as known."""
    info: dict[str, tuple[float, ...]]
    """The numbers of its last info, such as ``goal`` and ``position`` (x, y) [m]."""
    ends: tuple[int, int, int]
    """1 for a collision, a time-out or another end of the last attempt, else 0."""
    counted_goals: int
    """Goals of attempts that count, see `Episodes`."""
    counted: bool
    """True if the last attempt counts."""
    place: EpisodePlace | None = None
    """Place in the evaluation, to play it again; None if workers played it."""

    @property
    def failed(self) -> bool:
        """True if the last attempt failed."""
        return any(self.ends)

    def to_row(self) -> dict[str, Any]:
        """Return one line of a table: plain values by column."""
        numbers = {
            name if len(values) == 1 else f"{name}_{_axis(axis, len(values))}": value
            for name, values in self.info.items()
            for axis, value in enumerate(values)
        }
        return {
            "outcome": self.outcome,
            "goals": self.goals,
            "length": self.length,
            "return": self.sum_of_rewards,
            **self.scenario,
            **{name: value for name, value in numbers.items() if not name.startswith("is_")},
        }


class Ledger:
    """Keeps a number of episodes of each copy that is fixed in advance, and no others.

    Args:
        together: Copies that share a world, side by side: how their episodes end hangs together.
        names: Of the numbers of a scenario, as far as the environment gives them names.

    Attributes:
        left: Episodes that each copy still has to run, shape (copies,).
        records: Those that ended.
    """

    def __init__(self, together: int = 1, names: tuple[str, ...] = ()) -> None:
        self.left: npt.NDArray[np.int64] = np.zeros(0, np.int64)
        self._expected = self.left
        self.records: list[EpisodeRecord] = []
        self._together = together
        self._names = names
        self._keys: list[bytes] = []
        self._worlds: list[int] = []
        self._first_world = 0
        self._resets = 0
        self._reported: set[str] = set()

    def expect(self, episodes: npt.NDArray[np.int64]) -> None:
        """Expect this number of further episodes of each copy, shape (copies,), in restarted worlds."""
        self._first_world += -(-len(self.left) // self._together)
        self.left, self._expected = episodes.copy(), episodes.copy()
        self._resets += 1

    @property
    def distinct(self) -> int:
        """Number of different episodes."""
        return len(set(self._keys))

    def reports(self, outcome: str) -> bool:
        """Return whether the environment reports this outcome."""
        return outcome in self._reported

    def add(self, ended: Episodes, trails: UInts64) -> None:
        """Add the episodes that ended in one step, with keys of their trails."""
        self._reported.update(ended.outcomes)
        for row, slot in enumerate(ended.slots):
            if not self.left[slot]:
                continue
            turn = int(self._expected[slot] - self.left[slot])
            self.left[slot] -= 1
            place = EpisodePlace(self._resets - 1, int(slot), turn)
            self.records.append(self._record(ended, row, place))
            # Without a scenario, an episode is identified by all its observations.
            scenarios = ended.scenarios
            self._keys.append(
                trails[row].tobytes() if scenarios is None else scenarios[row].tobytes()
            )
            self._worlds.append(self._first_world + int(slot) // self._together)

    def take_in(self, other: Ledger) -> None:
        """Add the episodes of another one."""
        self.records += other.records
        self._keys += other._keys
        first = max(self._worlds, default=-1) + 1
        self._worlds += [first + world for world in other._worlds]
        self._reported |= other._reported

    def rate(self, what: str) -> SuccessRate:
        """Return the rate of attempts that were ``goals``, or ended as `EpisodeRecord.ends` names."""
        ends = np.array([record.ends for record in self.records], dtype=np.int64)
        ends *= np.array([[record.counted] for record in self.records])
        goals = np.array([record.counted_goals for record in self.records], dtype=np.int64)
        if not self.reports("is_success"):
            goals = np.zeros_like(goals)
        counts = goals if what == "goals" else ends[:, _ENDS.index(what)]
        rate = clustered_rate if self._together == 1 else rate_between_worlds
        return rate(counts, goals + ends.sum(axis=1), self._clusters())

    def _clusters(self) -> npt.NDArray[np.int64]:
        """Return equal numbers for episodes that are equal, or were in equal worlds."""
        keys: list[bytes] = self._keys
        if self._together > 1:
            inside: dict[int, list[bytes]] = {}
            for world, key in zip(self._worlds, self._keys, strict=True):
                inside.setdefault(world, []).append(key)
            joined = {world: b"".join(sorted(keys)) for world, keys in inside.items()}
            keys = [joined[world] for world in self._worlds]
        numbers = {key: number for number, key in enumerate(dict.fromkeys(keys))}
        return np.array([numbers[key] for key in keys], dtype=np.int64)

    def _record(self, ended: Episodes, row: int, place: EpisodePlace) -> EpisodeRecord:
        ends = tuple(int(getattr(ended, name)[row]) for name in _ENDS)
        goals = int(ended.goals[row])
        failed = [_NAMES[name] for name, end in zip(_ENDS, ends, strict=True) if end]
        scenario = () if ended.scenarios is None else ended.scenarios[row].tolist()
        return EpisodeRecord(
            outcome=failed[0] if failed else "success" if ended.succeeded[row] else "undecided",
            goals=goals,
            length=int(ended.lengths[row]),
            sum_of_rewards=float(ended.returns[row]),
            scenario={self._name_of(i): value for i, value in enumerate(scenario)},
            info={name: tuple(np.atleast_1d(v[row]).tolist()) for name, v in ended.info.items()},
            ends=(ends[0], ends[1], ends[2]),
            counted_goals=int(ended.counted_goals[row]),
            counted=bool(ended.counted[row]),
            place=place,
        )

    def _name_of(self, index: int) -> str:
        return self._names[index] if index < len(self._names) else f"scenario_{index}"


def merged(ledgers: Sequence[Ledger]) -> Ledger:
    """Return one ledger of the episodes of several, in order."""
    whole = ledgers[0]
    for ledger in ledgers[1:]:
        whole.take_in(ledger)
    return whole


class Trail:
    """Sums up all that was seen in each running episode in one number, so that equal ones are found.

    Args:
        copies: Of the environment.
    """

    def __init__(self, copies: int) -> None:
        self._sums: UInts64 = np.zeros(copies, np.uint64)

    def follow(self, obs: npt.NDArray[np.float32], where: npt.NDArray[np.bool_]) -> None:
        """Add observations of copies, shape (copies, ...), that are part of their episodes."""
        self._sums = np.where(where, _mixed(self._sums, obs), self._sums)

    def end(self, ended: Episodes, final_obs: npt.NDArray[np.float32]) -> UInts64:
        """Return the sums of episodes that ended with these last observations; they start again."""
        sums = _mixed(self._sums[ended.slots], final_obs)
        sums ^= ended.returns.view(np.uint64)
        self._sums[ended.slots] = 0
        return sums


def _mixed(sums: UInts64, obs: npt.NDArray[np.float32]) -> UInts64:
    """Return hashes that depend on every bit of observations (multiply and shift, modulo 2^64)."""
    bits = np.ascontiguousarray(obs, np.float32).reshape(len(obs), -1).view(np.uint32)
    odds = np.arange(1, 2 * bits.shape[1], 2, dtype=np.uint64) * _ODD
    mixed = (sums + np.uint64(1)) * _ODD + (bits.astype(np.uint64) * odds).sum(axis=1)
    mixed ^= mixed >> np.uint64(29)
    result: UInts64 = mixed * _ODD
    return result


def _axis(index: int, size: int) -> str:
    """Return ``x``, ``y`` and ``z`` for places, numbers for more."""
    return "xyz"[index] if size <= 3 else str(index)
