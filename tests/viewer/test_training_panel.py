"""The curve of a training on its page."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.simulation import Simulation
from gazelle.training.progress import NoProgress, Watched
from gazelle.viewer.page.training_panel import TrainingCurve, column, progress_text
from gazelle.viewer.training_page import TrainingPage


def test_points_thin_out_and_the_first_and_the_last_stay():
    curve = TrainingCurve()
    for steps in range(2000):
        curve.add(steps, {"return": 2.0 * steps})
    steps, values = column(list(curve.points), "return")
    assert len(steps) <= 500
    assert (steps[0], steps[-1]) == (0, 1999)
    assert (np.diff(steps) > 0).all()
    assert (values == 2.0 * steps).all()


def test_the_text_has_what_the_task_reports():
    assert progress_text(2000, 1000, {}) == "1,000 of 2,000 steps"
    text = progress_text(2000, 1000, {"success_rate": 0.25, "return": -3.14159})
    assert "success **25%** of the latest goals" in text
    assert "return **-3.142** of an episode" in text


def test_the_page_of_a_training_shows_steps_success_and_both_curves():
    with Simulation("empty", threads=1) as sim:
        page = TrainingPage(sim, lambda: np.array([[1.0, 2.0]]), 0)
        display = Watched(NoProgress(), lambda _: page)
        display.attach(object())
        display.start(0, 4000)
        display.update(0, {})
        page._view._picture()
        panel = page._view._layers[1]
        assert panel._charts == {}
        for steps in (1000, 2000, 3000):
            display.update(steps, {"success_rate": steps / 4000, "return": float(-steps)})
        page._view._picture()
        assert "3,000 of 4,000 steps" in panel._text.content
        assert "75%" in panel._text.content
        np.testing.assert_array_equal(panel._charts["success_rate"].data[0], [1000, 2000, 3000])
        np.testing.assert_array_equal(panel._charts["success_rate"].data[1], [0.25, 0.5, 0.75])
        np.testing.assert_array_equal(panel._charts["return"].data[1], [-1000, -2000, -3000])
        display.close()
