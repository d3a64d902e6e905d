"""TurtleBot3's own robots and worlds load unchanged, and mean what their makers meant."""

import math
import warnings

import pytest
from xml_samples import joint, link

from gazelle import Pose, formats
from gazelle.description import Box, Cylinder, Mesh
from gazelle.errors import FormatWarning

pytestmark = pytest.mark.corpus

ROBOTS = ["burger", "waffle", "waffle_pi"]
WORLDS = ["empty", *(f"turtlebot3_stage_{n}" for n in range(1, 5)), "turtlebot3_world", "turtlebot3_house"]  # fmt: skip
LEFT_OUT = "not found: "


@pytest.fixture(scope="module")
def description(corpus):
    return corpus / "ROBOTIS-GIT__turtlebot3" / "turtlebot3_description" / "urdf"


@pytest.fixture(scope="module")
def simulation(corpus):
    return corpus / "ROBOTIS-GIT__turtlebot3_simulations" / "turtlebot3_gazebo"


def load(path):
    """Load the world; only meshes that the corpus leaves out may be reported."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        world = formats.load(path)
    assert all(LEFT_OUT in str(warning.message) for warning in caught)
    return world


@pytest.mark.parametrize("name", ROBOTS)
def test_urdf_robots_are_a_body_and_two_wheels(description, name):
    model = load(description / f"turtlebot3_{name}.urdf.xacro").models[0]
    assert [found.name for found in model.links] == [
        "base_footprint",
        "wheel_left_link",
        "wheel_right_link",
    ]
    assert [found.name for found in model.joints] == ["wheel_left_joint", "wheel_right_joint"]
    frames = {frame.name for frame in model.frames}
    assert {"base_link", "base_scan", "imu_link"} <= frames
    assert {"turtlebot3_" + name + "_controller"} <= {plugin.name for plugin in model.plugins}


def test_the_burger_has_its_figures(description):
    model = load(description / "turtlebot3_burger.urdf.xacro").models[0]
    left = link(model, "wheel_left_link")
    assert left.pose.is_close(Pose(0, 0.08, 0.033, -1.57))
    assert left.collisions[0].geometry == Cylinder(0.033, 0.018)
    assert left.collisions[0].surface.friction.mu == 0.1
    assert left.collisions[0].surface.contact.kp == 500000.0
    assert joint(model, "wheel_left_joint").axes[0].xyz == (0, 0, 1)
    base = link(model, "base_footprint")
    assert base.inertial.mass == pytest.approx(8.2573504e-01 + 0.005 + 0.114)
    assert base.collisions[0].geometry == Box((0.140, 0.140, 0.143))
    assert (
        base.collisions[1].name == "base_footprint_fixed_joint_lump__caster_back_link_collision_1"
    )
    scan = next(sensor for sensor in base.sensors if sensor.lidar is not None)
    assert scan.pose.is_close(Pose(-0.032, 0, 0.182))
    assert scan.lidar.horizontal.samples == 360
    assert (scan.lidar.range_min, scan.lidar.range_max) == (0.12, 3.5)
    assert scan.plugins[0].parameters.get("frameName", "") == "base_scan"
    frame = next(frame for frame in model.frames if frame.name == "base_scan")
    assert frame.attached_to == "base_footprint"
    assert frame.pose.is_close(Pose(-0.032, 0, 0.182))


@pytest.mark.parametrize("name", ROBOTS)
def test_sdf_robots_load(simulation, name):
    model = load(simulation / "models" / f"turtlebot3_{name}").models[0]
    assert model.name == f"turtlebot3_{name}"
    left = joint(model, "left_wheel_joint")
    assert left.type == "revolute"
    assert link(model, left.child).collisions
    assert left.axes[0].xyz == (0, 1, 0)


@pytest.mark.parametrize("name", WORLDS)
def test_worlds_load(simulation, name):
    world = load(simulation / "worlds" / f"{name}.world")
    assert world.models[0].name == "ground_plane"
    assert world.lights[0].name == "sun"
    assert world.profile.max_step_size == 0.001
    assert world.profile.ode.iters == 150


def test_stage_4_has_its_walls_and_obstacles(simulation):
    world = load(simulation / "worlds" / "turtlebot3_stage_4.world")
    names = [model.name for model in world.models]
    assert names == ["ground_plane", "turtlebot3_plaza", "obstacle_1", "obstacle_2"]
    assert world.models[1].static
    assert len(world.models[1].links) == 12
    assert [plugin.filename for plugin in world.models[3].plugins] == ["libobstacle_2.so"]


def test_the_mesh_walls_of_turtlebot3_world_stand_upright(simulation):
    model = load(simulation / "worlds" / "turtlebot3_world.world").models[1]
    walls = next(
        collision.geometry
        for collision in model.links[0].collisions
        if isinstance(collision.geometry, Mesh) and "wall" in collision.geometry.uri
    )
    low, high = formats.load_mesh(walls).bounds
    assert low[2] == pytest.approx(0.0, abs=1e-6)
    assert 0.2 < high[2] < 2.0
    assert high[0] - low[0] > 4.0


def test_the_house_has_its_rooms(simulation):
    with pytest.warns(FormatWarning, match="mailbox"):
        world = formats.load(simulation / "worlds" / "turtlebot3_house.world")
    house = world.models[1]
    assert len(house.links) == 21
    placed = list(house.walk())
    assert len(placed) == 1 + len(house.models) > 5
    assert all(math.isfinite(part.pose.x) for part in placed)


@pytest.mark.long
@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_waffle", "turtlebot3_waffle_pi"])
def test_bundled_robots_have_the_bodies_of_the_originals(description, name):
    theirs = load(description / f"{name}.urdf.xacro").models[0]
    ours = formats.load_model(name)
    assert [found.name for found in ours.links] == [found.name for found in theirs.links]
    assert {f.name for f in theirs.frames} <= {f.name for f in ours.frames}
    for mine, original in zip(ours.links, theirs.links, strict=True):
        assert mine.pose.is_close(original.pose, position=1e-6, angle=1e-3)
        assert mine.inertial.mass == pytest.approx(original.inertial.mass, rel=1e-6)
