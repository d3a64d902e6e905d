"""The bundled worlds are laid out as the published ones (ROBOTIS, turtlebot3_simulations)."""

from __future__ import annotations

import math

import numpy as np
import plan
import pytest
from lxml import etree

from gazelle import assets

STAGES = [f"turtlebot3_stage_{number}" for number in (1, 2, 3, 4)]
WORLDS = [*STAGES, "turtlebot3_world", "empty", "furnished_room"]
START = {"turtlebot3_stage_4": (-0.7, 0.0), "turtlebot3_world": (-2.0, -0.5)}
ANGLES = np.linspace(-math.pi, math.pi, 361)

# Tables of the two walkers of stage 4: the step a tick [m] and the point to come near to [m].
WALKERS = {
    "obstacle_1": (
        (2, 2),
        (
            "-.005 -.012 1.5 .8 | -.01 .007 .5 1.5 | -.008 -.002 -.3 1.3 | -.007 -.005 -1 .8 |"
            "-.01 .007 -2 1.5 | -.002 -.007 -2.2 .8 | .004 -.011 -1.8 -.3 | .003 -.007 -1.5 -1 |"
            ".009 .007 -.6 -.3 | .011 -.011 .5 -1.4 | .006 -.006 1.1 -2 | .009 .01 2 -1 |"
            "-.008 .01 1.2 0 | -.007 .005 .5 .5 | .017 .008 2.2 1.3 | -.002 .007 2 2"
        ),
    ),
    "obstacle_2": (
        (-2, -2),
        (
            ".007 -.001 -1.3 -2.1 | .009 .009 -.4 -1.2 | -.006 .006 -1 -.6 | .008 -.001 -.2 -.7 |"
            ".013 -.013 1.1 -2 | .009 .01 2 -1 | -.008 .01 1.2 0 | -.007 .02 .5 2 |"
            "-.013 -.001 -2.1 1.8 | .008 -.008 -.5 .2 | -.002 -.0115 -.9 -2.1 | -.011 .001 -2 -2"
        ),
    ),
}


def walk(name):
    """Return positions of a walker at every tick of one round, from the published rule."""
    place, table = WALKERS[name]
    legs = [[float(word) for word in row.split()] for row in table.split("|")]
    position, state, track = np.array(place, float), 0, [np.array(place, float)]
    while state < len(legs):
        dx, dy, *goal = legs[state]
        position = position + np.array((dx, dy))
        track.append(position)
        assert len(track) < 3000, "a goal is missed"
        if (np.abs(position - goal) < 0.05).all():
            state += 1
    return np.array(track)


def key_frames(name):
    model = {name: model for name, _, model in plan.models("turtlebot3_stage_4")}[name]
    motion = model.find("plugin")
    assert motion.findtext("loop") == "true"
    times = [float(time.text) for time in motion.iterfind("waypoint/time")]
    places = [plan.pose(waypoint) for waypoint in motion.iterfind("waypoint")]
    return np.array(times), np.array(places)


@pytest.mark.parametrize("world", WORLDS)
def test_a_world_is_well_formed_and_its_models_are_bundled(world):
    root = plan.root(assets.world(world))
    assert root.get("version") == "1.7"
    assert root.find("world").get("name") == "default"
    uris = [uri.text.removeprefix("model://") for uri in root.iterfind("world/include/uri")]
    assert uris[:2] == ["sun", "ground_plane"]
    assert set(uris) <= set(assets.models())
    names = [name for name, _, _ in plan.models(world)]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("world", WORLDS)
def test_physics_is_the_published_one(world):
    physics = plan.root(assets.world(world)).find("world/physics")
    solver, constraints = physics.find("ode/solver"), physics.find("ode/constraints")
    assert physics.get("type") == "ode"
    assert solver.findtext("type") == "quick"
    assert solver.findtext("use_dynamic_moi_rescaling") == "true"
    found = {
        child.tag: float(child.text)
        for element in (physics, solver, constraints)
        for child in element
        if len(child) == 0 and child.tag not in {"type", "use_dynamic_moi_rescaling"}
    }
    assert found == {
        "max_step_size": 0.001,
        "real_time_factor": 1,
        "real_time_update_rate": 1000,
        "iters": 150,
        "precon_iters": 0,
        "sor": 1.4,
        "cfm": 1e-5,
        "erp": 0.2,
        "contact_max_correcting_vel": 2000,
        "contact_surface_layer": 0.01,
    }


@pytest.mark.parametrize("world", [*STAGES, "turtlebot3_world"])
def test_walls_are_closed_around_the_start(world):
    x, y = START.get(world, (0.0, 0.0))
    ranges = [plan.range_at(world, angle, x=x, y=y) for angle in ANGLES]
    assert max(ranges) < 7.0
    assert min(ranges) > 0.2


