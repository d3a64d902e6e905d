"""Distances of convex pieces of hollow meshes from their triangles; the table of decision 020.

Every shape of `tests/hollows.py` is cut up at three sizes, as what moves and as what stands still.
Beyond and short are how far the pieces reach beyond the triangles and stay short of them at most,
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
from gazelle.formats.convex import decompose
from gazelle.formats.mesh import MeshData

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import hollows
import scenes

SIZES = (0.1, 1.0, 4.0)
STEPS = 1000


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("shapes", nargs="*", default=list(hollows.SHAPES), help="default: all")
    args = parser.parse_args()
    print("| shape | size [m] | | pieces | beyond [mm] | short [mm] | build [s] | step [us] |")
    print(f"|{'---|' * 8}")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder
        for name in args.shapes:
            for size in SIZES:
                for static in (False, True):
                    print(row(name, size, Path(folder), static=static), flush=True)


def row(name: str, size: float, folder: Path, *, static: bool) -> str:
    """Return a line of the table."""
    data = hollows.made(name, size)
    start = time.process_time()
    pieces = decompose(data, static=static)
    build = time.process_time() - start
    beyond, short = hollows.protrusion(data, pieces), hollows.uncovered(data, pieces)
    step = "" if static else f"{cost(data, folder):.0f}"
    kind = "static" if static else "moving"
    errors = f"{1000.0 * beyond:.2f} | {1000.0 * short:.2f}"
    return (
        f"| {name} | {size:g} | {kind} | {len(pieces.solids)} | {errors} | {build:.2f} | {step} |"
    )


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
