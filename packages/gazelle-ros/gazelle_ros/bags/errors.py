"""Errors of bags."""

from __future__ import annotations

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.program import program_name


class BagError(RosError):
    """A bag cannot be read or written as requested."""


class BagFormatError(BagError):
    """A file is not a bag, or a damaged one."""


class BagUnindexedError(BagError):
    """A bag has no index, as its recording was cut off."""

    def __init__(self, path: str) -> None:
        super().__init__(
            "the bag has no index; its recording was cut off",
            file=path,
            hint=f"{program_name()} bag reindex {path}",
        )
