"""Descriptions to files: SDF and URDF."""

from gazelle.formats.write.save import save, to_string

__all__ = ["save", "to_string"]
