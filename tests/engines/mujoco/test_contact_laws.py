"""The compiled laws: whom they concern, and that threads do not matter to them."""

import ctypes
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import scenes

from gazelle.description import Bounce, Friction, Pose, Surface
from gazelle.engines import make_engine
from gazelle.errors import EngineError, EngineWarning

ELSEWHERE = """
<mujoco>
  <option cone="elliptic"/>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body pos="0 0 0.5"><freejoint/><geom name="ball" size="0.1"/></body>
  </worldbody>
  <contact>
    <pair geom1="floor" geom2="ball" solref="-1000 -10" solreffriction="0 -900"/>
  </contact>
</mujoco>
"""


def bouncing():
    surface = Surface(Friction(1.0, 0.1, fdir1=(1.0, 0.0, 0.0)), bounce=Bounce(0.6, 0.01))
    models = [scenes.box(f"b{i}", pose=Pose(0.5 * i, z=0.5, roll=0.3 * i)) for i in range(3)]
    return scenes.world(
        *(scenes.with_surface(each, surface) for each in (scenes.ground(), *models))
    )


def fall():
    model = mujoco.MjModel.from_xml_string(ELSEWHERE)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=600)
    return data.qpos.copy()


def test_models_that_are_not_gazelles_move_as_without_it():
    present = mujoco.get_mjcb_control()
    mujoco.set_mjcb_control(None)
    try:
        before = fall()
    finally:
        mujoco.set_mjcb_control(present)
    make_engine("mujoco", bouncing())
    assert mujoco.get_mjcb_control() is not None
    np.testing.assert_array_equal(fall(), before)


def test_the_results_do_not_depend_on_threads_or_other_worlds():
    states = []
    for nworld, threads in ((1, 1), (16, 1), (16, 4)):
        engine = make_engine("mujoco", bouncing(), nworld, threads=threads)
        engine.models["b1"].set_motion((0.5, 0.2, 0.0), (0.0, 1.0, 2.0))
        engine.step(1500)
        states.append(engine.snapshot()[-1])
    np.testing.assert_array_equal(states[0], states[1])
    np.testing.assert_array_equal(states[1], states[2])


def test_somebody_elses_callback_is_not_taken_away():
    present = mujoco.get_mjcb_control()
    theirs = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(lambda _m, _d: None)
    mujoco.set_mjcb_control(theirs)
    try:
        with pytest.raises(EngineError, match="mjcb_control"):
            make_engine("mujoco", bouncing())
        with pytest.warns(EngineWarning, match="sliding bodies may hop"):
            make_engine("mujoco", scenes.world(scenes.ground(), scenes.box()))
        make_engine("mujoco", scenes.world(scenes.ground(0.0)))
    finally:
        mujoco.set_mjcb_control(present)


def test_what_is_spawned_brings_its_laws_along():
    ground, *boxes = bouncing().models
    engine = make_engine("mujoco", scenes.world(ground))
    engine.spawn(replace(boxes[0], pose=Pose(z=1.1)))
    engine.step(460)
    heights = []
    for _ in range(400):
        engine.step()
        heights.append(engine.models["b0"].placement().position[0, 2] - 0.1)
    assert max(heights[30:]) == pytest.approx(0.36, rel=0.02)
    engine.delete("b0")
    engine.step(10)
