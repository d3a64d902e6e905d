"""SDF 1.4 to 1.12: one reader per element."""

from gazelle.formats.sdf.root import read_sdf

__all__ = ["read_sdf"]
