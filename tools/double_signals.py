"""End commands by two signals that come almost at once, over and over, and see that each ends well.

    python tools/double_signals.py --count 1000 --seed 1

Commands and states are those of tests/cli/ending_states.py. `timeout` sends SIGTERM to its child and
then to the whole group; an impatient user presses Ctrl-C twice. So each pair is drawn from SIGINT
and SIGTERM, 1 us to 5 ms apart, each to the process or to its group. A run is a child forked from
this process, which has imported everything: Python starts slower than a command ends.
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import os
import random
import shlex
import shutil
import signal
import sys
import tempfile
import time
import uuid
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from cli.ending_states import (  # noqa: E402
    ATHWART,
    FILES,
    MARK,
    STATES,
    State,
    complaints,
    left_behind,
    spent,
    spent_by_session,
)
from cli.forked import a_master, fork_command, import_everything  # noqa: E402
from cli.whole_files import broken_files  # noqa: E402

PATIENCE_S = 120.0
BUSY_S = 1200.0
"""Seconds by the clock that a command may take to its state while others use the processors."""
LIMIT_S = 2.0
NUMBERS = (signal.SIGINT, signal.SIGTERM)


@dataclass
class Tally:
    """Counts and times of ended runs.

    Attributes:
        pairs: Ended runs by command line.
        wall: Time until the process had ended [s].
        processor: Processor time that the end took [s].
        faults: Descriptions.
    """

    pairs: Counter[str] = field(default_factory=Counter)
    wall: list[float] = field(default_factory=list)
    processor: list[float] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


@dataclass
class Pair:
    """Two signals, where they go, and the time between them [s]."""

    numbers: tuple[int, int]
    groups: tuple[bool, bool]
    gap: float

    @classmethod
    def drawn(cls, chance: random.Random) -> Pair:
        """Draw one."""
        numbers = chance.choice(list(itertools.product(NUMBERS, NUMBERS)))
        groups = chance.choice([(False, False), (False, True), (True, True)])
        return cls(numbers, groups, 10.0 ** chance.uniform(-6.0, -2.3))

    def send(self, pid: int) -> None:
        """Send both."""
        for place, (number, group) in enumerate(zip(self.numbers, self.groups, strict=True)):
            if place:
                end = time.perf_counter() + self.gap
                while time.perf_counter() < end:
                    pass
            with contextlib.suppress(ProcessLookupError):
                (os.killpg if group else os.kill)(pid, number)

    def __str__(self) -> str:
        names = "+".join(signal.Signals(number).name for number in self.numbers)
        return f"{names} {self.gap * 1e6:.0f} us apart, to groups: {self.groups}"


class Run:
    """A command in a child process."""

    def __init__(self, state: State, folder: Path, words: dict[str, str]) -> None:
        self.state, self.folder, self.mark = state, folder, uuid.uuid4().hex
        self.said = folder / "said.txt"
        for name, text in FILES.items():
            (folder / name).write_text(text)
        line = state.words
        for name, value in words.items():
            line = line.replace(name, value)
        self.pid = fork_command(
            shlex.split(line),
            folder,
            self.said,
            self.said,
            lambda: os.environ.update({MARK: self.mark}),
        )
        while self.pid != spent(Path(f"/proc/{self.pid}"))[0]:  # it leads a session of its own
            time.sleep(0.001)

    @property
    def ended(self) -> bool:
        """Return True once it is a zombie."""
        options = os.WEXITED | os.WNOHANG | os.WNOWAIT
        return os.waitid(os.P_PID, self.pid, options) is not None

    def text(self) -> str:
        """Return what it has printed."""
        return self.said.read_text() if self.said.exists() else ""

    def reach(self, chance: random.Random) -> None:
        """Wait until it has come to its state, or to a point drawn on the way to its end."""
        sign, end = self.state.sign, time.monotonic() + BUSY_S
        point = chance.uniform(0.0, sign) if isinstance(sign, float) else 0.0
        while not self.ended and time.monotonic() < end:
            spent_so_far = spent_by_session(self.pid)
            if spent_so_far > PATIENCE_S:
                return
            if isinstance(sign, float):
                if spent_so_far >= point:
                    return
            elif sign.startswith("FOLDER/"):
                if any(self.folder.glob(sign.removeprefix("FOLDER/"))):
                    return
            elif sign in self.text():
                return
            time.sleep(0.005)

    def _processor(self) -> float:
        return spent(Path(f"/proc/{self.pid}"))[1]

    def end(self, pair: Pair, tally: Tally) -> list[str]:
        """Send the signals, and return what is wrong with the end."""
        if self.ended and not isinstance(self.state.sign, float):
            os.waitpid(self.pid, 0)
            return ["it ended before"]
        before, begin = self._processor(), time.monotonic()
        pair.send(self.pid)
        while not self.ended:
            if time.monotonic() - begin > PATIENCE_S:
                return [f"it did not end within {PATIENCE_S:g} s"]
            time.sleep(0.002)
        tally.wall.append(time.monotonic() - begin)
        tally.processor.append(self._processor() - before)
        code = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        found = complaints(self.state, self.text())
        good = {0, *(128 + number for number in pair.numbers)}
        if isinstance(self.state.sign, float) or self.state.script:
            good |= {1, *(-number for number in pair.numbers)}
        if code not in good:
            found.append(f"exit code {code}")
        if tally.processor[-1] > LIMIT_S:
            found.append(f"{tally.processor[-1]:.1f} s of processor time")
        return found + self._left()

    def _left(self) -> list[str]:
        end, found = time.monotonic() + 10.0, []
        while left := [each.name for each in left_behind(self.mark)]:
            if time.monotonic() > end:
                found.append(f"processes {left} are left")
                break
            time.sleep(0.01)
        if self.state.saved and not any(self.folder.glob(self.state.saved)):
            found.append(f"there is no {self.state.saved}")
        return found + broken_files(self.folder)

    def kill(self) -> None:
        """End what did not."""
        with contextlib.suppress(ChildProcessError, ProcessLookupError):
            if not self.ended:
                os.killpg(self.pid, signal.SIGKILL)
                os.waitpid(self.pid, 0)
        for each in left_behind(self.mark):
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(each.name), signal.SIGKILL)


def once(state: State, words: dict[str, str], chance: random.Random, tally: Tally) -> None:
    """End a command in a state, and what it can be resumed by."""
    folder = Path(tempfile.mkdtemp(prefix="double-signals-"))
    states = [state]
    if state.resumed and chance.random() < 0.5:
        states.append(State(state.resumed, state.resumed_sign, state.master, saved=state.saved))
    for each in states:
        found = sorted(folder.glob("runs/*"))
        words = words | {"FOLDER": str(folder), "RUN": str(found[0]) if found else ""}
        run, pair = Run(each, folder, words), Pair.drawn(chance)
        run.reach(chance)
        faults = run.end(pair, tally)
        run.kill()
        tally.pairs[each.words] += 1
        if faults:
            text = f"gazelle {each.words}: {pair}: {'; '.join(faults)}\n{run.text()[-1500:]}"
            tally.faults.append(text)
            sys.stdout.write(text + "\n")
        sys.stdout.flush()
    shutil.rmtree(folder, ignore_errors=True)


def main() -> int:
    """Run the tool."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="double signals")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="", help="a part of the command lines")
    args = parser.parse_args()
    chance, tally = random.Random(args.seed), Tally()
    states = [
        state
        for of_command in STATES.values()
        for state in of_command
        if state.sign != ATHWART and args.only in state.words
    ]
    import_everything()
    kept = Path(tempfile.mkdtemp(prefix="double-signals-"))  # no object: a child would delete it
    with a_master(kept) as uri:
        words = {"POLICY": str(kept / "robot.npz")}
        while sum(tally.pairs.values()) < args.count:
            for state in chance.sample(states, len(states)):
                if sum(tally.pairs.values()) < args.count:
                    os.environ["ROS_MASTER_URI"] = uri if state.master else "http://127.0.0.1:9/"
                    once(state, words, chance, tally)
            report(tally)
    shutil.rmtree(kept)
    return 1 if tally.faults else 0


def report(tally: Tally) -> None:
    """Print figures so far."""
    wall = sorted(tally.wall) or [0.0]
    processor = sorted(tally.processor) or [0.0]
    late = sum(each > LIMIT_S for each in wall)
    sys.stdout.write(
        f"{sum(tally.pairs.values())} double signals to {len(tally.pairs)} command lines, "
        f"{len(tally.faults)} faults; end after {wall[len(wall) // 2]:.2f} s (median), "
        f"{wall[-1]:.2f} s (longest), {late} over {LIMIT_S:g} s; "
        f"processor time {processor[-1]:.2f} s at most\n"
    )
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
