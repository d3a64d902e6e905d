"""Distances of convex pieces of hollow meshes from their triangles; the table of decision 020.

Every shape of `tests/hollows.py` is cut up at three sizes, which commas part, as what moves and as
what stands still. Beyond and short are how far the pieces reach beyond the triangles and stay short of them at most,
looked for at thousands of places. A step is one of the mesh as it falls onto level ground and
comes to rest, in processor time.

    python tools/mesh_errors.py
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

import trimesh

from gazelle.description import Mesh, Pose
from gazelle.engines import make_engine
from gazelle.geometry.convex_decomposition import decompose
from gazelle.geometry.mesh_data import MeshData

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import hollows
import scenes

SIZES = (0.1, 1.0, 4.0)
COLUMNS = (
    "shape",
    "pieces at 0.1, 1, 4 m",
    "beyond [mm]",
    "short [mm]",
    "build [s]",
    "step [us]",
    "static: pieces",
    "beyond [mm]",
)
STEPS = 1000


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("shapes", nargs="*", default=list(hollows.SHAPES), help="default: all")
    args = parser.parse_args()
    print(f"| {' | '.join(COLUMNS)} |")
    print(f"|{'---|' * len(COLUMNS)}")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder
        for name in args.shapes:
            print(row(name, Path(folder)), flush=True)


def row(name: str, folder: Path) -> str:
    """Return a line of the table."""
    columns: list[list[str]] = [[] for _ in COLUMNS[1:]]
    for size in SIZES:
        data = hollows.made(name, size)
        start = time.process_time()
        moving = decompose(data, static=False)
        build = time.process_time() - start
        static = decompose(data, static=True)
        cells = (
            f"{len(moving.solids)}",
            f"{1000.0 * hollows.protrusion(data, moving):.2f}",
            f"{1000.0 * hollows.uncovered(data, moving):.2f}",
            f"{build:.2f}",
            f"{cost(data, folder):.0f}",
            f"{len(static.solids)}",
            f"{1000.0 * hollows.protrusion(data, static):.2f}",
        )
        for column, cell in zip(columns, cells, strict=True):
            column.append(cell)
    return f"| {name} | {' | '.join(', '.join(cells) for cells in columns)} |"


def cost(data: MeshData, folder: Path) -> float:
    """Return the processor time of a step [us]."""
    file = folder / "mesh.stl"
    trimesh.Trimesh(data.vertices, data.faces, process=False).export(file)
    size = float((data.vertices.max(axis=0) - data.vertices.min(axis=0)).max())
    thing = scenes.solid("thing", Mesh(file.name, file), pose=Pose(z=size))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), thing), threads=1)
    start = time.process_time()
    engine.step(STEPS)
    return (time.process_time() - start) / STEPS * 1e6


if __name__ == "__main__":
    main()
