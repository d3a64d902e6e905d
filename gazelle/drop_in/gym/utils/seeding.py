"""Random numbers of environments."""

from __future__ import annotations

import hashlib
import secrets

import numpy as np

from gazelle.drop_in.gym.error import Error

RandomNumberGenerator = RNG = np.random.RandomState
_SEEDS = 2**32


def np_random(seed: int | None = None) -> tuple[np.random.RandomState, int]:
    """Return a random number generator, and its seed.

    Args:
        seed: Not negative; drawn if None.

    Raises:
        Error: It is no such number.
    """
    if seed is not None and (not isinstance(seed, int | np.integer) or seed < 0):
        raise Error(f"a seed is an integer, 0 or more, or None; not {seed!r}")
    used = create_seed(seed)
    # NumPy's older generator, for scripts call its rand, randint and random_sample.
    return np.random.RandomState(used % _SEEDS), used


def hash_seed(seed: int | None = None, max_bytes: int = 8) -> int:
    """Return a seed of which neighbours give unlike numbers."""
    digest = hashlib.sha512(str(create_seed(seed, max_bytes)).encode()).digest()
    return int.from_bytes(digest[:max_bytes], "little")


def create_seed(a: int | None = None, max_bytes: int = 8) -> int:
    """Return the seed itself, or a random one."""
    return secrets.randbits(8 * max_bytes) if a is None else int(a)
