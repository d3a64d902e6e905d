"""Actors that find their way."""

import numpy as np
import pytest
from models import simulate

from gazelle.errors import PluginWarning

ACTOR = """<actor name="walker"><pose>{start} 0 0 {yaw}</pose><link name="l"><visual name="v">
<geometry><sphere><radius>0.2</radius></sphere></geometry></visual></link>
<plugin name="p" filename="libActorPlugin.so"><target>{target} 1</target>{tags}</plugin></actor>"""
POST = """<model name="{name}"><static>1</static><pose>{x} {y} 1 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>0.2 0.2 2</size></box></geometry></collision></link>
</model>"""
WIDE = "<area>-50 50 -50 50</area>"


def actor(target="0 -5", start="0 0 1", tags=WIDE, yaw=0.0):
    """Return an actor that faces along yaw - pi/2, as Gazebo's do."""
    text = ACTOR.format(target=target, start=start, tags=tags, yaw=yaw + np.pi / 2)
    return text.replace("> ", ">")


def walk(*parts, nworld=1, **options):
    return simulate(*parts, nworld=nworld, ground=False, **options)


def test_it_walks_straight_to_its_target_at_its_speed():
    with walk(actor("4 0"), nworld=2) as sim:
        robot = sim.robots["walker"]
        sim.run(seconds=2.0)
        # Gazebo's speed of 0.8 m/s, times the weight of the target.
        assert robot.position == pytest.approx(np.tile([0.8 * 1.15 * 2.0, 0, 1], (2, 1)), abs=0.02)
        up = np.array([0.0, 1.0, 0.0])
        x, y, z, w = robot.quaternion[0]
        v = np.array([x, y, z])
        turned = up + 2.0 * np.cross(v, np.cross(v, up) + w * up)
        assert turned == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)  # by the hip: y is up
        sim.reset()
        assert robot.position[:, 0] == pytest.approx(0.0)


def test_it_turns_in_place_by_its_angle_before_it_goes():
    with walk(actor("0 5")) as sim:
        robot = sim.robots["walker"]
        sim.run(seconds=1.0)
        assert robot.position[0, :2] == pytest.approx(0.0, abs=1e-9)
        # The angle left shrinks by e a second, down to 10 degrees.
        sim.run(seconds=np.log(9.0) - 1.0 - 0.1)
        assert robot.position[0, 1] == pytest.approx(0.0, abs=1e-9)
        sim.run(seconds=1.0)
        assert robot.position[0, 1] > 0.5


def test_models_push_it_away_unless_they_are_ignored():
    post = POST.format(name="post", x=2.0, y=0.5)
    with walk(actor("6 0"), post) as sim:
        sim.run(seconds=1.5)
        assert sim.robots["walker"].position[0, 1] < -0.05
    ignored = f"{WIDE}<ignore_obstacles><model>post</model></ignore_obstacles>"
    with walk(actor("6 0", tags=ignored), post) as sim:
        sim.run(seconds=1.5)
        assert sim.robots["walker"].position[0, 1] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.long
def test_targets_are_drawn_in_each_world_far_from_models_and_within_the_area():
    tags = "<area>-4 4 -4 4</area><ignore_obstacles><model>a</model><model>b</model></ignore_obstacles>"
    posts = [POST.format(name="a", x=3, y=3), POST.format(name="b", x=-3, y=-3)]
    with walk(actor("0.2 0", tags=tags), *posts, nworld=4, seed=3) as sim:
        robot = sim.robots["walker"]
        (plugin,) = [p.plugin for p in sim.plugins]
        sim.run(seconds=0.1)
        targets = plugin.state()["target"]
        assert len({tuple(t) for t in targets.round(9).tolist()}) == 4
        for far in ((0.2, 0.0), (3.0, 3.0), (-3.0, -3.0)):
            assert (np.hypot(*(targets[:, :2] - far).T) >= 2.0).all()
        state = sim.snapshot()
        sim.run(seconds=20.0)
        assert (np.abs(robot.position[:, :2]) <= 4.0).all()
        assert (plugin.state()["target"] != targets).any()
        first = robot.position.copy()
        sim.restore(state)
        sim.run(seconds=20.0)
        np.testing.assert_array_equal(robot.position, first)


def test_an_area_has_an_extent():
    with pytest.raises(PluginWarning, match="<area>"):
        walk(actor(tags="<area>1 1 0 2</area>"))
