"""Break files of every kind that Gazelle reads, do with them what people do, and count what went wrong.

    python tools/mutate_files.py ../shared/corpus gazelle/assets --count 10000

Good are a result and an error of Gazelle's. Wrong are any other error, the end of the process, over 20 s of
processor time (or 300 s by the clock, as others may keep the machine busy) and over 2 GB of memory.
Files are read one after the other in a process of its own. Those that go wrong are kept in the folder that `--keep` names, grouped by kind, with
a copy of the files beside them; `--again FOLDER` reads those again.
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import faulthandler
import functools
import multiprocessing
import os
import random
import shutil
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests" / "formats"))

import mutated_seeds  # noqa: E402  # found there
import structured_mutations  # noqa: E402
from mutated_ros_readers import READERS  # noqa: E402
from mutated_seeds import Seed  # noqa: E402

GOOD, REFUSED, FOREIGN, DIED, LATE, LARGE = (
    "read",
    "refused",
    "foreign",
    "died",
    "too slow",
    "too large",
)
WRONG = (FOREIGN, DIED, LATE, LARGE)
SECONDS, CLOCK_S = 20.0, 300.0
BYTES = 2 * 2**30
POLL_S = 0.02
SLOW_SEED_S = 2.0
"""A seed that takes longer than this, unbroken, is left out: its broken copies would take the time of others."""
LEAST_WEIGHT = 6.0
"""Of a reader of few files, of which one is as likely to be wrong."""
SHOWN = 300
MOST_BESIDE = 2**21
"""Of what is beside a file, so much is copied with it [bytes]."""


@dataclass
class Outcome:
    """Outcome of a file.

    Attributes:
        said: One of the words above.
        kind: Where the error comes from, of those that are wrong.
        seconds: Of the processor.
        size: Memory at most [bytes].
        error: In full.
    """

    said: str
    kind: str = ""
    seconds: float = 0.0
    size: int = 0
    error: str = ""


class Reader:
    """A process that reads one file after the other, started again whenever it is ended."""

    def __init__(self, folders: list[Path]) -> None:
        self._folders = folders
        self._process: multiprocessing.process.BaseProcess | None = None
        self._pipe: Connection | None = None
        self._stacks = tempfile.NamedTemporaryFile(prefix="stacks")  # noqa: SIM115  # closed in `close`

    def read(self, reader: str, file: Path) -> Outcome:
        """Read a file as one of the readers."""
        pipe, pid = self._started()
        before, begin = _processor(pid), time.monotonic()
        pipe.send((reader, file))
        while not pipe.poll(POLL_S):
            spent, size = _processor(pid) - before, _memory(pid)
            late = spent > SECONDS or time.monotonic() - begin > CLOCK_S
            if late or size > BYTES:
                kind = self._stop_for(LATE if late else LARGE)
                return Outcome(LATE if late else LARGE, kind, spent, size)
        try:
            outcome: Outcome = pipe.recv()
        except EOFError:
            return Outcome(DIED, self._stop_for(DIED))
        outcome.seconds = _processor(pid) - before
        if outcome.size > BYTES:
            outcome.said, outcome.kind = LARGE, self._stop_for(LARGE)
        elif outcome.size > BYTES / 2:
            self.close()
        return outcome

    def _started(self) -> tuple[Connection, int]:
        if self._process is None or self._pipe is None or self._process.pid is None:
            context = multiprocessing.get_context("spawn")
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(
                target=_work, args=(theirs, self._folders, self._stacks.name), daemon=True
            )
            self._process.start()
            theirs.close()
            self._pipe.recv()
        assert self._process.pid is not None
        return self._pipe, self._process.pid

    def _stop_for(self, reason: str) -> str:
        """End the process; return where it was."""
        if self._process is not None and reason == LATE and self._process.pid is not None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self._process.pid, 10)  # SIGUSR1: the stacks
                time.sleep(0.5)
        self._end()
        text = Path(self._stacks.name).read_text(encoding="utf-8", errors="replace")
        lines = [line.strip() for line in text.splitlines() if f"{ROOT.name}/gazelle/" in line]
        Path(self._stacks.name).write_text("", encoding="utf-8")
        return f"{reason} in " + (
            lines[0].partition("/gazelle/")[2] if lines else "an unknown place"
        )

    def _end(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.join()
        self._process = self._pipe = None

    def close(self) -> None:
        """End the process."""
        self._end()


def _processor(pid: int) -> float:
    """Return the processor time of a process [s]."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    except OSError:
        return 0.0
    return sum(map(int, stat[11:15])) / os.sysconf("SC_CLK_TCK")


