"""Stage itself as a process beside ours: finding it, running it headless, its processor time.

Stage is free software under the GPL and no part of Gazelle; nothing here links to it.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import threading
from dataclasses import dataclass
from pathlib import Path
from tempfile import mkdtemp

PROBE = Path(__file__).resolve().parent.parent / "tools" / "stage_probe.cc"
PATIENCE_S = 240.0
TRIES = 4


class StageError(Exception):
    """Stage did not do what it was asked for."""


@dataclass(frozen=True)
class Spent:
    """What a run took.

    Attributes:
        seconds: Of processor time.
        megabytes: Most memory that it held.
    """

    seconds: float
    megabytes: float


@dataclass(frozen=True)
class Stage:
    """An installed Stage.

    Attributes:
        program: Its executable.
        plugins: Where the controller ``stage_probe`` has been built; None if it could not be.
    """

    program: Path
    plugins: Path | None

    def run(self, world: Path, log: Path | None = None) -> Spent:
        """Run a world without a window until its ``quit_time``.

        Now and then Stage 4.3 waits for its own thread for ever before the first step, so it
        is tried again when it takes long without using the processor.

        Args:
            world: The file.
            log: Where ``stage_probe`` writes.

        Raises:
            StageError: It failed, or never came to an end.
        """
        for _ in range(TRIES):
            code, spent = self._once(world, log)
            if code == 0:
                return spent
            if code != -signal.SIGKILL:
                raise StageError(f"'{self.program} -g {world}' ended with {code}")
        raise StageError(f"'{self.program} -g {world}' never ends")

    def _once(self, world: Path, log: Path | None) -> tuple[int, Spent]:
        words = [str(self.program), "-g", str(world)]
        quiet = subprocess.DEVNULL
        process = subprocess.Popen(
            words, env=self.environment(log), stdin=quiet, stdout=quiet, stderr=quiet
        )
        ended = threading.Event()
        watch = threading.Thread(target=_kill_idle, args=(process.pid, ended), daemon=True)
        watch.start()
        _, status, usage = os.wait4(process.pid, 0)
        ended.set()
        watch.join()
        process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, Spent(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)

    def environment(self, log: Path | None) -> dict[str, str]:
        """Return variables with which the program finds what belongs to it."""
        prefix = self.program.parent.parent
        own = {
            "STAGEPATH": [self.plugins, prefix / "share" / "stage"],
            "LD_LIBRARY_PATH": [prefix / "lib", prefix / "lib64"],
        }
        env = dict(os.environ)
        for name, folders in own.items():
            paths = [str(folder) for folder in folders if folder is not None]
            env[name] = os.pathsep.join([*paths, *filter(None, [env.get(name)])])
        if log is not None:
            env["STAGE_PROBE"] = str(log)
        return env


def find(given: Path | None) -> Stage | None:
    """Find the Stage at a path, or the one on PATH; None without one.

    Raises:
        StageError: What was given is no Stage.
    """
    path = given or shutil.which("stage")
    if path is None:
        return None
    stage = Stage(Path(path).resolve(), None)
    try:
        done = subprocess.run(
            [str(stage.program), "-g", "-h"],
            env=stage.environment(None),
            capture_output=True,
            text=True,
            timeout=20.0,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        done, why = None, str(error)
    else:
        why = "it does not say that it is Stage 4"
    if done is None or not done.stdout.startswith("Stage 4."):
        if given is None:
            return None  # another program of this name
        raise StageError(f"'{path}' is no Stage: {why}")
    return Stage(stage.program, _built(stage.program.parent.parent))


def _built(prefix: Path) -> Path | None:
    """Compile ``stage_probe`` for the Stage that is installed there; its folder."""
    headers = sorted(prefix.glob("include/Stage-*/stage.hh"))
    compiler = shutil.which("g++")
    if compiler is None or not headers:
        return None
    folder = Path(mkdtemp(prefix="stage-probe-"))
    words = [compiler, "-O2", "-shared", "-fPIC", f"-I{headers[-1].parent}", str(PROBE)]
    libraries = [f"-L{prefix / lib}" for lib in ("lib", "lib64")]
    words += ["-o", str(folder / "stage_probe.so"), *libraries, "-lstage"]
    done = subprocess.run(words, capture_output=True, check=False)
    return folder if done.returncode == 0 else None


def _kill_idle(pid: int, ended: threading.Event) -> None:
    """End a process that rests for a while: it waits for a thread that will never answer."""
    before, waited = -1.0, 0.0
    while not ended.wait(5.0):
        spent, waited = _processor_time(pid), waited + 5.0
        if spent == before or waited > PATIENCE_S:
            os.kill(pid, signal.SIGKILL)
            return
        before = spent


def _processor_time(pid: int) -> float:
    """Return the time of a process [s]; without /proc it is unknown, and its end is timed."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
    except OSError:
        return 0.0
    fields = text.rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
