"""MuJoCo neither times itself nor writes logs, unless somebody wants it to."""

import mujoco
import pytest
import scenes

from gazelle.engines import make_engine
from gazelle.engines.mujoco.library import disable_logging

STEP = mujoco.mjtTimer.mjTIMER_STEP


@pytest.fixture(autouse=True)
def settled():
    yield
    mujoco.set_mjcb_time(None)
    disable_logging.cache_clear()
    disable_logging()


def run():
    """Return the place of a falling ball after a while, and MuJoCo's time of it."""
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body pos='0 0 .2'>"
        "<freejoint/><geom size='.1' mass='1'/></body></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=300)
    return data.qpos.tobytes(), data.timer[STEP].duration


def test_an_engine_stops_the_clock_and_the_results_stay():
    mujoco.set_mjcb_time(None)  # MuJoCo's own clock
    before, took = run()
    assert took > 0.0
    disable_logging.cache_clear()
    make_engine("mujoco", scenes.world(scenes.ground()))
    after, took = run()
    assert took == 0.0
    assert after == before


def test_who_wants_the_times_later_gets_them():
    disable_logging()
    mujoco.set_mjcb_time(None)
    make_engine("mujoco", scenes.world(scenes.ground()))
    assert run()[1] > 0.0


def test_a_clock_that_somebody_set_is_left_alone():
    disable_logging.cache_clear()
    mujoco.set_mjcb_time(lambda: 1.0)
    disable_logging()
    assert mujoco.get_mjcb_time() is not None


def test_no_log_file_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    disable_logging.cache_clear()
    disable_logging()
    config = mujoco.MjLogConfig.get()
    assert not config.logto_file
    assert not config.logto_console
