"""A log of every time the robot did not do what the policy wanted, and why."""

from __future__ import annotations

import json
import logging
from pathlib import Path
from typing import Any

from gazelle.errors import TaskError
from gazelle.training.deploy.pilot import PilotOutput
from gazelle.training.deploy.safety import VelocityCommand
from gazelle_ros.base.writing import GrowingFile

_LOG = logging.getLogger(__name__)


class InterventionLog:
    """One line of JSON where an intervention begins and one where it ends.

    They also go to this module's logger, and from there to ``/rosout``: warnings and infos.

    Args:
        file: Lines are added to it; None for the logger alone.

    Raises:
        TaskError: The file cannot be written.

    Attributes:
        count: Interventions so far.
    """

    def __init__(self, file: Path | None = None) -> None:
        self._file: GrowingFile | None = None
        if file is not None:
            try:
                file.parent.mkdir(parents=True, exist_ok=True)
                self._file = GrowingFile(file)
            except OSError as error:
                raise TaskError(f"cannot write the log: {error}", hint="see --log") from error
        self._cause = ""
        self._began = 0.0
        self.count = 0

    def follow(self, tick: PilotOutput, now: float) -> None:
        """Add the pilot's report; numbers in a reason do not make it another one."""
        cause = "" if tick.reason is None else tick.reason.partition(" at ")[0]
        if cause == self._cause:
            return
        if self._cause:
            self.note("end", now, reason=self._cause, seconds=round(now - self._began, 3))
        self._cause, self._began = cause, now
        if cause:
            self.count += 1
            _LOG.warning("the policy is overruled: %s", tick.reason)
            self.note(
                "begin",
                now,
                reason=cause,
                detail=tick.reason,
                wanted=_pair(tick.policy_command),
                given=_pair(tick.command),
            )

    def note(self, event: str, now: float, **details: Any) -> None:
        """Add a line."""
        if self._file is None:
            return
        try:
            line = json.dumps({"time": round(now, 6), "event": event, **details})
            self._file.write(f"{line}\n".encode())
        except OSError as error:
            self.close()
            raise TaskError(
                f"cannot write the log: {error.strerror}", file=error.filename, hint="see --log"
            ) from error

    def close(self) -> None:
        """Close the file; a second call does nothing."""
        file, self._file = self._file, None
        if file is not None:
            file.close()


def _pair(command: VelocityCommand) -> list[float]:
    return [round(command.linear, 4), round(command.angular, 4)]
