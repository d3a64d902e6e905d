"""Random numbers that depend on nothing but their address.

A draw is addressed by a seed, a stream (which sensor, which task), a world and a counter.
World 7's numbers are the same whether it runs alone or among a thousand others, and the
whole batch is drawn without a loop: the generator is a hash of the address, SplitMix64
(Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014),
which passes BigCrush.
"""

from __future__ import annotations

import hashlib
import operator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, UInts64
from gazelle.errors import SimulationError
from gazelle.native.white_noise import draw_normal, draw_uniform

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)
_BY_30, _BY_27, _BY_31 = (np.uint64(bits) for bits in (30, 27, 31))


class Stream:
    """One source of random numbers for every world of a batch.

    Args:
        seed: The run's seed, any int.
        name: Purpose of the numbers; different names give independent numbers.
        nworld: Number of worlds.
    """

    def __init__(self, seed: int, name: str, nworld: int) -> None:
        self._name = name
        self._keys = _keys_of(seed, name, nworld)
        self._counters = np.zeros(nworld, dtype=np.uint64)

    @property
    def keys(self) -> UInts64:
        """Keys of the worlds' random numbers, shape (nworld,); writable, for restoring."""
        return self._keys

    @property
    def counters(self) -> UInts64:
        """Number of draws of each world, shape (nworld,); writable, for restoring."""
        return self._counters

    def move(self, keys: UInts64, counters: UInts64) -> None:
        """Store keys and counters in other arrays from now on, shapes (nworld,)."""
        keys[:], counters[:] = self._keys, self._counters
        self._keys, self._counters = keys, counters

    def rewind(self, worlds: NDArray[np.intp] | None = None) -> None:
        """Start over in these worlds (all if None), as if nothing had been drawn."""
        self._counters[slice(None) if worlds is None else worlds] = 0

    def reseed(self, seed: int, worlds: NDArray[np.intp] | None = None) -> None:
        """Start over in these worlds (all if None) as a stream made with another seed."""
        chosen = slice(None) if worlds is None else worlds
        self._keys[chosen] = _keys_of(seed, self._name, len(self._keys))[chosen]
        self._counters[chosen] = 0

    def uniform(self, size: int, worlds: NDArray[np.intp] | None = None) -> Floats:
        """Return uniform numbers in [0, 1), shape (n, size), n the number of requested worlds."""
        keys, counters = self._of(worlds)
        drawn = np.empty((len(keys), size))
        draw_uniform(keys, counters, drawn)
        if worlds is not None:
            self._counters[worlds] = counters
        return drawn

    def normal(self, size: int, worlds: NDArray[np.intp] | None = None) -> Floats:
        """Return standard normal numbers, shape (n, size), by Box and Muller's transform (1958).

        They are as that says to 1e-13, and the same bits on any processor.
        """
        keys, counters = self._of(worlds)
        drawn = np.empty((len(keys), size + size % 2))
        draw_normal(keys, counters, size, drawn)
        if worlds is not None:
            self._counters[worlds] = counters
        return drawn[:, :size]

    def _of(self, worlds: NDArray[np.intp] | None) -> tuple[UInts64, UInts64]:
        """Return keys and counters of worlds; of all, the counters themselves."""
        if worlds is None:
            return self._keys, self._counters
        return self._keys[worlds], self._counters[worlds]

    def integers(
        self, high: int, size: int, worlds: NDArray[np.intp] | None = None
    ) -> NDArray[np.intp]:
        """Return ints in [0, high), shape (n, size)."""
        return (self.uniform(size, worlds) * high).astype(np.intp)


def seed_of(seed: Any) -> int:
    """Return a valid seed of random numbers: any int.

    Raises:
        SimulationError: It is none.
    """
    try:
        return operator.index(seed)
    except TypeError:
        raise SimulationError(
            f"a seed must be an int, not {seed!r}", hint="such as 0 or 42"
        ) from None


def _keys_of(seed: int, name: str, nworld: int) -> UInts64:
    digest = hashlib.blake2b(
        f"{seed_of(seed)}:{name}".encode(errors="surrogatepass"), digest_size=8
    ).digest()
    worlds = np.arange(1, nworld + 1, dtype=np.uint64)
    return _mix(_mix(worlds * _GOLDEN) + np.uint64(int.from_bytes(digest)))


def _mix(z: UInts64) -> UInts64:
    """Compute SplitMix64's output function, in place."""
    z ^= z >> _BY_30
    z *= _MIX_1
    z ^= z >> _BY_27
    z *= _MIX_2
    z ^= z >> _BY_31
    return z
