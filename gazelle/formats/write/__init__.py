"""Writers of SDF and URDF."""

from gazelle.formats.write.save import save, to_string, write_text

__all__ = ["save", "to_string", "write_text"]