@pytest.mark.parametrize(("world", "clear"), [(STAGES[0], 1.85), (STAGES[3], 2.35)])
def test_outer_walls_stand_where_published(world, clear):
    walls = [s for s in plan.shapes(world) if s.static and s.half[0] > 1]
    assert [(w.low, w.high) for w in walls] == [(0.0, 0.5)] * 4
    for angle in (0, math.pi / 2, math.pi, -math.pi / 2):
        found = min(wall.distance(0, 0, angle) for wall in walls)
        assert found == pytest.approx(clear, abs=1e-4)


def test_inner_walls_of_stage_4():
    inner = {
        (round(s.x, 5), round(s.y, 5), round(s.yaw, 4)): (s.half, s.low, s.high)
        for s in plan.shapes("turtlebot3_stage_4")
        if s.static and s.half[0] < 1
    }
    assert inner == dict.fromkeys(
        [
            (-1.937, -1.467, 0),
            (-0.22, -1.866, -1.5708),
            (1.195, -1.002, 1.5708),
            (1.288, 1.93, -1.5708),
            (1.91128, 0.4632, 0),
            (0.204, 0.215, -1.5708),
            (-1.064, 1.548, 0),
            (-1.502, 0.092, -1.5708),
        ],
        ((0.5, 0.075), 0.0, 0.5),
    )


@pytest.mark.parametrize(("world", "static"), [(STAGES[1], True), (STAGES[2], False)])
def test_four_pillars(world, static):
    (model,) = (model for name, _, model in plan.models(world) if name == "obstacle")
    assert [link.get("name") for link in model.findall("link")] == ["obstacle"]
    assert (model.findtext("static") == "true") == static
    pillars = {(s.x, s.y, s.radius, s.low, s.high) for s in plan.shapes(world) if s.radius}
    assert pillars == {(x, y, 0.15, 0.0, 0.5) for x in (-0.6, 0.6) for y in (-0.6, 0.6)}


def test_pillars_of_stage_3_turn_about_the_centre():
    (model,) = (model for name, _, model in plan.models(STAGES[2]) if name == "obstacle")
    assert plan.pose(model) == (0,) * 6
    assert model.find("plugin").get("filename") == "libgazelle_scripted_motion.so"
    assert 0.12 < float(model.findtext("plugin/angular_velocity").split()[2]) < 0.14
    assert float(model.findtext("link/inertial/mass")) == 1
    assert float(model.findtext("link/inertial/inertia/izz")) == 1


@pytest.mark.parametrize("name", WALKERS)
def test_walkers_start_where_published_and_stand_on_the_floor(name):
    ((where, model),) = (
        (where, model) for found, where, model in plan.models(STAGES[3]) if found == name
    )
    assert where == (*WALKERS[name][0], 0.125, 0, 0, 0)
    assert model.find("static") is None
    cylinder = model.find("link/collision/geometry/cylinder")
    assert float(cylinder.findtext("radius")) == 0.12
    assert float(cylinder.findtext("length")) == 0.25
    assert (key_frames(name)[1][0] == where).all()


@pytest.mark.parametrize("name", WALKERS)
def test_walkers_keep_to_the_published_path_tick_by_tick(name):
    times, places = key_frames(name)
    track = walk(name)
    ticks = np.arange(len(track)) * 0.1
    assert ticks[-1] == pytest.approx(times[-2])
    for axis in (0, 1):
        found = np.interp(ticks, times, places[:, axis])
        assert found == pytest.approx(track[:, axis], abs=1e-4)


@pytest.mark.parametrize("name", WALKERS)
def test_walkers_close_their_loop_at_their_usual_pace(name):
    times, places = key_frames(name)
    assert (places[-1] == places[0]).all()
    assert (np.diff(times) > 0).all()
    pace = np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1) / np.diff(times)
    assert pace[-1] == pytest.approx(pace[-2], rel=0.2)
    assert pace.max() < 0.25


def test_nine_pillars_and_a_hexagon():
    pillars = {(s.x, s.y) for s in plan.shapes("turtlebot3_world") if s.radius == 0.15}
    assert pillars == {(x, y) for x in (-1.1, 0, 1.1) for y in (-1.1, 0, 1.1)}
    for turn in range(6):
        angle = math.pi / 6 + turn * math.pi / 3
        walls = [s for s in plan.shapes("turtlebot3_world") if s.half[0] > 1.5]
        assert min(w.distance(0, 0, angle) for w in walls) == pytest.approx(2.54, abs=1e-4)


