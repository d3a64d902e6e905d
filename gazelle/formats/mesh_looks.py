"""How the pieces of a mesh file look: a colour, or a picture on them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from gazelle.array_types import Floats

Rgb = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class MeshLook:
    """The look of a piece.

    Attributes:
        color: Red, green and blue, 0 to 1; None if the file does not say.
        texture: The picture file that it names; empty for none.
        uv: Where in the picture the corners of each triangle are, to the right and up, 0 to 1 and
            again beyond, shape (m, 3, 2); None for nowhere.
    """

    color: Rgb | None = None
    texture: str = ""
    uv: Floats | None = None


PLAIN = MeshLook()


def texture_file(mesh: Path, name: str) -> Path | None:
    """The picture that a mesh file names, beside it or where Gazebo's models keep theirs.

    Only files in the folder of the mesh's model are found: two above the mesh, and what is below.

    Args:
        mesh: The mesh file.
        name: As the file has it: a path relative to it, or of the machine that it was made on.
    """
    plain = name.removeprefix("file://").replace("\\", "/").replace("%20", " ")
    last = plain.rpartition("/")[2]
    if not last:
        return None
    here = mesh.resolve().parent
    model = here.parent
    places = (
        here / plain,
        here / last,
        model / "materials" / "textures" / last,
        here / "materials" / "textures" / last,
        model / "textures" / last,
    )
    for place in places:
        found = place.resolve()
        if found.is_file() and found.is_relative_to(model):
            return found
    return None
