"""Each SDF element means what the schema says, defaults included."""

import math

import pytest
from xml_samples import joint, model, world

from gazelle import Pose, formats
from gazelle.description import (
    Box,
    Capsule,
    Contact,
    Cylinder,
    Ellipsoid,
    Empty,
    Friction,
    Plane,
    Polyline,
    Scene,
    Sphere,
)
from gazelle.errors import FormatWarning


def shape(text):
    found = model(
        f"<link name='l'><collision name='c'><geometry>{text}</geometry></collision></link>"
    )
    return found.links[0].collisions[0].geometry


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<box><size>1 2 3</size></box>", Box((1, 2, 3))),
        ("<sphere><radius>.5</radius></sphere>", Sphere(0.5)),
        ("<cylinder><radius>1</radius><length>2</length></cylinder>", Cylinder(1, 2)),
        ("<capsule><radius>1</radius><length>2</length></capsule>", Capsule(1, 2)),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", Ellipsoid((1, 2, 3))),
        ("<plane><normal>0 0 2</normal><size>5 6</size></plane>", Plane((0, 0, 1), (5, 6))),
        ("<empty/>", Empty()),
        ("", Empty()),
        (
            (
                "<polyline><point>0 0</point><point>1 0</point><point>0 1</point>"
                "<height>2</height></polyline>"
            ),
            Polyline((((0, 0), (1, 0), (0, 1)),), 2.0),
        ),
    ],
)
def test_shapes(text, expected):
    assert shape(text) == expected


def test_a_link_without_anything_has_the_defaults():
    found = model("<link name='l'/>").links[0]
    assert found.inertial is None
    assert found.gravity
    assert found.self_collide is None
    assert not found.kinematic


def test_an_empty_inertial_is_that_of_the_schema():
    inertial = model("<link name='l'><inertial/></link>").links[0].inertial
    assert inertial.mass == 1.0
    assert (inertial.inertia.ixx, inertial.inertia.ixy) == (1.0, 0.0)


def test_surface():
    found = model(
        "<link name='l'><collision name='c'><surface><friction><ode><mu>.5</mu><mu2>.6</mu2>"
        "<fdir1>1 0 0</fdir1><slip1>.1</slip1></ode></friction><contact><ode><kp>1e5</kp>"
        "<kd>10</kd><min_depth>.001</min_depth></ode></contact></surface></collision>"
        "<collision name='d'/></link>"
    )
    first, second = found.links[0].collisions
    assert first.surface.friction == Friction(0.5, 0.6, (1, 0, 0), 0.1)
    assert (first.surface.contact.kp, first.surface.contact.kd) == (1e5, 10)
    assert second.surface.friction == Friction()
    assert second.surface.contact == Contact()


AXIS = (
    "<link name='a'/><joint name='j' type='revolute'><parent>world</parent><child>a</child>"
    "<axis><limit>{}</limit></axis></joint>"
)


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        ("", (-math.inf, math.inf, math.inf, math.inf)),
        ("<lower>-1e16</lower><upper>1e+16</upper>", (-math.inf, math.inf, math.inf, math.inf)),
        ("<lower>-1.79769e+308</lower><upper>inf</upper>", (-math.inf, math.inf) + (math.inf,) * 2),
        (
            "<lower>-1</lower><upper>1</upper><effort>5</effort><velocity>-1</velocity>",
            (-1, 1, 5, math.inf),
        ),
        ("<effort>0</effort><velocity>0</velocity>", (-math.inf, math.inf, 0, 0)),
    ],
)
def test_limits_that_mean_none_become_infinite(limit, expected):
    axis = joint(model(AXIS.format(limit)), "j").axes[0]
    assert (axis.lower, axis.upper, axis.effort, axis.velocity) == expected


@pytest.mark.parametrize(
    ("kind", "count"),
    [("fixed", 0), ("ball", 0), ("revolute", 1), ("prismatic", 1), ("universal", 2)],
)
def test_joints_have_the_axes_of_their_type(kind, count):
    found = model(AXIS.replace("revolute", kind).format(""))
    assert len(joint(found, "j").axes) == count


def test_lidar():
    found = model(
        "<link name='l'><sensor name='s' type='gpu_ray'><pose>0 0 1 0 0 0</pose>"
        "<update_rate>5</update_rate><ray><scan><horizontal><samples>24</samples>"
        "<min_angle>0</min_angle><max_angle>6.28</max_angle></horizontal></scan><range>"
        "<min>.12</min><max>3.5</max><resolution>.015</resolution></range><noise>"
        "<type>gaussian</type><stddev>.01</stddev></noise></ray>"
        "<plugin name='p' filename='libx.so'><topicName>scan</topicName></plugin></sensor></link>"
    )
    sensor = found.links[0].sensors[0]
    assert sensor.pose.is_close(Pose(z=1))
    assert sensor.update_rate == 5
    assert sensor.lidar.horizontal.samples == 24
    assert sensor.lidar.vertical.samples == 1
    assert (sensor.lidar.range_min, sensor.lidar.range_max) == (0.12, 3.5)
    assert (sensor.lidar.noise.type, sensor.lidar.noise.stddev) == ("gaussian", 0.01)
    assert sensor.plugins[0].parameters.get("topicName", "") == "scan"