@pytest.mark.corpus
def test_hexagon_is_where_the_published_mesh_is(corpus):
    """The published walls and limbs are meshes; ours are boxes. A ray meets both at one place."""
    trimesh = pytest.importorskip("trimesh")
    folder = corpus / "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/models"
    model = etree.parse(str(folder / "turtlebot3_world" / "model.sdf")).getroot()
    lines = []
    for collision in model.iterfind(".//collision"):
        uri = collision.findtext("geometry/mesh/uri")
        if uri is None:
            continue
        mesh = trimesh.load(folder / uri.removeprefix("model://"), force="mesh")
        x, y, z, _, _, yaw = plan.pose(collision)
        scale = float(collision.findtext("geometry/mesh/scale").split()[0]) * 0.0254
        mesh.apply_scale(scale)
        mesh.apply_transform(trimesh.transformations.rotation_matrix(yaw, (0, 0, 1)))
        mesh.apply_translation((x, y, z))
        section = trimesh.intersections.mesh_plane(mesh, (0, 0, 1), (0, 0, 0.182))
        lines.extend(section[:, :, :2])
    limbs = [s for s in plan.shapes("turtlebot3_world") if not s.radius]
    for angle in ANGLES[::5] + 0.003:
        ours = min(limb.distance(0, 0, angle) for limb in limbs)
        assert ours == pytest.approx(meet(np.array(lines), angle), abs=2e-3)


def meet(lines, angle):
    """Return the first hit of a ray from the origin with segments of shape (n, 2, 2) [m]."""
    way = np.array([math.cos(angle), math.sin(angle)])
    along = lines @ way
    aside = lines @ np.array([-way[1], way[0]])
    crossing = aside[:, 0] * aside[:, 1] < 0
    share = aside[crossing, 0] / (aside[crossing, 0] - aside[crossing, 1])
    distance = along[crossing, 0] + share * (along[crossing, 1] - along[crossing, 0])
    return distance[distance > 0].min()


def test_floor_is_as_rough_as_gazebos():
    friction = plan.root(assets.models()["ground_plane"]).find(".//friction/ode")
    assert (float(friction.findtext("mu")), float(friction.findtext("mu2"))) == (100, 50)


def test_goal_box_is_seen_but_not_felt():
    model = plan.root(assets.models()["goal_box"]).find("model")
    assert model.findtext("static") == "true"
    assert plan.pose(model)[5] == pytest.approx(-math.pi / 2, abs=1e-4)
    assert model.findtext(".//size") == "0.5 0.5 0.001"
    assert model.find(".//collision") is None


def test_furnished_room_has_one_door_and_room_for_a_robot():
    """Just above the floor, rays leave only by the door; half a metre about the start is free."""
    walls = [s for s in plan.shapes("furnished_room") if s.high == 1.0 and max(s.half) > 0.7]
    assert len(walls) == 5
    for angle in ANGLES:
        out = min(wall.distance(0, 0, angle) for wall in walls) == math.inf
        at_door = angle < 0 and 0.6 < -2.5 / math.tan(angle) < 1.5 * 2.6 / 2.5
        if out:
            assert at_door
        near = plan.range_at("furnished_room", angle)
        assert near > 0.5
    assert any(min(wall.distance(0, 0, angle) for wall in walls) == math.inf for angle in ANGLES)


def test_furniture_does_not_stand_in_furniture():
    boxes = [
        (name, s)
        for name, where, model in plan.models("furnished_room")
        for link in model.findall("link")
        for c in link.findall("collision")
        if c.find("geometry/plane") is None and c.find("geometry/sphere") is None
        for s in [plan.shape(where, plan.pose(link), c, static=True)]
    ]
    for name, one in boxes:
        for other_name, other in boxes:
            if name >= other_name or one.high <= other.low or other.high <= one.low:
                continue
            assert not overlap(one, other), (name, other_name)


def overlap(one, other):
    """Return whether two plan shapes overlap, by samples of the one's outline [1 mm apart]."""
    reach = [max(s.radius, math.hypot(*s.half)) for s in (one, other)]
    if math.hypot(one.x - other.x, one.y - other.y) > sum(reach):
        return False
    return any(
        big.distance(*point, 0.0) == 0.0
        for small, big in ((one, other), (other, one))
        for point in outline(small)
    )


def outline(shape):
    for turn in np.linspace(0, 2 * math.pi, 60, endpoint=False):
        if shape.radius:
            u, v = 0.999 * shape.radius * math.cos(turn), 0.999 * shape.radius * math.sin(turn)
        else:
            c, s = math.cos(turn), math.sin(turn)
            stretch = 0.999 / max(abs(c), abs(s))
            u, v = shape.half[0] * c * stretch, shape.half[1] * s * stretch
        cos, sin = math.cos(shape.yaw), math.sin(shape.yaw)
        yield shape.x + cos * u - sin * v, shape.y + sin * u + cos * v
