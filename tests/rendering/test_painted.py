"""Plain colours stay what they are, whatever shines."""

import numpy as np
import pytest

from gazelle.geometry.triangles import quadrangles
from gazelle.rendering import (
    PaintedPart,
    PinholeLens,
    Renderer,
    painted_world,
    plain_surroundings,
)

AHEAD = np.array([[0.0, 0.0, 0.0, 1.0]])
WALL = quadrangles(
    np.array([[[0.0, 1.0, -1.0], [0.0, -1.0, -1.0], [0.0, -1.0, 1.0], [0.0, 1.0, 1.0]]])
)


@pytest.mark.parametrize("shade", range(0, 256, 5))
def test_every_colour_is_shown_as_the_byte_that_it_is(shade):
    color = (shade / 255.0, (255 - shade) / 255.0, 7.0 / 255.0)
    seen = painted_world(["wall"], [PaintedPart(0, WALL, color)])
    background = (30.0 / 255.0, 31.0 / 255.0, 250.0 / 255.0, 1.0)
    renderer = Renderer(plain_surroundings(background), seen=seen)
    renderer.place("wall", np.array([[2.0, 0.0, 0.0]]), AHEAD)
    frames = renderer.render(PinholeLens(8, 8, 2.0), np.zeros((1, 3)), AHEAD)
    assert frames.color[0, 4, 4].tolist() == [shade, 255 - shade, 7]
    assert frames.depth[0, 4, 4] == pytest.approx(2.0)
    assert frames.color[0, 0, 0].tolist() == [30, 31, 250]


def test_links_that_look_alike_share_a_mesh():
    parts = [PaintedPart(link, WALL, (1.0, 0.0, 0.0)) for link in range(3)]
    seen = painted_world(["a", "b", "c"], parts)
    assert len(np.asarray(seen.shapes.vertices)) == 4
    assert [part.link for part in seen.parts] == ["a", "b", "c"]


def test_quadrangles_face_where_their_corners_go_counter_clockwise():
    assert WALL.normals.tolist() == [[-1.0, 0.0, 0.0]] * 4
    assert WALL.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    corners = WALL.vertices[None][:, [0, 1, 2, 2]]
    assert quadrangles(corners).faces.tolist() == [[0, 1, 2]]
