"""How high what is thrown into a slide hops, by kind of contact; see docs/physics.md.

A block of 0.2 x 0.2 x 0.1 m and 1 kg with μ = 0.3 is thrown along the ground at 1.5 m/s.

    python tools/sliding_hop.py
"""

from __future__ import annotations

import mujoco

from gazelle.description import (
    Box,
    Collision,
    Friction,
    Inertia,
    Inertial,
    Link,
    Model,
    Plane,
    Pose,
    Surface,
    World,
)
from gazelle.engines.mujoco.compiler import Recipe, compile_world

SPEED, MU, STEP = 1.5, 0.3, 0.001
RIGID = (0.9, 0.9999, 0.001, 0.5, 2.0)


def scene() -> World:
    """The block on the ground."""
    rubs = Surface(Friction(MU, MU))
    shape = Collision("c", Box((0.2, 0.2, 0.1)), surface=rubs)
    inertial = Inertial(1.0, Pose(), Inertia(0.0042, 0.0042, 0.0067))
    block = Link("l", inertial=inertial, collisions=(shape,))
    floor = Link("l", collisions=(Collision("c", Plane()),))
    models = (
        Model("ground", static=True, links=(floor,)),
        Model("block", links=(block,), pose=Pose(z=0.05)),
    )
    return World("w", models=models)


def hop(
    *,
    cone: bool = True,
    ratio: float = 1.0,
    terms: tuple[float, float] | None = None,
    impedance: tuple[float, ...] = RIGID,
    noslip: int = 0,
    step: float = STEP,
) -> float:
    """How high the block comes [m]."""
    model = compile_world(Recipe(scene(), step)).model
    kinds = mujoco.mjtCone
    model.opt.cone = kinds.mjCONE_ELLIPTIC if cone else kinds.mjCONE_PYRAMIDAL
    model.opt.impratio, model.opt.noslip_iterations = ratio, noslip
    model.geom_solref[:] = terms or (3.0 * step, 1.25)
    model.geom_solimp[:] = impedance
    data = mujoco.MjData(model)
    for _ in range(round(0.3 / step)):
        mujoco.mj_step(model, data)
    start, highest = data.qpos[2], 0.0
    data.qvel[0] = SPEED
    for _ in range(round(1.2 / step)):
        mujoco.mj_step(model, data)
        highest = max(highest, data.qpos[2] - start)
    return float(highest)


def main() -> None:
    """Print the table."""
    rows = {
        "pyramid, time constant of 3 steps": [hop(cone=False)],
        "cone, as it is for loose bodies": [hop()],
        "friction 10 or 100 times stiffer than the normal direction": [
            hop(ratio=10.0),
            hop(ratio=100.0),
        ],
        "damping 2.5 or 5 times critical": [
            hop(terms=(3.0 * STEP, 2.5)),
            hop(terms=(3.0 * STEP, 5.0)),
        ],
        "impedance 0.99, or 0.5, at first touch": [
            hop(impedance=(0.99, *RIGID[1:])),
            hop(impedance=(0.5, *RIGID[1:])),
        ],
        "MuJoCo's extra friction solver, 5 iterations": [hop(noslip=5)],
        "a step of 0.2 ms": [hop(step=0.0002)],
        "time constant of 6 steps": [hop(terms=(6.0 * STEP, 1.25))],
        "time constant of 10 steps": [hop(terms=(10.0 * STEP, 1.25))],
    }
    print("| contact | hop |\n|---|---|")
    for name, heights in rows.items():
        print(f"| {name} | {', '.join(f'{1000.0 * height:.1f} mm' for height in heights)} |")


if __name__ == "__main__":
    main()
