"""Count how many description files `gazelle convert` and libsdformat make the same of.

Every SDF, URDF and xacro file of some folders is written as SDF by both, and what they write is
compared value by value, as tests/formats/test_oracle.py does it. Needs `ign sdf` (Debian:
libsdformat-dev ignition-tools). A share of many files is `--part 1/10`.

    python tools/compare_libsdformat.py ../shared/corpus
"""

from __future__ import annotations

import argparse
import collections
import re
import sys
import tempfile
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree.ElementTree import ParseError

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "formats")]

EQUAL = "equal"
DIFFERENT = ("different joint types", "different")
FAULTY = "different, of a file that `ign sdf -k` finds wrong"


@dataclass
class Outcome:
    """What became of one file."""

    said: str
    found: list[str] = field(default_factory=list)


def main() -> None:
    """Print what became of how many files, and what differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=lambda text: Path(text).absolute())
    parser.add_argument("--part", default="1/1", metavar="K/N", help="only the Kth of N shares")
    parser.add_argument("--most", type=int, default=3, help="differences shown of a file")
    args = parser.parse_args()
    part, parts = map(int, args.part.split("/"))
    counted: collections.Counter[str] = collections.Counter()
    for folder in args.folders:
        roots = sorted({str(config.parent.parent) for config in folder.rglob("model.config")})
        for path in files(folder)[part - 1 :: parts]:
            outcome = judged(path, folder, roots)
            counted[outcome.said] += 1
            for line in [f"{outcome.said}: {path}", *outcome.found][: args.most + 1]:
                if outcome.found:
                    print(line if line.startswith(outcome.said) else f"    {line}", flush=True)
    show(counted)


def files(folder: Path) -> list[Path]:
    """Return the description files below a folder."""
    import corpus_table

    return corpus_table.files(folder, "sdf", "world", "urdf", "xacro")


def judged(path: Path, folder: Path, roots: list[str]) -> Outcome:
    """Return both results for a file; Gazelle expands xacro for both."""
    import test_oracle

    from gazelle import Error

    with tempfile.TemporaryDirectory() as scratch:
        file = path
        if path.suffix == ".xacro":
            file = Path(scratch) / "robot.urdf"
            try:
                text = test_oracle.expanded(path, folder)
            except Error:
                return Outcome("no xacro that can be expanded alone")
            if not re.search(r"<robot[^>]* name=", text) or "<link" not in text:
                return Outcome("xacro without a robot")
            file.write_text(text, encoding="utf-8")
        if file.suffix == ".urdf":
            return compared(path, [folder], test_oracle.oracle(file, roots), robot=True)
        return compared(path, roots, test_oracle.oracle(file, roots), robot=False)


def compared(
    file: Path, paths: list[Path] | list[str], theirs: str | None, *, robot: bool
) -> Outcome:
    """Return whether Gazelle writes the same as libsdformat."""
    import test_oracle

    if theirs is None or ("<link" if robot else "<") not in theirs:
        theirs = None  # robots of which libsdformat drops everything, as they weigh nothing
    ours = written(file, paths, is_world="<world" in (theirs or ""))
    if isinstance(ours, Outcome):
        return Outcome("refused by both") if theirs is None and ours.found else ours
    if theirs is None:
        return Outcome("refused by libsdformat alone")
    try:
        found = test_oracle.compared(ours, theirs)
    except (ParseError, KeyError, RecursionError) as error:
        said = f"{type(error).__name__}: {error}"[:100]
        return Outcome("unreadable from libsdformat", [said])  # no XML, or frames that are not
    found = found if robot else test_oracle.unexpected(found)
    if not found:
        return Outcome(EQUAL)
    if not robot and test_oracle.complaints(file):
        return Outcome(FAULTY, found)
    types = any(re.search(r"/joint\[[^/]*\]@type", line) for line in found)
    return Outcome(DIFFERENT[0] if types else DIFFERENT[1], found)


def written(file: Path, paths: list[Path] | list[str], *, is_world: bool) -> str | Outcome:
    """Return the file as Gazelle writes it."""
    from gazelle import Error, formats

    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        try:
            world = formats.load(file, paths=paths)
            if not (is_world or world.models):
                return Outcome("without a model")
            content = world if is_world else world.models[0]
            text = formats.to_string(content, "sdf", folder=file.parent)
        except Error as error:
            return Outcome("refused by Gazelle alone", [str(error)])
    if file.suffix not in {".urdf", ".xacro"} and any(
        "not found" in str(each.message) for each in notes
    ):
        return Outcome("includes what is not there")
    return text


def show(counted: collections.Counter[str]) -> None:
    """Print the counts, and the share that is equal."""
    for said, count in counted.most_common():
        print(f"{count:6d} {said}")
    total = sum(counted[said] for said in (EQUAL, *DIFFERENT))
    if total:
        print(f"equal: {counted[EQUAL]} of {total}, {100.0 * counted[EQUAL] / total:.1f} %")


if __name__ == "__main__":
    main()
