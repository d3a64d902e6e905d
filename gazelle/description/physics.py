"""Resolution and accuracy of a simulation. Defaults are SDF 1.7's."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.source import Source


@refuses_nan
@dataclass(frozen=True, slots=True)
class Ode:
    """Terms of ODE's solver, which Gazebo classic uses by default.

    Attributes:
        solver: ``quick`` (projected Gauss-Seidel) or ``world`` (exact).
        min_step_size: For solvers of variable step [s].
        iters: Iterations a step.
        precon_iters: Preconditioning iterations.
        sor: Successive over-relaxation.
        friction_model: ``pyramid_model``, ``box_model`` or ``cone_model``; None leaves it to the
            engine.
        cfm: Constraint force mixing.
        erp: Error reduction a step, 0 to 1.
        contact_max_correcting_vel: [m/s].
        contact_surface_layer: Penetration that is left uncorrected [m].
    """

    solver: str = "quick"
    min_step_size: float = 0.0001
    iters: int = 50
    precon_iters: int = 0
    sor: float = 1.3
    friction_model: str | None = None
    cfm: float = 0.0
    erp: float = 0.2
    contact_max_correcting_vel: float = 100.0
    contact_surface_layer: float = 0.001


@refuses_nan
@dataclass(frozen=True, slots=True)
class Physics:
    """A physics profile.

    Attributes:
        name: Of the profile.
        default: Whether it is the one in use when there are several.
        type: Engine of the file; Gazelle's engines all read the same terms.
        max_step_size: Physics step [s].
        kinematic_step: Physics step of engines that move bodies by their velocities alone [s];
            None for ``max_step_size``.
        real_time_factor: Simulated seconds a wall second to aim at.
        real_time_update_rate: Steps a wall second to aim at [Hz]; 0 means as fast as possible.
        max_contacts: At most a given number of contact points between two collisions.
        ode: Solver terms; those of Bullet that ODE has too, where a file gives only Bullet's.
        auto_disable: Whether bodies at rest go to sleep; None leaves it to the engine.
        speculative_contacts: Whether contacts are looked for on the way of the coming step,
            so that fast bodies do not pass through thin ones; None leaves it to the engine.
        integrator: ``euler`` (semi-implicit, as ODE) or ``rk4`` (fourth order, four times the
            work); None leaves it to the engine.
        contacts: ``exact`` (what is held does not creep) or ``fast`` (for robots that drive),
            whatever ``ode.friction_model`` says; None leaves it to that, or to the engine.
        extras: Elements without effect, kept as in the file: bullet, dart, simbody, ...
    """

    name: str = "default_physics"
    default: bool = False
    type: str = "ode"
    max_step_size: float = 0.001
    real_time_factor: float = 1.0
    real_time_update_rate: float = 1000.0
    max_contacts: int = 20
    ode: Ode = field(default_factory=Ode)
    auto_disable: bool | None = None
    speculative_contacts: bool | None = None
    integrator: str | None = None
    contacts: str | None = None
    kinematic_step: float | None = None
    extras: tuple[Parameters, ...] = ()
    source: Source | None = field(default=None, compare=False, repr=False)
