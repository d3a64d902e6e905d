"""Frames of MuJoCo's classic renderer, OpenGL by Mesa's software, for `gazelle bench camera`.

It needs `pip install PyOpenGL` and Debian's libosmesa6, and a process of its own, as `MUJOCO_GL` is
read when MuJoCo is imported. The scene has the same triangles, one lamp, no textures and no reflections.
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import os
import subprocess
import sys
import time
from ctypes.util import find_library
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gazelle.description import World
from gazelle.rendering.shape_meshes import triangles_of

FIELD_OF_VIEW = 1.2
"""Of a picture's width [rad]."""


@dataclass(frozen=True)
class ClassicRates:
    """Frames a core-second, of all threads' processor time."""

    colour: float
    depth: float
    labels: float

    @property
    def whole(self) -> float:
        """Of frames with all three, which the classic renderer draws one after another."""
        return 1.0 / (1.0 / self.colour + 1.0 / self.depth + 1.0 / self.labels)


def missing() -> str | None:
    """Return a hint how to install missing parts; empty if there are none."""
    if importlib.util.find_spec("OpenGL") is None:
        return "pip install PyOpenGL"
    return None if find_library("OSMesa") else "apt install libosmesa6"


def measured(
    triangles: int, width: int, height: int, seconds: float, *, shadows: bool
) -> ClassicRates:
    """Return the rate in the room of `gazelle bench camera`, in a process of its own."""
    words = [str(each) for each in (triangles, width, height, seconds, int(shadows))]
    done = subprocess.run(
        [sys.executable, str(Path(__file__)), *words],
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        env={**os.environ, "MUJOCO_GL": "osmesa"},
    )
    return ClassicRates(*map(float, done.stdout.split()))


def compiled(world: World, width: int, height: int):
    """Return the visuals of one-link models as MuJoCo's meshes, triangle by triangle."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.visual.global_.offwidth, spec.visual.global_.offheight = width, height
    upright = 2.0 * math.atan(math.tan(FIELD_OF_VIEW / 2.0) * height / width)
    spec.visual.global_.fovy = math.degrees(upright)
    spec.worldbody.add_light(pos=[0, 0, 8], dir=[0, 0, -1], diffuse=[0.8, 0.8, 0.8])
    for number, model in enumerate(world.models):
        mesh = triangles_of(model.links[0].visuals[0].geometry)
        corners = mesh.vertices[mesh.faces].reshape(-1, 3)
        below = corners.mean(axis=0) - (0.0, 0.0, 0.01)  # in no face: flat meshes are refused
        spec.add_mesh(
            name=f"m{number}",
            uservert=np.vstack([corners, below]).ravel(),
            userface=np.arange(len(corners)),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        x, y, z, w = model.pose.quaternion
        spec.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH,
            meshname=f"m{number}",
            pos=model.pose.position,
            quat=[w, x, y, z],
            contype=0,
            conaffinity=0,
        )
    return spec.compile()


def best(renderer, seconds: float) -> float:
    """Return the frames a second of the fastest run.

    Raises:
        RuntimeError: The picture is empty.
    """
    times, end = [], time.process_time() + seconds
    while not times or time.process_time() < end:
        begin = time.process_time()
        picture = renderer.render()
        times.append(time.process_time() - begin)
    if picture.std() == 0.0:
        raise RuntimeError("the classic renderer draws nothing")
    return 1.0 / min(times)


def main() -> None:
    """Measure in this process, and print the three rates."""
    import mujoco
    from camera import room

    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("triangles", "width", "height"):
        parser.add_argument(name, type=int)
    parser.add_argument("seconds", type=float)
    parser.add_argument("shadows", type=int)
    args = parser.parse_args()
    model = compiled(room(args.triangles), args.width, args.height)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    view = mujoco.MjvCamera()  # from (5, 4, 2.5), as camera.py looks
    view.lookat[:], view.distance, view.azimuth, view.elevation = (0, 0, 0.3), 6.77, 218.7, -19.0
    with mujoco.Renderer(model, args.height, args.width) as renderer:
        renderer.update_scene(data, view)
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = bool(args.shadows)
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        rates = [best(renderer, args.seconds)]
        renderer.enable_depth_rendering()
        rates.append(best(renderer, args.seconds))
        renderer.disable_depth_rendering()
        renderer.enable_segmentation_rendering()
        rates.append(best(renderer, args.seconds))
    sys.stdout.write(" ".join(f"{rate:.3f}" for rate in rates) + "\n")


if __name__ == "__main__":
    main()
