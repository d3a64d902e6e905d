"""Count how many description files `gazelle convert` and libsdformat make the same of.

Every SDF, URDF and xacro file of some folders is written as SDF by both, and what they write is compared
value by value, as tests/formats/test_oracle.py does it. Needs `ign sdf` (Debian: libsdformat-dev
ignition-tools). A share of many files is `--part 1/10`.

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

MOST_SHOWN = 3


@dataclass
class Outcome:
    """What became of one file."""

    said: str
    found: list[str] = field(default_factory=list)


def main() -> None:
    """Print what became of how many files, and what differs."""
    args = _arguments()
    part, parts = map(int, args.part.split("/"))
    counted: collections.Counter[str] = collections.Counter()
    for folder in args.folders:
        roots = sorted({str(config.parent.parent) for config in folder.rglob("model.config")})
        for path in _files(folder)[part - 1 :: parts]:
            outcome = _judged(path, folder, roots)
            counted[outcome.said] += 1
            if outcome.found or args.verbose:
                print(f"{outcome.said}: {path.relative_to(folder)}")
            for line in outcome.found[: args.most]:
                print(f"    {line}")
    _print_shares(counted)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=lambda text: Path(text).absolute())
    parser.add_argument("--part", default="1/1", metavar="K/N", help="only the Kth of N shares")
    parser.add_argument("--most", type=int, default=MOST_SHOWN, help="lines shown of a file")
    parser.add_argument("--verbose", action="store_true", help="name every file")
    return parser.parse_args()


def _files(folder: Path) -> list[Path]:
    import corpus_table

    return corpus_table.files(folder, "sdf", "world", "urdf", "xacro")


def _judged(path: Path, folder: Path, roots: list[str]) -> Outcome:
    with tempfile.TemporaryDirectory() as scratch, warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        try:
            return _compared(path, folder, roots, Path(scratch), notes)
        except (ParseError, KeyError, RecursionError) as error:
            # libsdformat printed what is no XML, or a frame that is not there
            return Outcome("unreadable from libsdformat", [f"{type(error).__name__}: {error}"[:200]])


def _compared(path, folder, roots, scratch, notes) -> Outcome:
    from test_oracle import compared, complaints, expanded, oracle, unexpected

    from gazelle import Error, formats

    robot = path.suffix in {".urdf", ".xacro"}
    file = path
    if path.suffix == ".xacro":
        try:
            text = expanded(path, folder)
        except Error as error:
            return Outcome("xacro that cannot be expanded alone")
        if not re.search(r"<robot[^>]* name=", text) or "<link" not in text:
            return Outcome("xacro without a robot")
        file = scratch / "robot.urdf"
        file.write_text(text)
    theirs = oracle(file, roots)
    if theirs is not None and not re.search("<(link|model|world|actor|light)", theirs):
        theirs = None
    try:
        world = formats.load(file, paths=[folder] if robot else roots)
        is_world = theirs is not None and "<world" in theirs
        content = world if is_world else world.models[0]
        ours = formats.to_string(content, "sdf", folder=file.parent)
    except (Error, IndexError) as error:
        if theirs is None:
            return Outcome("refused by both")
        return Outcome("refused by Gazelle alone", [str(error)])
    if theirs is None:
        return Outcome("refused by libsdformat alone")
    if not robot and any("not found" in str(each.message) for each in notes):
        return Outcome("includes what is not there")
    found = compared(ours, theirs)
    found = found if robot else unexpected(found)
    if found and not robot and complaints(file):
        return Outcome("different, with an error of `ign sdf -k`", found)
    if any(re.search(r"/joint\[[^/]*\]@type", line) for line in found):
        return Outcome("different joint types", found)
    return Outcome("different" if found else "equal", found)


def _print_shares(counted: collections.Counter[str]) -> None:
    for said, count in counted.most_common():
        print(f"{count:6d} {said}")
    compared = sum(counted[said] for said in ("equal", "different", "different joint types"))
    if compared:
        print(f"equal: {counted['equal']} of {compared}, {100.0 * counted['equal'] / compared:.1f} %")


if __name__ == "__main__":
    main()