def test_imu_noise_of_old_and_new_files_is_the_same():
    old = (
        "<noise><type>gaussian</type><rate><stddev>2e-4</stddev></rate>"
        "<accel><stddev>1.7e-2</stddev></accel></noise>"
    )
    axes = "".join(
        f"<{group}>"
        + "".join(f"<{a}><noise type='gaussian'><stddev>{v}</stddev></noise></{a}>" for a in "xyz")
        + f"</{group}>"
        for group, v in (("angular_velocity", "2e-4"), ("linear_acceleration", "1.7e-2"))
    )
    text = "<link name='l'><sensor name='s' type='imu'><imu>{}</imu></sensor></link>"
    first = model(text.format(old), "1.5").links[0].sensors[0].imu
    second = model(text.format(axes), "1.6").links[0].sensors[0].imu
    assert first == second
    assert first.angular_velocity[2].stddev == 2e-4


def test_camera():
    found = model(
        "<link name='l'><sensor name='s' type='depth'><camera name='eye'>"
        "<horizontal_fov>1.2</horizontal_fov><image><width>640</width><height>480</height>"
        "</image><clip><near>.05</near><far>8</far></clip></camera></sensor></link>"
    )
    camera = found.links[0].sensors[0].cameras[0]
    assert (camera.name, camera.width, camera.height) == ("eye", 640, 480)
    assert (camera.near, camera.far, camera.horizontal_fov) == (0.05, 8, 1.2)


def test_contact_sensor():
    found = model(
        "<link name='l'><sensor name='s' type='contact'><contact><collision>c</collision>"
        "<topic>__default_topic__</topic></contact></sensor></link>"
    )
    assert found.links[0].sensors[0].contact.collisions == ("c",)
    assert found.links[0].sensors[0].contact.topic == ""


def test_material_scripts_give_colours():
    found = model(
        "<link name='l'><visual name='v'><material><script><name>Gazebo/Grey</name></script>"
        "</material></visual><visual name='w'><material><script>Gazebo/Red</script>"
        "<diffuse>0 1 0</diffuse></material></visual></link>"
    )
    grey, mixed = (visual.material for visual in found.links[0].visuals)
    assert grey.ambient == (0.3, 0.3, 0.3, 1.0)
    assert grey.diffuse == (0.7, 0.7, 0.7, 1.0)
    assert mixed.script == "Gazebo/Red"
    assert mixed.diffuse == (0.0, 1.0, 0.0, 1.0)


def test_world():
    found = world(
        "<physics type='ode' name='fast' default='1'><max_step_size>.002</max_step_size>"
        "<real_time_update_rate>500</real_time_update_rate><ode><solver><iters>30</iters>"
        "</solver></ode></physics><gravity>0 0 -1.6</gravity><wind>"
        "<linear_velocity>1 0 0</linear_velocity></wind><scene><ambient>1 1 1 1</ambient>"
        "</scene><light name='sun' type='directional'><direction>0 0 -1</direction></light>"
        "<gui><camera name='c'><pose>1 2 3 0 0 0</pose></camera></gui>"
        "<plugin name='p' filename='libworld.so'/><spherical_coordinates>"
        "<latitude_deg>52</latitude_deg></spherical_coordinates>"
    )
    assert found.profile.max_step_size == 0.002
    assert found.profile.ode.iters == 30
    assert found.gravity == (0, 0, -1.6)
    assert found.wind == (1, 0, 0)
    assert found.scene.ambient == (1, 1, 1, 1)
    assert found.lights[0].type == "directional"
    assert found.camera.is_close(Pose(1, 2, 3))
    assert found.plugins[0].filename == "libworld.so"
    assert found.spherical_coordinates.latitude == 52


def test_gravity_stood_in_physics_up_to_1_5():
    found = world("<physics type='ode'><gravity>0 0 -3</gravity></physics>", "1.5")
    assert found.gravity == (0, 0, -3)
    assert found.scene == Scene()


def test_state_gives_the_poses_in_the_world_frame():
    found = world(
        "<model name='m'><link name='l'><pose>0 0 1 0 0 0</pose></link></model>"
        "<state world_name='w'><model name='m'><pose>5 0 0 0 0 0</pose>"
        "<link name='l'><pose>5 0 2 0 0 0</pose></link></model></state>"
    )
    assert found.models[0].pose.is_close(Pose(5))
    assert found.models[0].links[0].pose.is_close(Pose(z=2))
    assert len(found.states) == 1


def test_of_several_worlds_the_first_is_used():
    text = "<sdf version='1.6'><world name='a'/><world name='b'/></sdf>"
    with pytest.warns(FormatWarning, match="2 worlds"):
        assert formats.load_string(text).name == "a"