def _memory(pid: int | str, field_name: str = "VmRSS") -> int:
    """Return the memory of a process [bytes]."""
    try:
        text = Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    except OSError:
        return 0
    return 1024 * next(
        (int(line.split()[1]) for line in text.splitlines() if field_name in line), 0
    )


def _work(pipe: Connection, folders: list[Path], stacks: str) -> None:
    """Process one file after the other."""
    file = Path(stacks).open("w", encoding="utf-8")  # noqa: SIM115  # open to the end
    faulthandler.enable(file)
    faulthandler.register(10, file, all_threads=False)
    roots = {str(each.parent.parent) for folder in folders for each in folder.rglob("model.config")}
    os.environ["GAZEBO_MODEL_PATH"] = os.pathsep.join(sorted(roots))
    os.environ["ROS_PACKAGE_PATH"] = os.pathsep.join(map(str, folders))
    warnings.simplefilter("ignore")
    silence = os.open(os.devnull, os.O_RDWR)
    os.dup2(silence, 1)
    os.dup2(silence, 2)
    pipe.send(None)
    while True:
        reader, path = pipe.recv()
        with contextlib.suppress(OSError):
            Path("/proc/self/clear_refs").write_text(
                "5", encoding="ascii"
            )  # forget the greatest size
        outcome = _tried(reader, path)
        outcome.size = _memory("self", "VmHWM")
        pipe.send(outcome)


def _tried(reader: str, path: Path) -> Outcome:
    from gazelle import Error

    try:
        READERS[reader](path)
    except Error as error:
        text = str(error)
        if any(ord(letter) > sys.maxunicode for letter in text):  # it could not be sent back
            return Outcome(FOREIGN, "an error with text that is no Unicode", error=ascii(text))
        return Outcome(REFUSED, error=text)
    except BaseException as error:  # noqa: BLE001  # that is what is looked for
        frames = traceback.extract_tb(error.__traceback__)
        ours = [each for each in frames if "/gazelle/" in each.filename] or frames
        place = f"{ours[-1].filename.rpartition('/gazelle/')[2]}:{ours[-1].lineno} {ours[-1].name}"
        return Outcome(FOREIGN, f"{type(error).__name__} in {place}", error=traceback.format_exc())
    return Outcome(GOOD)


@dataclass
class Survey:
    """Counts and examples."""

    keep: Path | None
    counted: collections.Counter[tuple[str, str]] = field(default_factory=collections.Counter)
    kinds: collections.Counter[str] = field(default_factory=collections.Counter)
    seconds: dict[str, float] = field(default_factory=lambda: collections.defaultdict(float))
    slowest: float = 0.0
    largest: int = 0

    def add(self, seed: Seed, folder: Path, outcome: Outcome) -> None:
        """Count an outcome; show the first of a kind, and keep some."""
        self.counted[seed.reader, outcome.said] += 1
        self.seconds[seed.reader] += outcome.seconds
        self.slowest = max(self.slowest, outcome.seconds)
        self.largest = max(self.largest, outcome.size)
        if outcome.said not in WRONG:
            return
        self.kinds[outcome.kind] += 1
        if self.kinds[outcome.kind] > 3 or self.keep is None:
            return
        place = self.keep / f"{len(self.kinds)}-{self.kinds[outcome.kind]}"
        shutil.copytree(folder, place, symlinks=True, dirs_exist_ok=True)
        about = f"{seed.reader} {seed.file.name}\n{outcome.kind}\n{outcome.error}\n"
        (place / "about.txt").write_text(about, encoding="utf-8")
        if self.kinds[outcome.kind] == 1:
            said = outcome.error[-SHOWN:]
            print(f"{place}: {seed.reader} {seed.file}: {outcome.kind}\n{said}", flush=True)

    def show(self) -> None:
        """Print the counts."""
        readers = sorted({reader for reader, _ in self.counted})
        words = (GOOD, REFUSED, *WRONG)
        print(f"{'':15}" + "".join(f"{word:>10}" for word in (*words, "seconds")))
        for reader in readers:
            counts = "".join(f"{self.counted[reader, word]:>10}" for word in words)
            print(f"{reader:15}{counts}{self.seconds[reader]:>10.1f}")
        sums = [sum(self.counted[reader, word] for reader in readers) for word in words]
        print(f"{'all':15}" + "".join(f"{number:>10}" for number in sums))
        print(
            f"{sum(sums)} files; slowest {self.slowest:.1f} s, largest {self.largest / 2**30:.2f} GB"
        )
        for kind, count in self.kinds.most_common():
            print(f"{count:>7}  {kind}")


