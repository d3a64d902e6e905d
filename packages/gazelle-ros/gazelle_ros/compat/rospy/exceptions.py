"""The exceptions of rospy."""

from __future__ import annotations


class ROSException(Exception):  # noqa: N818  # rospy's names
    """Root of what rospy raises to its users."""


class ROSSerializationException(ROSException):
    """A message could not be serialised."""


class ROSInternalException(Exception):  # noqa: N818
    """Something inside rospy failed."""


class ROSInitException(ROSException):
    """The node is not initialised, or cannot be."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """The node was shut down while something waited."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """Simulated time jumped back while something slept.

    Args:
        time: Distance into the past [s], negative.
    """

    def __init__(self, time: float) -> None:
        self.time = time
        super().__init__("ROS time moved backwards")


class TransportException(ROSInternalException):
    """A connection failed."""


class TransportTerminated(TransportException):
    """A connection was closed."""


class TransportInitError(TransportException):
    """A connection could not be made."""


class ServiceException(Exception):  # noqa: N818
    """A service call failed."""


# Users see these names in tracebacks and logs, and search for them.
for _each in (
    ROSException,
    ROSSerializationException,
    ROSInternalException,
    ROSInitException,
    ROSInterruptException,
    ROSTimeMovedBackwardsException,
    TransportException,
    TransportTerminated,
    TransportInitError,
):
    _each.__module__ = "rospy.exceptions"
ServiceException.__module__ = "rospy.service"
