"""Closes what is still open when the program ends."""

from __future__ import annotations

import atexit
import threading
import weakref
from typing import Any


class Closer:
    """Objects to close at the end, by the numbers they got."""

    def __init__(self, atexit_register: bool = True) -> None:  # noqa: FBT001, FBT002  # gym's name
        self.lock = threading.Lock()
        self.next_id = -1
        self.closeables: weakref.WeakValueDictionary[int, Any] = weakref.WeakValueDictionary()
        if atexit_register:
            atexit.register(self.close)

    def generate_next_id(self) -> int:
        """Return a number that nothing has."""
        with self.lock:
            self.next_id += 1
            return self.next_id

    def register(self, closeable: Any) -> int:
        """Close something at the end; returns its number."""
        number = self.generate_next_id()
        self.closeables[number] = closeable
        return number

    def unregister(self, id: int | None) -> None:  # noqa: A002  # gym's name
        """Unregister the object of a number."""
        if id is not None:
            self.closeables.pop(id, None)

    def close(self) -> None:
        """Close everything now."""
        for closeable in list(self.closeables.values()):
            closeable.close()
