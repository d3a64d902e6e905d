"""A world as MJCF, MuJoCo's own file format: what the engine compiles, with looks added."""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import mujoco

from gazelle.description import Plane, Pose, Visual, World
from gazelle.engines.limits import check_world, physics_step
from gazelle.engines.mujoco.compiler.spec import VISUAL_GROUP, CompilerInput, Draft, draft_world
from gazelle.errors import EngineWarning
from gazelle.kinematics.tree import TreeLink

_EXACT = 17
_GREY = (0.7, 0.7, 0.7, 1.0)


def to_mjcf(world: World, *, time_step: float | None = None, visuals: bool = True) -> str:
    """Return the MJCF text of a world, which MuJoCo steps as the engine does.

    Names are scoped as in the engine: ``model::link``, ``model::joint``. Meshes stand in the
    text itself, so it needs no other file. Plugins, sensors and controllers have no
    counterpart and are left out.

    Args:
        world: World to write.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.
        visuals: Add the visuals, in group 1, which never collide.

    Raises:
        EngineError: The world cannot be simulated.
        FormatError: A mesh cannot be read.
    """
    check_world(world)
    step = physics_step(world.profile.max_step_size if time_step is None else time_step)
    draft = draft_world(CompilerInput(world, step))
    draft.spec.modelname = world.name
    _warn_of(draft)
    if visuals:
        _add_visuals(draft)
    draft.spec.copy_back(draft.compile(as_written=False))
    with _exact_numbers():
        text: str = draft.spec.to_xml()
    return text


def _warn_of(draft: Draft) -> None:
    extras = draft.extras
    lacking = {
        "bounces are less exact": extras.bounces,
        "friction differs along world y and x, not along fdir1": extras.directional_friction,
        "bodies that tumble freely drift": extras.tumbling and not any(draft.spec.option.gravity),
        "slip bodies drift off their wheels": draft.slips,
    }
    found = [words for words, present in lacking.items() if present]
    if found:
        warnings.warn(
            EngineWarning(f"in MuJoCo without Gazelle {' and '.join(found)}"), stacklevel=3
        )


def _add_visuals(draft: Draft) -> None:
    for parts in draft.bodies.values():
        for body in parts:
            static = body.root == "static"
            handle = draft.spec.worldbody if static else draft.spec.body(body.name)
            for visual in body.link.visuals:
                _add_visual(handle, visual, body, draft)


def _add_visual(handle: Any, visual: Visual, body: TreeLink, draft: Draft) -> None:
    pose = (body.pose if body.root == "static" else Pose()) * visual.pose
    material = visual.material
    red, green, blue, alpha = (material and (material.diffuse or material.ambient)) or _GREY
    for shape in draft.shapes.visible(visual.geometry, pose, visual.source):
        if isinstance(visual.geometry, Plane):
            width, depth = visual.geometry.size
            shape["size"] = [width / 2, depth / 2, 1.0]
        handle.add_geom(
            group=VISUAL_GROUP,
            mass=0.0,
            contype=0,
            conaffinity=0,
            rgba=[red, green, blue, alpha * (1.0 - visual.transparency)],
            **shape,
        )


@contextmanager
def _exact_numbers() -> Iterator[None]:
    """Write numbers with all their digits while it lasts; MuJoCo's default is six.

    Its Python package has no word for that, but the library exports the functions that its
    own tests use.
    """
    library = _library()
    read = getattr(library, "_mjPRIVATE__get_xml_precision", None)
    write = getattr(library, "_mjPRIVATE__set_xml_precision", None)
    if read is None or write is None:
        warnings.warn(
            EngineWarning("this version of MuJoCo writes numbers with six digits only"),
            stacklevel=4,
        )
        yield
        return
    usual = read()
    write(_EXACT)
    try:
        yield
    finally:
        write(usual)


def _library() -> ctypes.CDLL | None:
    """Return MuJoCo's own library, which is loaded already."""
    for file in Path(mujoco.__file__).parent.iterdir():
        name = file.name.removeprefix("lib")
        if name.startswith("mujoco.") and not name.endswith(".py"):
            return ctypes.CDLL(str(file))
    return None
