"""Status of a satellite receiver, bit by bit, as in Hector's GNSS.cfg."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.simulation import Tunable

# Those of sensor_msgs/NavSatStatus.
_NO_FIX = -1
_STATUS = {"STATUS_SBAS_FIX": 1, "STATUS_GBAS_FIX": 2}
_SERVICE = {"SERVICE_GPS": 1, "SERVICE_GLONASS": 2, "SERVICE_COMPASS": 4, "SERVICE_GALILEO": 8}

FLAGS = tuple(
    Tunable(name, default, False, True, description)
    for name, default, description in (
        ("STATUS_FIX", True, "A fix"),
        ("STATUS_SBAS_FIX", False, "Helped by satellites"),
        ("STATUS_GBAS_FIX", False, "Helped from the ground"),
        ("SERVICE_GPS", True, "GPS is used"),
        ("SERVICE_GLONASS", True, "GLONASS is used"),
        ("SERVICE_COMPASS", True, "COMPASS is used"),
        ("SERVICE_GALILEO", True, "Galileo is used"),
    )
)
"""Flags that can be changed."""


def status_of(flags: Mapping[str, bool]) -> tuple[int, int]:
    """Return status and service of a ``NavSatStatus``."""
    status = sum(bit for name, bit in _STATUS.items() if flags[name])
    service = sum(bit for name, bit in _SERVICE.items() if flags[name])
    return (status if flags["STATUS_FIX"] else _NO_FIX), service


def flags_of(status: int, service: int) -> dict[str, bool]:
    """Return the flags that ``status_of`` combines."""
    return {
        "STATUS_FIX": status != _NO_FIX,
        **{name: bool(status & bit) for name, bit in _STATUS.items()},
        **{name: bool(service & bit) for name, bit in _SERVICE.items()},
    }
