"""Make new bags of old ones: filtered, compressed, reindexed; and check them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from gazelle_ros.bags.errors import BagError
from gazelle_ros.bags.reader import BagReader, RawBagMessage, messages_of
from gazelle_ros.bags.records import Connection
from gazelle_ros.bags.scanning import BagScan, scan
from gazelle_ros.bags.writer import BagWriter
from gazelle_ros.base.errors import Error
from gazelle_ros.base.writing import replacing
from gazelle_ros.clock import SECOND
from gazelle_ros.expressions import compiled
from gazelle_ros.messages import load_message
from gazelle_ros.time import Time
from gazelle_ros.typed import class_for

Keep = Callable[[str, Any, Time], bool]
"""Takes topic, message and time."""


def compile_filter(expression: str) -> Keep:
    """Compile a function of ``topic``, ``m`` and ``t`` from a Python expression.

    Raises:
        BagError: It is not an expression; and by the function where it fails.
    """
    value = compiled(expression, BagError)

    def keep(topic: str, message: Any, stamp: Time) -> Any:
        return value(topic=topic, m=message, t=stamp)

    return keep


def filter_bag(
    source: str, target: str, keep: Keep, show: Callable[[bool, str, Any, Time], None] | None = None
) -> tuple[int, int]:
    """Copy the messages for which `keep` is true.

    Args:
        source: A bag.
        target: The bag to write.
        keep: Chooses.
        show: Called with each message, and whether it is kept.

    Returns:
        How many messages were kept, and how many there were.

    Raises:
        BagError: The source is not a bag, or is the target too.
    """
    if Path(source).resolve() == Path(target).resolve():
        raise BagError("a bag cannot be filtered into itself", file=source)
    kept = total = 0
    reader = BagReader(source)
    try:
        with _copying(Path(target)) as copy:
            for entry in reader.messages():
                total += 1
                connection = entry.connection
                message = class_for(connection.header)().deserialize(entry.data)
                stamp = Time(*divmod(entry.time, SECOND))
                good = bool(keep(connection.topic, message, stamp))
                if show is not None:
                    show(good, connection.topic, message, stamp)
                if good:
                    kept += 1
                    copy(entry)
    finally:
        reader.close()
    return kept, total


@contextmanager
def _copying(target: Path, compression: str = "none") -> Iterator[Callable[[RawBagMessage], None]]:
    """Write a bag entry by entry; it gets its name when it is complete."""
    known: dict[int, Connection] = {}
    with replacing(target) as draft, draft.open("w+b") as stream:
        writer = BagWriter(stream, compression=compression)

        def copy(entry: RawBagMessage) -> None:
            connection = known.get(entry.connection.id)
            if connection is None:
                old = entry.connection
                connection = known[old.id] = writer.connect(old.topic, old.header)
            writer.write(connection, entry.time, entry.data)

        yield copy
        writer.close()


def recompress(path: str, compression: str, *, folder: str = "", force: bool = False) -> Path:
    """Compress a bag, or undo it; the old one is kept as ``NAME.orig.bag``.

    Returns:
        Where the old bag is now.

    Raises:
        BagError: It is not a bag, or there is an old one already.
    """
    reader = BagReader(path)
    try:
        return _replace(Path(path), reader.messages(), compression, folder=folder, force=force)
    finally:
        reader.close()


def reindex(path: str, *, folder: str = "", force: bool = False) -> tuple[Path, BagScan]:
    """Repair a truncated bag; the old one is kept as ``NAME.orig.bag``.

    Returns:
        Where the old bag is now, and what was found in it.

    Raises:
        BagError: It is not a bag, or there is an old one already.
    """
    reader = BagReader(path, allow_unindexed=True)
    try:
        found = scan(reader.file.view(), reader.begin)
        entries = messages_of(reader.file, found.index)
        old = _replace(Path(path), entries, "none", folder=folder, force=force)
    finally:
        reader.close()
    return old, found


def _replace(
    path: Path, entries: Iterable[RawBagMessage], compression: str, *, folder: str, force: bool
) -> Path:
    target = Path(folder) / path.name if folder else path
    name = path.name.removesuffix(".active")
    backup = path.with_name(f"{name.removesuffix('.bag')}.orig.bag")
    if not folder and backup.exists() and not force:
        raise BagError(
            f"the backup {backup} exists already", file=str(path), hint="--force overwrites it"
        )
    made = target.with_name(name + ".new")
    with _copying(made, compression) as copy:
        for entry in entries:
            copy(entry)
    if folder:
        made.replace(target.with_name(name))
        return path
    path.replace(backup)
    made.replace(path.with_name(name))
    return backup


def fix_bag(source: str, target: str, *, force: bool = False) -> list[str]:
    """Copy a bag with the types known here.

    Rules that turn messages of old types into new ones are not run: where types differ nothing is copied,
    or with `force` all as it is.

    Args:
        source: A bag.
        target: The bag to write.
        force: Copy although types differ.

    Returns:
        What differs; see `check`.

    Raises:
        BagError: The source is not a bag, or is the target too.
    """
    problems = check(source)
    if problems and not force:
        return problems
    if Path(source).resolve() == Path(target).resolve():
        raise BagError("a bag cannot be copied onto itself", file=source)
    reader = BagReader(source)
    try:
        with _copying(Path(target)) as copy:
            for entry in reader.messages():
                copy(entry)
    finally:
        reader.close()
    return problems


def check(path: str) -> list[str]:
    """List problems of a bag's types with the definitions known here, one line each.

    Raises:
        BagError: It is not a bag.
    """
    reader = BagReader(path)
    try:
        connections = list(reader.index.connections.values())
    finally:
        reader.close()
    problems = []
    for kind, checksum in sorted({(each.type, each.md5sum) for each in connections}):
        try:
            known = load_message(kind)
        except Error:
            problems.append(f"{kind} [{checksum}] is not known here")
            continue
        mine = known._md5sum
        if mine != checksum:
            problems.append(f"{kind} [{checksum}] is [{mine}] here")
    return problems
