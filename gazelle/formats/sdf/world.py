"""``<world>``."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description import (
    Atmosphere,
    Light,
    Parameters,
    Scene,
    SphericalCoordinates,
    Vector3,
    World,
)
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf import state
from gazelle.formats.sdf.frames import WORLD, Scope
from gazelle.formats.sdf.include import (
    Included,
    draft_included,
    include_model,
    open_include,
)
from gazelle.formats.sdf.joint import read_joints
from gazelle.formats.sdf.leftover import Pattern, leftover
from gazelle.formats.sdf.light import read_light
from gazelle.formats.sdf.merge import with_merges
from gazelle.formats.sdf.model import read_frame, read_model
from gazelle.formats.sdf.model_drafts import draft_model, missing_names
from gazelle.formats.sdf.model_frames import (
    ModelFrames,
    Version,
    add_model,
    draft_frame,
    draft_joint,
)
from gazelle.formats.sdf.own_joint import with_own_joints
from gazelle.formats.sdf.physics import read_physics
from gazelle.formats.sdf.plugin import read_plugins
from gazelle.formats.sdf.pose import frame_of, read_pose
from gazelle.formats.sdf.prepare import prepared

_EXTRAS = ("audio", "gui", "road")
USER_CAMERA = "user_camera"
_SCENE: Pattern = {**dict.fromkeys(("ambient", "background", "shadows", "grid")), "sky": {}}
_GRAVITY = (0.0, 0.0, -9.8)
_MAGNETIC = (5.5645e-6, 22.8758e-6, -42.3884e-6)


@dataclass(slots=True)
class _Contents:
    """Models by name and lights of a world, those of includes too, in file order."""

    scope: Scope
    drafts: dict[str, ModelFrames] = field(default_factory=dict)
    lights: list[Light] = field(default_factory=list)


def read_world(node: Parameters, version: Version, reading: Reading) -> World:
    """Read a world with everything in it; the first ``<state>`` is applied."""
    node = with_own_joints(with_merges(prepared(node, reading), version, reading, include_model))
    contents = _collect(node, version, reading)
    scope = contents.scope
    camera = node.find("gui/camera")
    world = World(
        name=values.attribute(node, "name"),
        models=tuple(read_model(draft, scope, reading) for draft in contents.drafts.values()),
        physics=tuple(map(read_physics, node.find_all("physics"))),
        gravity=_since_1_6(node, "gravity", _GRAVITY),
        magnetic_field=_since_1_6(node, "magnetic_field", _MAGNETIC),
        wind=values.vector(node, "wind/linear_velocity", (0.0, 0.0, 0.0)),
        atmosphere=read_atmosphere(node.find("atmosphere")),
        spherical_coordinates=read_spherical(node.find("spherical_coordinates")),
        scene=read_scene(node.find("scene")),
        lights=tuple(contents.lights),
        frames=tuple(read_frame(child, scope) for child in node.find_all("frame")),
        joints=read_joints(node, scope, version, reading),
        plugins=read_plugins(node),
        camera=None if camera is None else read_pose(camera.find("pose")),
        states=tuple(node.find_all("state")),
        extras=tuple(
            extra for child in node.children if (extra := _extra(child, camera)) is not None
        ),
        source=node.source,
    )
    return state.apply(world)


def _collect(node: Parameters, version: Version, reading: Reading) -> _Contents:
    contents = _Contents(Scope(WORLD, reading=reading))
    for child in node.find_all("frame"):
        draft_frame(child, contents.scope)
    for child in node.find_all("joint"):
        draft_joint(child, contents.scope)
    for child in node.children:
        if child.tag == "model":
            _keep(contents, draft_model(child, version, reading, include_model), reading)
        elif child.tag == "include":
            included = open_include(child, reading)
            if included is None:
                contents.scope.missing |= missing_names(child)
            else:
                _keep_included(contents, child, included, reading)
        elif child.tag == "light":
            contents.lights.append(_light(child, contents.scope))
    return contents


def _keep(contents: _Contents, draft: ModelFrames, reading: Reading) -> None:
    if draft.name in contents.drafts:
        reading.fault(
            f"there is already a model named '{draft.name}': this one is left out", draft.node
        )
        return
    contents.drafts[draft.name] = draft
    add_model(contents.scope, draft)


def _keep_included(
    contents: _Contents, node: Parameters, included: Included, reading: Reading
) -> None:
    inner = included.node
    if inner.tag == "light":
        place = node.find("pose") or inner.find("pose")
        contents.lights.append(read_light(inner, read_pose(place)))
    else:
        _keep(contents, draft_included(node, included, reading), reading)


def _light(node: Parameters, scope: Scope) -> Light:
    place = node.find("pose")
    pose = read_pose(place)
    frame = frame_of(place)
    return read_light(node, scope.pose(frame, node) * pose if frame else pose)


def _since_1_6(node: Parameters, tag: str, default: Vector3) -> Vector3:
    """Return a field of the world, which stood in ``<physics>`` up to SDF 1.5."""
    return values.vector(node, tag, values.vector(node, f"physics/{tag}", default))


def _extra(node: Parameters, camera: Parameters | None) -> Parameters | None:
    """Return an element that is kept whole; of ``<gui>`` what the world's camera lacks."""
    if node.tag not in _EXTRAS:
        return None
    if node.tag != "gui" or camera is None or camera not in node.children:
        return node
    usual = camera.attributes.get("name", USER_CAMERA) == USER_CAMERA
    read: Pattern = {"pose": None, "@name": None} if usual else {"pose": None}
    left = leftover(node, {"camera": read})
    return left if left.children or left.attributes else None


def read_scene(node: Parameters | None) -> Scene:
    """Read ``<scene>``."""
    if node is None:
        return Scene()
    return Scene(
        ambient=values.color(node, "ambient", (0.4, 0.4, 0.4, 1.0)),
        background=values.color(node, "background", (0.7, 0.7, 0.7, 1.0)),
        shadows=values.flag(node, "shadows", default=True),
        sky=node.find("sky") is not None,
        grid=values.flag(node, "grid", default=True),
        extras=leftover(node, _SCENE).children,
    )


def read_atmosphere(node: Parameters | None) -> Atmosphere:
    """Read ``<atmosphere>``."""
    if node is None:
        return Atmosphere()
    return Atmosphere(
        type=node.attributes.get("type", "adiabatic"),
        temperature=values.real(node, "temperature", 288.15),
        temperature_gradient=values.real(node, "temperature_gradient", -0.0065),
        pressure=values.real(node, "pressure", 101325.0),
    )


def read_spherical(node: Parameters | None) -> SphericalCoordinates | None:
    """Read ``<spherical_coordinates>``."""
    if node is None:
        return None
    return SphericalCoordinates(
        surface_model=values.word(node, "surface_model", "EARTH_WGS84"),
        latitude=values.real(node, "latitude_deg", 0.0),
        longitude=values.real(node, "longitude_deg", 0.0),
        elevation=values.real(node, "elevation", 0.0),
        heading=values.real(node, "heading_deg", 0.0),
    )
