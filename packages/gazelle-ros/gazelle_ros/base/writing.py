"""Files that are written whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from gazelle_ros.base.closing import Closeable


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a file to write, which replaces another once it is whole.

    It lies beside the other, with the same suffix. After an error it is gone, and the other as it
    was. What is not a regular file, such as ``/dev/stdout``, is written directly.

    Args:
        path: The file that is to be there at the end; a link stays one.

    Raises:
        OSError: It cannot be written; the error names ``path``.
    """
    file = Path(os.path.realpath(path))
    if file.exists() and not file.is_file():
        with naming(path):
            yield file
        return
    draft = file.with_name(f".{file.stem}.part{file.suffix}")
    try:
        with naming(path, draft):
            yield draft
            if file.exists():
                shutil.copymode(file, draft)
            draft.replace(file)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


class GrowingFile(Closeable):
    """A file that grows by whole pieces: one that finds no room leaves nothing behind.

    Args:
        path: Pieces are added to what is there.

    Raises:
        OSError: It cannot be opened.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = path
        self._file = Path(path).open("ab", buffering=0)  # noqa: SIM115  # closed in `close`

    def write(self, data: bytes) -> None:
        """Add a piece.

        Raises:
            OSError: It cannot be written; the error names the file.
        """
        begin, left = os.fstat(self._file.fileno()).st_size, memoryview(data)
        try:
            with naming(self._path):
                while left:
                    left = left[self._file.write(left) :]
        except OSError:
            with contextlib.suppress(OSError):  # as of what is not a regular file
                os.truncate(self._file.fileno(), begin)
            raise

    def close(self) -> None:
        """Close the file; a second call does nothing."""
        self._file.close()


@contextlib.contextmanager
def naming(path: str | os.PathLike[str], draft: Path | None = None) -> Iterator[None]:
    """Add a file's name to system errors that name none or only its draft.

    Raises:
        OSError: As in the block.
    """
    try:
        yield
    except OSError as error:
        if error.filename is not None and error.filename not in {draft, str(draft)}:
            raise
        number = error.errno or errno.EIO
        raise OSError(number, error.strerror or str(error), os.fspath(path)) from error


def write_bytes(path: str | os.PathLike[str], data: bytes) -> None:
    """Write a whole file or nothing.

    Raises:
        OSError: It cannot be written.
    """
    with replacing(path) as draft:
        draft.write_bytes(data)


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a whole file in UTF-8 or nothing.

    Raises:
        OSError: It cannot be written.
    """
    write_bytes(path, text.encode())
