"""A world description as a MuJoCo model."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import mujoco

from gazelle.description import Collision, Inertial, Model, Plane, Pose, World
from gazelle.engines.free_links import warn_of_free_links, with_free_links
from gazelle.engines.mujoco.compiler.constraint_memory import compile_with_memory
from gazelle.engines.mujoco.compiler.contact_pairs import (
    ContactGeom,
    Spring,
    add_pairs,
    may_slide,
    recovery_velocities_of,
    tune_springs,
    world_needs_cone,
)
from gazelle.engines.mujoco.compiler.description_edits import with_frame_link
from gazelle.engines.mujoco.compiler.equality_constraints import add_closure, add_couplings, at_rest
from gazelle.engines.mujoco.compiler.free_bodies import (
    check_size,
    coordinate_count,
    limit_speculative_contacts,
)
from gazelle.engines.mujoco.compiler.gyroscopic_forces import swings, tumbling
from gazelle.engines.mujoco.compiler.inertia import inertia_of, possible, restore_inertias
from gazelle.engines.mujoco.compiler.joint_limits import tune_stops
from gazelle.engines.mujoco.compiler.joints import add_joint
from gazelle.engines.mujoco.compiler.motors import Motor, add_motors, motor_count, stiffen
from gazelle.engines.mujoco.compiler.options import (
    add_probes,
    damp_implicitly,
    set_options,
    skip_idle_forces,
)
from gazelle.engines.mujoco.compiler.pose_snapping import straight_pose
from gazelle.engines.mujoco.compiler.rotors import soften_rotors
from gazelle.engines.mujoco.compiler.shapes import CONTACT_GROUP, ShapeBuilder
from gazelle.engines.mujoco.compiler.surfaces import (
    friction_ranks,
    stiffen_friction,
    surface_options,
)
from gazelle.engines.mujoco.compiler.unsupported import warn_of_links, warn_of_plane
from gazelle.engines.mujoco.compiler.welds import Attachment, add_attachments
from gazelle.engines.mujoco.compiler.wheel_contacts import find_wheel_geoms
from gazelle.engines.mujoco.compiler.wheel_slip import (
    Slip,
    add_slip_body,
    constrain_slip_bodies,
    described_slips,
    slip_body_name,
    slipping,
    tune_slips,
    warn_of_losses,
)
from gazelle.engines.mujoco.compiler.world_geoms import WorldGeoms
from gazelle.engines.mujoco.contact_laws import LawSelection, finish, prepare
from gazelle.errors import EngineError
from gazelle.geometry.bounding_volumes import tighten_hierarchies
from gazelle.kinematics.tree import Closure, KinematicTree, TreeLink, tree_of

COLLISION_GROUP = 0
VISUAL_GROUP = 1


@dataclass(frozen=True, slots=True)
class CompilerInput:
    """All that a compiled model depends on.

    Attributes:
        world: The description.
        time_step: Physics step [s].
        kinematic: Names of kinematic models.
        motors: By scoped joint name.
        attachments: Pairs of links that can be held together at run time.
        slip_links: Links with shapes that may slip in proportion to the force.
        damped: Whether joints may be damped that the world's are not.
        hooks: Address of what takes commands within steps; 0 for none.
    """

    world: World
    time_step: float
    kinematic: frozenset[str] = frozenset()
    motors: Mapping[str, Motor] = field(default_factory=dict)
    attachments: tuple[Attachment, ...] = ()
    slip_links: frozenset[str] = frozenset()
    damped: bool = False
    hooks: int = 0


@dataclass(frozen=True, slots=True)
class Compiled:
    """A MuJoCo model and what its bodies stand for.

    Attributes:
        model: The MuJoCo model.
        bodies: By model name, in order.
        geoms: Names of MuJoCo's geoms by scoped collision, ``model::link::collision``.
        springs: Indices of MuJoCo's contact pairs that are springs.
        closures: Joints that close loops or couple others.
        motors: By scoped joint name.
    """

    model: mujoco.MjModel
    bodies: Mapping[str, list[TreeLink]]
    geoms: Mapping[str, list[str]]
    springs: Sequence[int] = ()
    closures: Sequence[Closure] = ()
    motors: Mapping[str, Motor] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Draft:
    """A MuJoCo model that is not compiled yet.

    Attributes:
        spec: Specification for MuJoCo's compiler.
        shapes: Builder of its geoms, which knows their meshes.
        bodies: By model name, in order.
        geoms: Names of MuJoCo's geoms by scoped collision.
        springs: Contacts with terms that depend on the compiled model.
        closures: Joints that close loops or couple others.
        extras: Laws that MuJoCo alone does not know.
        slips: Of wheels that may slip, by link.
    """

    spec: mujoco.MjSpec
    shapes: ShapeBuilder
    bodies: Mapping[str, list[TreeLink]]
    geoms: Mapping[str, list[str]]
    springs: list[Spring]
    closures: Sequence[Closure]
    extras: LawSelection
    slips: Mapping[str, Slip]

    def compile(self, *, as_written: bool = True) -> mujoco.MjModel:
        """Compile the MuJoCo model.

        Args:
            as_written: Give links the inertias of the file also where those are no body's, which
                MuJoCo simulates but does not compile.

        Raises:
            EngineError: Something in the description cannot be simulated.
        """
        try:
            compiled = compile_with_memory(self.spec, coordinate_count(self.bodies))
        except ValueError as error:
            raise EngineError(f"MuJoCo cannot simulate this world: {_first_line(error)}") from error
        if as_written:
            restore_inertias(compiled, itertools.chain.from_iterable(self.bodies.values()))
        stiffen_friction(compiled)
        soften_rotors(compiled)
        self.spec.option.impratio = compiled.opt.impratio
        tune_springs(compiled, self.springs)
        tune_stops(compiled, itertools.chain.from_iterable(self.bodies.values()))
        tune_slips(compiled, self.slips)
        stiffen(compiled)
        self._solve_at_once(compiled)
        return compiled

    def _solve_at_once(self, compiled: mujoco.MjModel) -> None:
        """Disable the search for constraint islands where there can be one only: 5 % faster."""
        if compiled.ntree <= 1 and not compiled.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP:
            flags = compiled.opt.disableflags | int(mujoco.mjtDisableBit.mjDSBL_ISLAND)
            compiled.opt.disableflags = self.spec.option.disableflags = flags


def compile_world(recipe: CompilerInput) -> Compiled:
    """Build the MuJoCo model of a world's collision shapes.

    Raises:
        EngineError: Something in the description cannot be simulated.
    """
    draft = draft_world(recipe)
    add_probes(draft.spec)
    prepare(draft.spec, draft.extras)
    springs = [spring.pair for spring in draft.springs]
    model = draft.compile()
    tighten_hierarchies(model, model.geom_group != CONTACT_GROUP)
    limit_speculative_contacts(model, recipe.world)
    if not recipe.damped:
        skip_idle_forces(model)
    finish(model, draft.extras)
    return Compiled(model, draft.bodies, draft.geoms, springs, draft.closures, recipe.motors)


def trees_of(recipe: CompilerInput) -> dict[str, KinematicTree]:
    """Return the kinematic trees of a world's models, by name.

    Raises:
        EngineError: A joint names a link that is not there.
    """
    return {
        model.name: tree_of(
            with_free_links(with_frame_link(model)), kinematic=model.name in recipe.kinematic
        )
        for model in recipe.world.models
    }


def draft_world(recipe: CompilerInput) -> Draft:
    """Return the draft that the model of a world is compiled from.

    Raises:
        EngineError: Something in the description cannot be simulated.
    """
    spec = mujoco.MjSpec()
    set_options(spec, recipe.world, recipe.time_step, recipe.kinematic)
    trees = trees_of(recipe)
    bodies = {name: tree.bodies for name, tree in trees.items()}
    check_size(bodies)
    held = {body.name for parts in bodies.values() for body in parts if body.root is not None}
    slips = slipping(described_slips(bodies.values()), recipe.slip_links - held)
    builder = _SpecBuilder(spec, recipe, bodies, slips)
    builder.shapes.solids.prepare(itertools.chain.from_iterable(bodies.values()))
    for model in recipe.world.models:
        builder.add_model(model)
    builder.world.finish()
    for tree in trees.values():
        add_couplings(spec, tree.bodies, recipe.time_step)
        for closure in tree.closures:
            add_closure(spec, closure, tree.bodies, recipe.time_step)
    add_motors(spec, recipe.motors.values(), recipe.time_step)
    add_attachments(spec, recipe.attachments, bodies)
    constrain_slip_bodies(spec, slips, recipe.time_step)
    if world_needs_cone(builder.solids):
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    warn_of_losses(bodies.values(), slips)
    warn_of_links(bodies.values())
    for model in recipe.world.models:
        warn_of_free_links(model)
    pairs = add_pairs(spec, builder.solids, recipe.time_step, math.hypot(*recipe.world.gravity))
    if pairs.springs or pairs.bounces or pairs.directional_friction:
        # In a pyramid friction would give way with the spring, by a factor of 1 / mu² more,
        # and bounce with what bounces; its sides do not turn.
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    damp_implicitly(spec)
    closures = [closure for tree in trees.values() for closure in tree.closures]
    slides = may_slide(builder.solids)
    extras = LawSelection(
        bounces=pairs.bounces,
        directional_friction=pairs.directional_friction,
        tumbling=tumbling(recipe.world, bodies),
        motors=motor_count(recipe.motors),
        slides=slides,
        wheel_geoms=find_wheel_geoms(bodies.values(), builder.geoms) if slides else {},
        exits=recovery_velocities_of(builder.solids, recipe.world),
        swings=swings(recipe.world, bodies),
        hooks=recipe.hooks,
    )
    return Draft(
        spec,
        builder.shapes,
        bodies,
        builder.geoms,
        pairs.springs,
        closures,
        extras,
        slips,
    )


class _SpecBuilder:
    """Fills an ``MjSpec`` model by model."""

    def __init__(
        self,
        spec: mujoco.MjSpec,
        recipe: CompilerInput,
        bodies: Mapping[str, list[TreeLink]],
        slip_links: Collection[str],
    ) -> None:
        self._spec = spec
        self.world = WorldGeoms(spec)
        self._time_step = recipe.time_step
        self._bodies = bodies
        self._by_name = {body.name: body for parts in bodies.values() for body in parts}
        self._slip_links = slip_links
        self.shapes = ShapeBuilder(spec, self.world.name_later)
        self.geoms: dict[str, list[str]] = {}
        self._masses = {
            name: sum((part.link.inertial or Inertial()).mass for part in parts)
            for name, parts in bodies.items()
        }
        self.solids: list[ContactGeom] = []
        self._ranks = friction_ranks(
            collision
            for parts in bodies.values()
            for body in parts
            for collision in body.link.collisions
        )

    def add_model(self, model: Model) -> None:
        """Add the bodies of one model, and what of it must not collide."""
        handles: dict[str, Any] = {}
        for body in self._bodies[model.name]:
            parent = self._spec.worldbody if body.parent is None else handles[body.parent]
            handles[body.name] = self._add_body(parent, body)
        if not model.static and model.name:
            self._exclude_own(self._bodies[model.name])

    def _add_body(self, parent: Any, body: TreeLink) -> Any:
        if body.root == "static":
            # Shapes of the world itself: one body is faster than hundreds that never move.
            self._add_shapes(self.world.add_geom, body, body.pose)
            return parent
        x, y, z, w = body.pose.quaternion
        handle = parent.add_body(name=body.name, pos=list(body.pose.position), quat=[w, x, y, z])
        if body.root == "kinematic":
            handle.mocap = True
        if body.root == "free":
            # A joint may have the name of a link.
            name = f"{body.name}#free"
            handle.add_freejoint(name=name, align=mujoco.mjtAlignFree.mjALIGNFREE_FALSE)
        if body.joint is not None:
            add_joint(handle, body.joint_name, body.joint, self._time_step)
        if body.root != "kinematic":
            _set_inertial(handle, body)
        shaped = add_slip_body(handle, body) if body.name in self._slip_links else handle
        self._add_shapes(lambda **geom: shaped.add_geom(**geom).name, body, Pose())
        return handle

    def _add_shapes(self, add_geom: Callable[..., str], body: TreeLink, pose: Pose) -> None:
        """Add a link's collision shapes to a MuJoCo body; the link's pose is in the body's frame."""
        for collision in body.link.collisions:
            if isinstance(collision.geometry, Plane) and body.root not in ("static", "kinematic"):
                self._add_still_plane(body, collision)
                continue
            surface = surface_options(collision, self._time_step, self._ranks)
            placed = pose * straight_pose(collision, body, self._by_name)
            names = self.geoms.setdefault(f"{body.name}::{collision.name}", [])
            static, geometry = body.root == "static", collision.geometry
            seen = self.shapes.seen(geometry, placed, static=static)
            group = COLLISION_GROUP if seen is None else CONTACT_GROUP
            for shape in self.shapes.options(geometry, placed, collision.source, static=static):
                name = f"{body.name}::{collision.name}#{len(names)}"
                names.append(add_geom(name=name, group=group, mass=0.0, **surface, **shape))
                self.solids.append(self._solid(names[-1], body, collision, placed))
            if seen is not None:
                name = f"{body.name}::{collision.name}#{len(names)}"
                names.append(add_geom(name=name, mass=0.0, **seen))

    def _add_still_plane(self, body: TreeLink, collision: Collision) -> None:
        """Add the plane of a link that moves to the world: ODE's planes stay where they begin."""
        warn_of_plane(body, collision)
        link = replace(body.link, collisions=(collision,))
        still = replace(body, link=link, parent=None, joint=None, root="static")
        self._add_shapes(self.world.add_geom, still, at_rest(body, self._by_name))

    def _solid(self, name: str, body: TreeLink, collision: Collision, placed: Pose) -> ContactGeom:
        model = body.name.partition("::")[0]
        moves = body.root not in ("static", "kinematic")
        where = body.name if body.root != "static" else ""
        mass = self._masses[model] if moves else math.inf
        return ContactGeom(name, where, model, mass, body.self_collide, collision, placed)

    def _exclude_own(self, bodies: list[TreeLink]) -> None:
        """Exclude contacts between links of one model unless both enable them, as in Gazebo."""
        solid = [body for body in bodies if body.link.collisions and body.root != "static"]
        for first, second in itertools.combinations(solid, 2):
            neighbours = second.name in self._slip_links and second.parent == first.name
            if neighbours or not (first.self_collide and second.self_collide):
                one, two = self._solid_body(first), self._solid_body(second)
                self._spec.add_exclude(bodyname1=one, bodyname2=two)

    def _solid_body(self, body: TreeLink) -> str:
        """Return MuJoCo's body that has the shapes of a link."""
        return slip_body_name(body.name) if body.name in self._slip_links else body.name


def _set_inertial(handle: Any, body: TreeLink) -> None:
    inertial = body.link.inertial or Inertial()
    if inertial.mass <= 0.0:
        raise EngineError(
            f"link '{body.name}' moves but has the mass {inertial.mass:g} kg",
            source=inertial.source or body.link.source,
            hint="give it a positive <mass>, or fix it to another link",
        )
    handle.explicitinertial = True
    handle.mass = inertial.mass
    handle.ipos = list(inertial.pose.position)
    moments, quaternion = inertia_of(body)
    handle.inertia, handle.iquat = possible(moments).tolist(), quaternion.tolist()
    if not body.link.gravity:
        handle.gravcomp = 1.0


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0]
