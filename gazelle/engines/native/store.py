"""Where machine code is kept between runs: a file a kernel, named after all it depends on."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
from pathlib import Path
from typing import Final

_MOST: Final = 400  # files
_CHECK: Final = 32  # bytes of a hash before the code


def folder() -> Path:
    """``GAZELLE_CACHE_DIR``, else ``gazelle/kernels`` in the user's cache."""
    own = os.environ.get("GAZELLE_CACHE_DIR")
    if own:
        return Path(own)
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "gazelle" / "kernels"


def read(key: str) -> bytes | None:
    """What is kept under a key; None if nothing, or if it is damaged."""
    with contextlib.suppress(OSError, RuntimeError):
        kept = (folder() / f"{key}.o").read_bytes()
        check, code = kept[:_CHECK], kept[_CHECK:]
        return code if hashlib.sha256(code).digest() == check else None
    return None


def write(key: str, code: bytes) -> None:
    """Keep something; without a place to keep it, it is made again next time."""
    with contextlib.suppress(OSError, RuntimeError):  # the latter: there is no home
        folder().mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=folder())
        with os.fdopen(handle, "wb") as file:
            file.write(hashlib.sha256(code).digest() + code)
        Path(name).replace(folder() / f"{key}.o")
        _tidy(folder())


def _tidy(place: Path) -> None:
    """Drop what was made longest ago: kernels of sources that have changed since."""
    files = sorted(place.glob("*.o"), key=lambda file: file.stat().st_mtime)
    for file in files[:-_MOST]:
        file.unlink(missing_ok=True)
