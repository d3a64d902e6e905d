"""A training run as one file, to send and to keep.

The file is a ZIP archive of the run's folder with its newest checkpoint. It may be untrusted: only
files that a run consists of are unpacked, none of them holds Python objects, and code that a run
names is imported only by a user who trusts it (`gazelle.training.trust`).
"""

from __future__ import annotations

import re
import shutil
import stat
import zipfile
from pathlib import Path

from gazelle.argument_checks import checked
from gazelle.bounded_npz import BROKEN
from gazelle.errors import FormatError, TaskError
from gazelle.formats.limits import refuse_special
from gazelle.training.runs import Run, new_folder
from gazelle_ros.base.writing import replacing

MAX_BYTES = 4 << 30
"""Size of all files of a run together, unpacked."""
MAX_FILES = 1000
"""Number of its files."""

_CONFIG = "config.json"
_OTHERS = re.compile(
    r"(contract\.json|progress\.csv|evaluations\.csv|policy\.npz|best\.npz"
    r"|tensorboard/events[\w.-]*"
    r"|checkpoints/\d{1,15}/(learner\.pt|state\.json|state\.npz|policy\.npz))",
    re.ASCII,
)
_NAME = re.compile(r"\w[\w.-]{0,127}", re.ASCII)


@checked(TaskError)
def pack_run(run: str | Path, file: str | Path) -> Path:
    """Write a run into one file.

    Args:
        run: The run's folder.
        file: The archive, ``.zip``; one of this name is replaced.

    Returns:
        The archive.

    Raises:
        FormatError: There is no run, or its folder has a name that no archive can hold.
        TaskError: The file cannot be written.
    """
    found = Run.open(Path(run))
    name, target = found.folder.resolve().name, Path(file)
    if target.suffix != ".zip":
        raise TaskError(f"a run is written as .zip, not as '{target.suffix}'")
    if not _NAME.fullmatch(name):
        raise FormatError(f"'{name}' is not a name for a run in an archive", file=str(run))
    old = {path.name for path in found.checkpoints()[:-1]}
    try:
        with (
            replacing(target) as draft,
            zipfile.ZipFile(draft, "w", zipfile.ZIP_DEFLATED) as archive,
        ):
            for path in sorted(found.folder.rglob("*")):
                inner = path.relative_to(found.folder)
                known = str(inner) == _CONFIG or _OTHERS.fullmatch(inner.as_posix())
                if known and path.is_file() and not old.intersection(inner.parts):
                    archive.write(path, f"{name}/{inner.as_posix()}")
    except (OSError, zipfile.LargeZipFile) as error:
        raise TaskError(f"cannot write the archive: {error}") from error
    return target


@checked(TaskError)
def unpack_run(file: str | Path, out: str | Path = "runs") -> Run:
    """Unpack a run that `pack_run` wrote, into a new folder.

    Nothing is imported or executed.

    Args:
        file: The archive.
        out: Parent folder of the run; another run of its name stays as it is.

    Raises:
        FormatError: The file is damaged or no run, is too large, or has other files in it.
        TaskError: The folder cannot be written.
    """
    source = Path(file)
    refuse_special(source)
    try:
        with zipfile.ZipFile(source) as archive:
            name, members = _members(archive)
            folder = new_folder(Path(out), name)
            try:
                return _unpacked(archive, members, folder)
            except BaseException:
                shutil.rmtree(folder, ignore_errors=True)
                raise
    except FormatError as error:
        raise FormatError(error.message, file=str(source), hint=error.hint) from error
    except OSError as error:
        if not source.is_file():
            raise FormatError("there is no such file", file=str(source)) from error
        reason, hint = error.strerror or error, "give another folder, or free some space"
        raise TaskError(f"cannot unpack the run: {reason}", file=str(out), hint=hint) from error
    except BROKEN as error:
        raise FormatError(f"not a run's archive: {error}", file=str(source)) from error


def _members(archive: zipfile.ZipFile) -> tuple[str, dict[str, zipfile.ZipInfo]]:
    """Return the name of the run, and its files by their places in its folder.

    Raises:
        FormatError: The archive has anything else in it, or too much.
    """
    listed = archive.infolist()
    if len(listed) > MAX_FILES:
        raise FormatError(f"a run has at most {MAX_FILES:,} files, this {len(listed):,}")
    total = sum(member.file_size for member in listed)
    if total > MAX_BYTES:
        raise FormatError(f"it unpacks to {total:,} bytes, more than the limit of {MAX_BYTES:,}")
    names, members = set(), {}
    for member in listed:
        name, _, inner = member.filename.partition("/")
        kind = stat.S_IFMT(member.external_attr >> 16)
        known = inner == _CONFIG or _OTHERS.fullmatch(inner)
        if not _NAME.fullmatch(name) or not known or kind not in (0, stat.S_IFREG):
            raise FormatError(f"it has '{member.filename}', which is not a file of a run")
        names.add(name)
        if inner in members:
            raise FormatError(f"it has '{member.filename}' twice")
        members[inner] = member
    if len(names) != 1 or _CONFIG not in members:
        raise FormatError("it is not the archive of one run", hint="'gazelle export' writes one")
    return names.pop(), members


def _unpacked(archive: zipfile.ZipFile, members: dict[str, zipfile.ZipInfo], folder: Path) -> Run:
    """Unpack the files; the configuration last, as a folder without it is not a run."""
    (folder / "checkpoints").mkdir()
    for inner, member in sorted(members.items(), key=lambda pair: pair[0] == _CONFIG):
        target = folder / inner
        target.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as packed, target.open("xb") as unpacked:
            shutil.copyfileobj(packed, unpacked)
    return Run.open(folder)