def laid_out(seed: Seed, folder: Path) -> Path:
    """Write a seed's file into a folder, with copies of what is beside and below it."""
    home = folder / seed.file.parent.name
    home.mkdir(parents=True)
    if seed.reader in ("run", "checkpoint"):  # what writes there, too
        run = seed.file.parents[{"run": 0, "checkpoint": 2}[seed.reader]]
        shutil.copytree(run, folder / "run" / run.name)
        return folder / "run" / run.name / seed.file.relative_to(run)
    for each in beside(seed.file.parent):
        place = home / each.relative_to(seed.file.parent)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(each, place)
    file = home / seed.file.name
    shutil.copyfile(seed.file, file)
    return file


@functools.cache
def beside(folder: Path) -> list[Path]:
    """Return files in and below a folder, as many as are copied with one of them."""
    left, found = MOST_BESIDE, []
    for each in sorted(folder.rglob("*")):
        size = each.stat().st_size if each.is_file() else 0
        if size and size <= left:  # links would lead out of the folders that may be read
            left -= size
            found.append(each)
    return found


def chosen(by_reader: dict[str, list[Seed]], chance: random.Random) -> Seed:
    """Choose a reader, those of many files more often, and one of its files."""
    readers = sorted(by_reader)
    weights = [max(LEAST_WEIGHT, len(by_reader[each]) ** 0.5) for each in readers]
    return chance.choice(by_reader[chance.choices(readers, weights)[0]])


def attempts(
    seeds: list[Seed], args: argparse.Namespace, reader: Reader
) -> Iterator[tuple[Seed, Path, Outcome]]:
    """Yield seeds, the folders with their broken copies, and what became of them."""
    chance = random.Random(args.seed)
    by_reader: dict[str, list[Seed]] = {}
    for each in seeds:
        by_reader.setdefault(each.reader, []).append(each)
    tried: set[Path] = set()
    end = time.monotonic() + args.minutes * 60
    done = 0
    while done < args.count and time.monotonic() < end:
        seed = chosen(by_reader, chance)
        data = seed.file.read_bytes()
        with tempfile.TemporaryDirectory() as temporary:
            if seed.file not in tried:
                tried.add(seed.file)
                whole = Path(temporary) / "whole"
                outcome = reader.read(seed.reader, laid_out(seed, whole))
                if outcome.seconds > SLOW_SEED_S or outcome.said in WRONG:
                    yield seed, whole, outcome
                    by_reader[seed.reader].remove(seed)
                    by_reader = {name: left for name, left in by_reader.items() if left}
                    continue
            folder = Path(temporary) / "broken"
            file = laid_out(seed, folder)
            file.write_bytes(structured_mutations.broken(seed.family, data, chance))
            done += 1
            yield seed, folder, reader.read(seed.reader, file)


def main() -> None:
    """Read the arguments; break files; print what became of them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="*", type=lambda text: Path(text).absolute())
    parser.add_argument("--count", type=int, default=1000, help="broken files (default 1000)")
    parser.add_argument("--minutes", type=float, default=1e6, help="at most")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", nargs="+", metavar="READER", help=", ".join(READERS))
    parser.add_argument("--keep", type=lambda text: Path(text).absolute(), metavar="FOLDER")
    parser.add_argument("--again", type=Path, metavar="FOLDER", help="what an earlier run kept")
    args = parser.parse_args()
    reader, survey = Reader(args.folders), Survey(args.keep)
    with tempfile.TemporaryDirectory() as temporary:
        os.environ["XDG_CACHE_HOME"] = f"{temporary}/cache"
        try:
            if args.again is not None:
                again(args.again, reader)
                return
            made = Path(temporary) / "made"
            made.mkdir()
            seeds = [*mutated_seeds.make_seeds(made)]
            seeds += [each for folder in args.folders for each in mutated_seeds.seeds(folder)]
            seeds = [each for each in seeds if not args.only or each.reader in args.only]
            print(f"{len(seeds)} good files", flush=True)
            for count, found in enumerate(attempts(seeds, args, reader), 1):
                survey.add(*found)
                if count % 1000 == 0:
                    survey.show()
        except KeyboardInterrupt:
            pass
        finally:
            reader.close()
    survey.show()


def again(folder: Path, reader: Reader) -> None:
    """Read what was kept, and print what becomes of it now."""
    for place in sorted(each for each in folder.iterdir() if (each / "about.txt").exists()):
        about = (place / "about.txt").read_text(encoding="utf-8").splitlines()
        name, _, file = about[0].partition(" ")
        found = next(place.rglob(file))
        outcome = reader.read(name, found)
        print(f"{place.name}: {about[1]} -> {outcome.said} {outcome.kind} {outcome.error[-SHOWN:]}")


if __name__ == "__main__":
    main()
