"""Where machine code is kept between runs: a file a kernel, named after all it depends on.

What is kept is run, so it is read only from folders and files that nobody else can write.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import stat
import tempfile
import time
import warnings
from pathlib import Path
from typing import Final

from gazelle.errors import EngineWarning

_MOST: Final = 400  # files
_CHECK: Final = 32  # bytes of a hash before the code
_LOST: Final = 3600.0  # [s], after which a file is not being written any more
_OTHERS: Final = stat.S_IWGRP | stat.S_IWOTH


def folder() -> Path | None:
    """``GAZELLE_CACHE_DIR``, else ``gazelle/kernels`` in the user's cache.

    Where that cannot be, a folder of the user's own among temporary files; None without any.
    """
    own, base = os.environ.get("GAZELLE_CACHE_DIR"), os.environ.get("XDG_CACHE_HOME")
    wanted: Path | None = None
    with contextlib.suppress(RuntimeError):  # there is no home
        wanted = Path(own) if own else Path(base or Path.home() / ".cache") / "gazelle/kernels"
    user = os.getuid() if hasattr(os, "getuid") else "own"
    return _chosen(wanted, Path(tempfile.gettempdir()) / f"gazelle-kernels-{user}")


@functools.cache
def _chosen(wanted: Path | None, spare: Path) -> Path | None:
    """The first of two folders that can be had and trusted; one warning if that is amiss."""
    reason = "there is no home" if wanted is None else _made(wanted)
    if reason is None:
        return wanted
    unsafe = wanted is not None and wanted.is_dir()
    other = "it is a link" if spare.is_symlink() else _made(spare)
    if unsafe or other is not None:
        reasons = reason if other is None else f"{reason}, and {other}"
        where = spare if other is None else "memory only, and compiled by every process"
        warnings.warn(
            f"machine code of kernels is kept in {where}: {reasons}; GAZELLE_CACHE_DIR may name "
            "a folder that only you can write",
            EngineWarning,
            stacklevel=2,
        )
    return spare if other is None else None


def _made(place: Path) -> str | None:
    """Make a folder if need be; why it is not to be used, if so."""
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        if _is_safe(place.stat()):
            return None
    except OSError as error:
        return f"{place} cannot be made ({error.strerror})"
    return f"others can write to {place}"


def _is_safe(state: os.stat_result) -> bool:
    """Whether only this user, or the administrator, can write something."""
    if not hasattr(os, "getuid"):  # Windows keeps users' folders apart by other means
        return True
    return state.st_uid in (os.getuid(), 0) and not state.st_mode & _OTHERS


def read(key: str) -> bytes | None:
    """What is kept under a key; None if nothing, or if it is damaged."""
    place = folder()
    if place is None:
        return None
    with contextlib.suppress(OSError), (place / f"{key}.o").open("rb") as file:
        if not _is_safe(os.fstat(file.fileno())):
            return None
        kept = file.read()
        check, code = kept[:_CHECK], kept[_CHECK:]
        return code if hashlib.sha256(code).digest() == check else None
    return None


def write(key: str, code: bytes) -> None:
    """Keep something; without a place to keep it, it is made again next time.

    Others that keep the same at once do no harm: a file gets its name when it is complete.
    """
    place = folder()
    if place is None:
        return
    with contextlib.suppress(OSError):
        handle, name = tempfile.mkstemp(dir=place, suffix=".part")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(hashlib.sha256(code).digest() + code)
            Path(name).replace(place / f"{key}.o")
        except OSError:
            Path(name).unlink(missing_ok=True)
        _tidy(place)


def _tidy(place: Path) -> None:
    """Drop what was made longest ago: kernels of sources that have changed since."""
    files = sorted(place.glob("*.o"), key=lambda file: file.stat().st_mtime)
    lost = [file for file in place.glob("*.part") if file.stat().st_mtime < time.time() - _LOST]
    for file in [*files[:-_MOST], *lost]:
        file.unlink(missing_ok=True)
