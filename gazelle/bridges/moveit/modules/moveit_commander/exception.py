"""What goes wrong."""

__all__ = ["MoveItCommanderException"]


class MoveItCommanderException(Exception):  # noqa: N818  # MoveIt's name
    """What was asked for cannot be."""
