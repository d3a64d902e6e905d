"""Things under the cursor land on what a ray meets."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.simulation import Simulation
from gazelle.viewer.page.landing import landing_point
from tests.viewer.lamp_world import LAMP_WORLD

WORLD = np.array([0])


@pytest.fixture(scope="module", params=["mujoco", "planar"])
def room(request, tmp_path_factory):
    file = tmp_path_factory.mktemp("worlds") / "room.world"
    file.write_text(LAMP_WORLD)
    with Simulation(file, request.param, threads=1) as simulation:
        yield simulation


@pytest.mark.parametrize(
    ("eye", "through", "lands"),
    [
        ((0.2, 0.1, 4.0), (0.2, 0.1, 0.0), (0.2, 0.1, 1.0)),  # on the box
        ((3.0, 1.0, 2.0), (1.0, 1.0, 0.0), (1.0, 1.0, 0.0)),  # on the ground
        ((3.0, 0.2, 0.5), (0.5, 0.2, 0.5), (0.51, 0.2, 0.0)),  # before the side of the box
        ((0.0, 0.0, 3.0), (0.0, 0.0, 4.0), (np.nan,) * 3),  # the sky
    ],
)
def test_a_thing_lands_on_the_surface_or_before_it(room, eye, through, lands):
    eye, through = np.array(eye), np.array(through)
    found = landing_point(room, WORLD, eye, through - eye)
    np.testing.assert_allclose(found, lands, atol=0.011)
