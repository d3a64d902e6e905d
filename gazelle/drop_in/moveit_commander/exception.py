"""Errors of the commander."""

__all__ = ["MoveItCommanderException"]


class MoveItCommanderException(Exception):  # noqa: N818  # MoveIt's name
    """Error of a request that cannot be fulfilled."""
