"""Cylinders on planes: what the engine's own collision function finds, and what MuJoCo's does."""

import subprocess
import sys

import mujoco
import numpy as np
import scenes

from gazelle.description import Cylinder, Pose
from gazelle.engines import make_engine
from gazelle.engines.mujoco.contact_laws.collision_table import replace_plane_cylinder

# Contacts of a cylinder on planes, as numbers; in a process of its own it is MuJoCo's function.
FIND = """
import mujoco, numpy as np
rng, found = np.random.default_rng(1), []
for _ in range(3):
    one, two = rng.uniform(-90.0, 90.0, 2)
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom type="plane" size="1 1 1" euler="{one} {two} 0"/>'
        '<body><freejoint/><geom type="cylinder" size="0.1 0.02" mass="1"/></body>'
        '</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    for _ in range(500):
        quaternion = rng.normal(size=4)
        data.qpos[:3] = rng.uniform(-0.08, 0.08, 3)
        data.qpos[3:] = quaternion / np.linalg.norm(quaternion)
        mujoco.mj_forward(model, data)
        for contact in data.contact:
            found += [data.ncon, contact.dist, *contact.pos, *contact.frame]
"""


def test_leaning_cylinders_touch_where_mujoco_says():
    assert replace_plane_cylinder() is not None
    program = FIND + "import sys; sys.stdout.buffer.write(np.array(found).tobytes())"
    theirs = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    ours = {}
    exec(FIND, ours)
    assert len(ours["found"]) > 10_000
    np.testing.assert_allclose(ours["found"], np.frombuffer(theirs.stdout), rtol=0.0, atol=1e-14)


def test_upright_cylinders_touch_with_three_points_of_their_rim():
    """Whatever the last digits of their axis say."""
    replace_plane_cylinder()
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><geom type="plane" size="1 1 1"/><body><freejoint/>'
        '<geom type="cylinder" size="0.1 0.02" mass="1"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qpos[:] = 0.0, 0.0, 0.019, 1.0, 0.0, 0.0, 0.0
    mujoco.mj_forward(model, data)
    for digits in range(-20, 21):
        for lean in (0.0, 1e-19, 1e-16, 1e-13, 1e-10):
            axes = np.eye(3)
            axes[2, 2] += digits * 2.0**-52
            axes[0, 2], axes[2, 0] = lean, -lean
            data.geom_xmat[1] = axes.ravel()
            mujoco.mj_collision(model, data)
            assert data.ncon == 3
            np.testing.assert_allclose(data.contact.dist, -0.001, atol=1e-8)


def test_a_cylinder_that_spins_where_it_stands_neither_falls_nor_flies():
    disc = scenes.solid("disc", Cylinder(0.1, 0.04), mu=0.1, pose=Pose(z=0.02))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), disc))
    engine.step(300)
    before = engine.models["disc"].placement().position[0, 2]
    for _ in range(20):
        engine.models["disc"].set_motion((0.0, 0.0, 0.0), (0.0, 0.0, 20.0))
        engine.step(100)
        assert abs(engine.models["disc"].placement().position[0, 2] - before) < 1e-5
