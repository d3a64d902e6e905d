"""Scripted motion."""

import dataclasses

import models
import numpy as np
import pytest
import scenes

from gazelle.description import Cylinder, Parameters, Plugin, Pose
from gazelle.errors import PluginWarning
from gazelle.simulation import Simulation


def script(*waypoints, **tags):
    children = [Parameters(k, str(v)) for k, v in tags.items()]
    for time, pose in waypoints:
        children.append(
            Parameters(
                "waypoint", children=(Parameters("time", str(time)), Parameters("pose", pose))
            )
        )
    return Plugin(
        "motion", "libgazelle_scripted_motion.so", Parameters("plugin", children=tuple(children))
    )


def moving(plugin, pose=None):
    body = scenes.solid("post", Cylinder(0.15, 0.5), pose=pose)
    return dataclasses.replace(body, plugins=(plugin,))


def test_it_is_on_the_line_between_waypoints_and_loops():
    plugin = script((0, "0 0 0.25 0 0 0"), (2, "2 0 0.25 0 0 0"), (4, "0 0 0.25 0 0 0"), loop=True)
    with Simulation(scenes.world(moving(plugin))) as sim:
        post = sim.robots["post"]
        for seconds, x in ((1.01, 1.0), (1.0, 2.0), (1.0, 1.0), (2.0, 1.0)):
            sim.run(seconds)
            assert post.position[0, 0] == pytest.approx(x, abs=0.11)  # set ten times a second


def test_without_a_loop_it_stays_at_the_last_waypoint():
    plugin = script((0, "0 0 1 0 0 0"), (1, "1 0 1 0 0 3.0"))
    with Simulation(scenes.world(moving(plugin))) as sim:
        sim.run(3.0)
        assert sim.robots["post"].pose.is_close(Pose(1.0, 0.0, 1.0, yaw=3.0), angle=1e-6)


def test_it_turns_evenly_about_its_origin():
    plugin = script(angular_velocity="0 0 0.5", updateRate=0)
    with Simulation(scenes.world(moving(plugin, Pose(1.0, 2.0, 0.25, yaw=0.3)))) as sim:
        sim.run(2.0)
        pose = sim.robots["post"].pose
        assert pose.yaw == pytest.approx(1.3, abs=1e-3)
        assert (pose.x, pose.y) == (1.0, 2.0)


@pytest.mark.long
def test_every_world_restarts_its_own_script():
    plugin = script((0, "0 0 1 0 0 0"), (10, "10 0 1 0 0 0"), updateRate=0)
    with Simulation(scenes.world(moving(plugin)), nworld=2) as sim:
        sim.run(2.0)
        sim.reset([1])
        sim.run(1.0)
        np.testing.assert_allclose(sim.robots["post"].position[:, 0], [3.0, 1.0], atol=0.002)


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
@pytest.mark.parametrize("elapsed", [0.0, 0.7, 3.9])
def test_begun_so_long_ago_it_is_where_it_would_be(engine, elapsed):
    """Some worlds only, and both at once and later."""
    path = script(
        (0, "0 0 0.25 0 0 0"), (2, "2 0 0.25 0 0 0"), (4, "0 0 0.25 0 0 0"), loop=True, updateRate=0
    )
    with Simulation(scenes.world(moving(path)), nworld=3, engine=engine) as sim:
        plugin = sim.plugins[0].plugin
        assert plugin.period == 4.0
        sim.run(0.5)
        plugin.begin_at(np.full(2, elapsed), np.array([0, 2]))
        for later in (0.0, 0.6):
            sim.run(later)
            x = 2.0 - abs(2.0 - (elapsed + later) % 4.0)
            np.testing.assert_allclose(sim.robots["post"].position[[0, 2], 0], x, atol=0.02)
            assert sim.robots["post"].position[1, 0] == pytest.approx(0.5 + later, abs=0.02)


@pytest.mark.parametrize(
    ("plugin", "period"),
    [
        (script(angular_velocity="0 0 0.5"), 4.0 * np.pi),
        (script(angular_velocity="0 0 0"), 0.0),
        (script((0, "0 0 1 0 0 0"), (3, "1 0 1 0 0 0")), 0.0),
        (script((0, "0 0 1 0 0 0"), (3, "1 0 1 0 0 0"), loop=True), 3.0),
    ],
)
def test_its_period_is_when_it_begins_anew(plugin, period):
    with Simulation(scenes.world(moving(plugin))) as sim:
        assert sim.plugins[0].plugin.period == pytest.approx(period)


@pytest.mark.long
def test_it_pushes_and_nothing_pushes_it():
    plugin = script((0, "0 0 0.25 0 0 0"), (4, "1 0 0.25 0 0 0"), updateRate=0)
    box = scenes.box(pose=Pose(x=0.5, z=0.1))
    with Simulation(scenes.world(scenes.ground(), box, moving(plugin))) as sim:
        sim.run(4.5)
        assert sim.robots["post"].position[0, 0] == pytest.approx(1.0, abs=1e-6)
        assert sim.robots["box"].position[0, 0] > 1.2


ACTOR = """<actor name="walker"><link name="l"><visual name="v"><pose>0 0 0.5 0 0 0</pose><geometry>
<cylinder><radius>0.2</radius><length>1</length></cylinder></geometry></visual></link><script>
<loop>false</loop><trajectory id="0" type="t" tension="0.5"><waypoint><time>0</time>
<pose>3 0 0 0 0 0</pose></waypoint><waypoint><time>2</time><pose>1 0 0 0 0 0</pose></waypoint>
<waypoint><time>4</time><pose>1 4 0 0 0 1</pose></waypoint></trajectory></script></actor>"""
LIDAR = """<sensor name="eye" type="ray"><pose>0.3 0 0 0 0 0</pose><update_rate>20</update_rate><ray>
<scan><horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle></horizontal>
</scan><range><min>0.05</min><max>9</max></range></ray></sensor>"""


def test_an_actor_follows_its_spline_is_seen_and_pushes_nothing():
    with models.simulate(ACTOR, models.block(LIDAR), nworld=2) as sim:
        actor, cube = sim.robots["walker"], sim.robots["cube"]
        eye = cube.sensors["eye"]
        sim.run(seconds=1.0)
        # Half way on the first leg, by Hermite's formula with tangents (-0.5, 0) and (-0.5, 1).
        assert actor.position[0, :2] == pytest.approx([2.0, -0.125], abs=0.05)
        assert eye.current()[0] == pytest.approx(2.0 - 0.3 - np.sqrt(0.04 - 0.125**2), abs=0.05)
        sim.reset([1])
        sim.run(seconds=0.1)
        assert actor.position[1, 0] == pytest.approx(3.0, abs=0.05)


def test_actors_go_through_what_stands_in_their_way():
    way = ACTOR.replace("<pose>1 0 0 0 0 0</pose>", "<pose>-3 0 0 0 0 0</pose>")
    with models.simulate(way, models.block()) as sim:
        sim.run(seconds=0.5)
        before = sim.robots["cube"].position.copy()
        sim.run(seconds=1.5)
        np.testing.assert_allclose(sim.robots["cube"].position, before, atol=1e-4)


def test_times_must_increase():
    plugin = script((1, "0 0 0 0 0 0"), (1, "1 0 0 0 0 0"))
    with pytest.raises(PluginWarning, match="must increase"):
        Simulation(scenes.world(moving(plugin)))
