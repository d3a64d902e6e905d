"""The errors of the ROS room: all are `gazelle_ros.base.errors.RosError`."""

from __future__ import annotations

import errno as _errno
import sys
import traceback

from gazelle_ros.base.errors import RosError

__all__ = [
    "ApiError",
    "FaultError",
    "InvalidNameError",
    "MarshalError",
    "MarshalRangeError",
    "MarshalTypeError",
    "MasterUnreachableError",
    "Md5MismatchError",
    "NoListeningMasterError",
    "NoMasterError",
    "NoTimeError",
    "NodeClosedError",
    "ParameterNotFoundError",
    "ProtocolError",
    "RefusedConnectionError",
    "RosError",
    "RosTimeoutError",
    "ServiceError",
    "ServiceFailedError",
    "ServiceNotFoundError",
    "SilentPeerError",
    "TimeMovedBackwardsError",
    "UnreachableError",
    "report",
]

_OURS = {"gazelle", "gazelle_ros"}


class InvalidNameError(RosError, ValueError):
    """A graph resource name that ROS 1 does not allow."""


class MarshalError(RosError, ValueError):
    """A value that XML-RPC cannot represent, or a document that is not XML-RPC."""


class MarshalTypeError(MarshalError, TypeError):
    """A value of a type that XML-RPC has not; Python's own XML-RPC raises TypeError."""


class MarshalRangeError(MarshalError, OverflowError):
    """A number that XML-RPC has no room for; Python's own XML-RPC raises OverflowError."""


class ProtocolError(RosError):
    """The peer does not speak HTTP, XML-RPC or TCPROS as it should, or exceeds a limit."""


class FaultError(RosError):
    """The peer answered an XML-RPC call with a fault.

    Attributes:
        code: The fault's number.
        text: The fault's text.
    """

    def __init__(self, code: int, text: str) -> None:
        self.code = code
        self.text = text
        super().__init__(f"fault {code}: {text}")


class UnreachableError(RosError):
    """A peer does not answer: no connection, or it broke before the answer."""


class RefusedConnectionError(UnreachableError, ConnectionRefusedError):
    """There is no peer at its former address."""

    errno = _errno.ECONNREFUSED


class SilentPeerError(UnreachableError):
    """A peer takes the call, and says nothing for too long."""


class MasterUnreachableError(UnreachableError, ConnectionError):
    """The ROS master does not answer.

    It is a `ConnectionError`, and so an `OSError` and a ``socket.error``, for programs for ROS
    catch these.
    """


class NoListeningMasterError(MasterUnreachableError, RefusedConnectionError):
    """There is no ROS master at its address: a `ConnectionRefusedError`."""


class NoMasterError(MasterUnreachableError):
    """Error for a server that answers, or stays silent, but is not a ROS master."""


class ApiError(RosError):
    """The master or a node answered a call with a code other than 1.

    Attributes:
        code: 0 the call failed, -1 the caller is at fault.
        text: The status text.
    """

    def __init__(self, method: str, code: int, text: str) -> None:
        self.code = code
        self.text = text
        super().__init__(f"{method}: {text}")


class Md5MismatchError(RosError):
    """The two ends of a topic or service do not mean the same type."""


class ServiceError(RosError):
    """A service call got no answer."""


class ServiceNotFoundError(ServiceError):
    """The service has no provider."""


class ServiceFailedError(ServiceError):
    """The service answered that it failed; the message is the server's text."""


class RosTimeoutError(RosError, TimeoutError):
    """Something did not happen within the time given for it."""


class NodeClosedError(RosError):
    """The node, publisher, subscriber or client is closed already."""


class ParameterNotFoundError(RosError, KeyError):
    """The parameter is not set."""

    def __str__(self) -> str:
        return self.message


class NoTimeError(RosError, ValueError, OverflowError):
    """Seconds are no time: NaN and infinity, for which genpy raises Python's errors."""


class TimeMovedBackwardsError(RosError):
    """Simulated time jumped back while something slept.

    Attributes:
        jump: Jump, in seconds (negative).
    """

    def __init__(self, jump: float) -> None:
        self.jump = jump
        super().__init__("ROS time moved backwards")


def report(what: str, error: BaseException) -> None:
    """Log an error that must not stop the thread it happened in.

    Args:
        what: Action that failed, such as ``callback of /scan``.
        error: Error; its traceback is logged, unless it is one of ours that code of
            ours raised: a peer that refuses needs no traceback.
    """
    import logging

    lines = [] if _expected(error) else traceback.format_exception(error)
    text = "\n".join([f"{what}: {error}", "".join(lines)]).rstrip()
    logger = logging.getLogger("gazelle.ros")
    if logger.hasHandlers():
        logger.error("%s", text)
    elif sys.stderr is not None:
        sys.stderr.write(f"[ERROR] {text}\n")


def _expected(error: BaseException) -> bool:
    """Return whether an error is ours and was raised without code of users on the stack."""
    frames = traceback.walk_tb(error.__traceback__)
    names = (frame.f_globals.get("__name__", "") for frame, _ in frames)
    ours = all(name.partition(".")[0] in _OURS for name in names)
    return isinstance(error, RosError) and ours
