"""Elements that stand for others: old spellings, merges, actors, populations, saved changes."""

import math
import re
import time

import libsdformat
import numpy as np
import pytest
from xml_samples import link, sdf, world

from gazelle import FormatError, Pose, formats
from gazelle.description import Box, Cylinder, Mesh
from gazelle.errors import FormatWarning

OLD = """<gazebo version="1.0"><world name="w">
<scene><ambient rgba="0.5 0.5 0.5 1.0"/><background rgba="0.1 0.2 0.3 1">
<sky material="Gazebo/CloudySky"/></background><shadows enabled="false"/></scene>
<physics type="ode"><gravity xyz="0 0 -1"/><ode>
<solver type="quick" dt="0.002" iters="30" sor="1.1"/>
<constraints cfm="0.5" erp="0.3" contact_max_correcting_vel="9" contact_surface_layer="0.01"/>
</ode></physics>
<model name="m" static="false"><origin pose="0 0 2.1 0.5 0 0"/>
<link name="l" self_collide="true" gravity="false">
<origin pose="1 0 0 0 0 0"/>
<inertial mass="10"><origin pose="0 0 -0.5 0 0 0"/><damping linear="0.1" angular="0.2"/>
<inertia ixx="2" ixy="0" ixz="0" iyy="3" iyz="0" izz="4"/></inertial>
<visual name="v" cast_shadows="false"><origin pose="0 0 1 0 0 0"/>
<geometry><cylinder radius="0.1" length="1"/></geometry><material script="Gazebo/Green"/></visual>
<collision name="c" laser_retro="7"><geometry><box size="1 2 3"/></geometry>
<surface><friction><ode mu="0.5" mu2="0.2" fdir1="1 0 0"/></friction>
<contact><ode kp="1e6" min_depth="0.001"/></contact></surface></collision>
</link>
<joint name="j" type="revolute"><parent link="world"/><child link="l"/>
<origin pose="0 0 0.1 0 0 0"/>
<axis xyz="1 0 0"><limit lower="-1" upper="1"/><dynamics damping="0.3"/></axis></joint>
</model></world></gazebo>"""


def test_sdf_1_0_is_read_whole():
    found = formats.load_string(OLD)
    assert found.gravity == (0, 0, -1)
    assert found.scene.background == (0.1, 0.2, 0.3, 1)
    assert (found.scene.shadows, found.scene.sky) == (False, True)
    physics = found.profile
    assert (physics.max_step_size, physics.ode.iters, physics.ode.erp) == (0.002, 30, 0.3)
    (robot,) = found.models
    (body,) = robot.links
    assert robot.pose == Pose(z=2.1, roll=0.5)
    assert body.pose == Pose(x=1)
    assert (body.gravity, body.self_collide) == (False, True)
    assert (body.velocity_decay_linear, body.velocity_decay_angular) == (0.1, 0.2)
    assert (body.inertial.mass, body.inertial.pose) == (10, Pose(z=-0.5))
    assert (body.inertial.inertia.ixx, body.inertial.inertia.izz) == (2, 4)
    assert body.visuals[0].geometry == Cylinder(0.1, 1)
    assert body.visuals[0].material.diffuse == (0, 1, 0, 1)
    assert not body.visuals[0].cast_shadows
    assert body.collisions[0].geometry == Box((1, 2, 3))
    assert body.collisions[0].laser_retro == 7
    assert body.collisions[0].surface.friction.mu2 == 0.2
    assert body.collisions[0].surface.contact.kp == 1e6
    (joint,) = robot.joints
    assert (joint.parent, joint.pose) == ("world", Pose(z=0.1))
    assert (joint.axes[0].lower, joint.axes[0].damping) == (-1, 0.3)


def test_sdf_1_3_moves_the_step_out_of_the_solver():
    text = "<physics type='bullet'><bullet><dt>0.01</dt></bullet><update_rate>7</update_rate>"
    found = world(f"{text}</physics>", "1.3").profile
    assert (found.max_step_size, found.real_time_update_rate) == (0.01, 7)


def test_names_that_changed_between_old_versions():
    text = (
        "<scene><fog rgba='1 0 0 1' type='linear' start='2' end='9'/></scene>"
        "<model name='m'><link name='l'><damping linear='0.3' angular='0.4'/>"
        "<collision name='c'><geometry><heightmap filename='none.png' size='4 4 1'"
        " origin='1 2 3'/></geometry></collision></link></model>"
    )
    with pytest.warns(FormatWarning, match=r"none\.png"):
        body = world(text, "1.2").models[0].links[0]
    assert (body.velocity_decay_linear, body.velocity_decay_angular) == (0.3, 0.4)
    ground = body.collisions[0].geometry
    assert (ground.uri, ground.size, ground.position) == ("none.png", (4, 4, 1), (1, 2, 3))


def test_errors_in_old_files_name_the_line():
    with pytest.raises(FormatError) as caught:
        formats.load_string(OLD.replace('mass="10"', 'mass="ten"'), name="old.world")
    assert (caught.value.file, caught.value.line) == ("old.world", 11)


ARM = """<model name='arm'><pose>9 9 9 0 0 0</pose>
<link name='upper'><pose>1 0 0 0 0 0.3</pose><inertial><mass>2</mass></inertial>
<visual name='v'><pose {frame}='__model__'/></visual></link>
<link name='lower'><pose>1 0 1 0 0.2 0</pose><collision name='c'><geometry>
<mesh><uri>meshes/m.stl</uri></mesh></geometry></collision></link>
<joint name='elbow' type='revolute'><parent>upper</parent><child>lower</child>
<pose>0 0 .1 0.5 0 0</pose><axis><xyz>1 0 0</xyz>{axis}</axis></joint>
<model name='tool'><pose>0 0 3 0 0 0</pose><link name='tip'/></model>
<plugin name='p' filename='libp.so'/></model>"""
ROBOT = """<model name='robot'><link name='base'><pose>0 1 0 0 0 0</pose></link>
<include merge='true'><uri>model://arm</uri><name>left</name>
<pose relative_to='base'>0 0 2 0 0 1.5</pose><plugin name='q' filename='libq.so'/></include>
<joint name='shoulder' type='fixed'><parent>base</parent><child>upper</child></joint></model>"""


def arm(folder, version="1.9"):
    """Return a folder of models that holds the arm."""
    new = version not in {"1.4", "1.6"}
    here = folder / "arm"
    (here / "meshes").mkdir(parents=True)
    (here / "meshes/m.stl").write_bytes(b"solid")
    (here / "model.config").write_text("<model><sdf version='1.6'>model.sdf</sdf></model>")
    axis = "" if new else "<use_parent_model_frame>1</use_parent_model_frame>"
    text = ARM.format(frame="relative_to" if new else "frame", axis=axis)
    if new:
        text = text.replace("<xyz>", "<xyz expressed_in='__model__'>")
    (here / "model.sdf").write_text(sdf(text, version))
    return folder


@pytest.mark.parametrize("version", ["1.4", "1.6", "1.9"])
def test_merged_parts_stand_where_the_include_says(tmp_path, version):
    text = sdf(ROBOT, "1.9")
    robot = formats.load_model_string(text, paths=[arm(tmp_path, version)])
    assert [part.name for part in robot.links] == ["base", "upper", "lower"]
    assert [part.name for part in robot.models] == ["tool"]
    assert [part.name for part in robot.plugins] == ["p", "q"]
    assert [part.name for part in robot.joints] == ["elbow", "shoulder"]
    stand = Pose(0, 1, 2, yaw=1.5)
    assert link(robot, "upper").pose.is_close(stand * Pose(1, yaw=0.3))
    assert robot.models[0].pose.is_close(stand * Pose(z=3))
    frame = next(frame for frame in robot.frames if frame.name == "_merged__left__model__")
    assert frame.attached_to == "upper"
    assert (link(robot, "upper").pose * frame.pose).is_close(stand)
    if version != "1.4":  # whose poses have no frames
        assert (link(robot, "upper").pose * link(robot, "upper").visuals[0].pose).is_close(stand)
    axis = link(robot, "lower").pose * robot.joints[0].pose
    assert axis.rotate(robot.joints[0].axes[0].xyz) == pytest.approx(stand.rotate((1, 0, 0)))
    mesh = link(robot, "lower").collisions[0].geometry
    assert mesh.path == tmp_path / "arm/meshes/m.stl"


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_merging_is_what_libsdformat_does(tmp_path, monkeypatch):
    monkeypatch.setenv("SDF_PATH", str(arm(tmp_path)))
    file = tmp_path / "robot.sdf"
    file.write_text(sdf(ROBOT, "1.9"))
    theirs = formats.load_model_string(libsdformat.printed(file), paths=[tmp_path])
    ours = formats.load_model(file)
    for one, other in zip(ours.links, theirs.links, strict=True):
        assert one.name == other.name
        assert one.pose.is_close(other.pose)
    for one, other in zip(ours.joints, theirs.joints, strict=True):
        assert (one.name, one.parent, one.child) == (other.name, other.parent, other.child)
        for mine, its in zip(one.axes, other.axes, strict=True):
            assert mine.xyz == pytest.approx(its.xyz, abs=1e-12)
    names = [frame.name for frame in ours.frames]
    assert names == [frame.name for frame in theirs.frames]
    for one, other in zip(ours.frames, theirs.frames, strict=True):
        assert one.pose.is_close(other.pose)


def test_a_world_merges_models_but_no_links(tmp_path):
    text = sdf(
        "<world name='w'><include merge='true'><uri>model://arm</uri><pose>1 2 3 0 0 0</pose>"
        "</include></world>",
        "1.10",
    )
    arm(tmp_path)
    with pytest.raises(FormatError, match="cannot merge a model with a <link>"):
        formats.load_string(text, paths=[tmp_path])
    file = tmp_path / "arm/model.sdf"
    two = "<model name='{0}'><pose>0 0 1 0 0 0</pose><link name='l'/></model>"
    both = two.format("a") + two.format("b")
    file.write_text(sdf(f"<model name='arm'>{both}</model>", "1.10"))
    found = formats.load_string(text, paths=[tmp_path])
    assert [m.name for m in found.models] == ["a", "b"]
    assert all(m.pose.is_close(Pose(1, 2, 4)) for m in found.models)


def test_a_merge_that_is_not_found_is_left_out(tmp_path):
    with pytest.warns(FormatWarning, match="model://arm|is of a model that was not found"):
        found = formats.load_model_string(sdf(ROBOT, "1.9"))
    assert [part.name for part in found.links] == ["base"]


ACTOR = """<actor name='walker'><pose>5 0 0 0 0 0</pose>{body}<script><loop>{loop}</loop>
<delay_start>1</delay_start><auto_start>{start}</auto_start><trajectory id='0' type='t'>
<waypoint><time>2</time><pose>1 0 0 0 0 1.5</pose></waypoint>
<waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>
<waypoint><time>2</time><pose>9 9 9 0 0 0</pose></waypoint></trajectory></script></actor>"""


def actor(body="", loop="true", start="true"):
    return world(ACTOR.format(body=body, loop=loop, start=start)).models[0]


def moments(found):
    """Return time, x and yaw of each waypoint of an actor."""
    return [
        (float(path.attributes["start"]) + point.get("time", 0.0), pose[0], pose[5])
        for path in found.plugins[0].parameters.find_all("trajectory")
        for point in path.find_all("waypoint")
        for pose in [point.numbers("pose", (0.0,) * 6)]
    ]


def test_an_actor_is_a_static_model_that_follows_its_script():
    found = actor("<link name='b'/>")
    assert (found.name, found.static, found.pose) == ("walker", True, Pose(x=5))
    (plugin,) = found.plugins
    assert plugin.filename == "libgazelle_scripted_motion.so"
    assert moments(found) == [(1.0, 0.0, 0.0), (3.0, 9.0, 0.0)]  # the last one at 2 s holds
    assert plugin.parameters.get("loop", False) is True
    assert actor(loop="false").plugins[0].parameters.get("loop", True) is False


def test_trajectories_of_an_actor_follow_each_other_by_their_ids():
    leg = "<trajectory id='{}' type='t'>{}</trajectory>"
    point = "<waypoint><time>{}</time><pose>{} 0 0 0 0 0.5</pose></waypoint>"
    late = leg.format(2, point.format(0.5, 7) + point.format(4, 8))
    early = leg.format(1, point.format(0, 5) + point.format(3, 6))
    found = world(f"<actor name='a'><script>{late}{early}</script></actor>").models[0]
    expected = [(0, 5, 0.5), (3, 6, 0.5), (3.5, 7, 0.5), (7, 8, 0.5)]
    np.testing.assert_allclose(moments(found), expected)


def test_a_waypoint_before_the_start_is_an_error():
    point = "<waypoint><time>-1</time><pose>0 0 0 0 0 0</pose></waypoint>"
    script = f"<script><trajectory id='0' type='t'>{point}</trajectory></script>"
    with pytest.raises(FormatError, match="must not be negative"):
        world(f"<actor name='a'>{script}</actor>")


def test_lidars_see_an_actor_that_pushes_nothing():
    shape = "<geometry><sphere><radius>0.3</radius></sphere></geometry>"
    visual = f"<visual name='v'><pose>0 0 1 0 0 0</pose>{shape}</visual>"
    (ghost,) = actor(f"<link name='b'>{visual}</link>").links[0].collisions
    assert (ghost.name, ghost.pose.z, ghost.geometry.radius) == ("v", 1.0, 0.3)
    assert ghost.surface.contact.collide_without_contact
    own = actor(f"<link name='b'>{visual}<collision name='c'>{shape}</collision></link>")
    (solid,) = own.links[0].collisions
    assert not solid.surface.contact.collide_without_contact
    skin = "<skin><filename>nobody.dae</filename><scale>0.5</scale></skin>"
    with pytest.warns(FormatWarning, match="nobody"):
        (person,) = actor(skin).links[0].collisions
    assert person.pose.z == pytest.approx(0.45)
    assert person.geometry.length == pytest.approx(0.9)


def test_an_actor_that_does_not_start_stands():
    assert actor(start="false").plugins == ()


def test_an_actor_shows_its_skin(tmp_path):
    (tmp_path / "walk.dae").write_text("")
    skin = f"<skin><filename>{tmp_path}/walk.dae</filename><scale>2</scale></skin>"
    text = sdf(f"<world name='w'>{ACTOR.format(body=skin, loop=1, start=1)}</world>")
    found = formats.load_string(text, paths=[tmp_path]).models[0]
    (visual,) = found.links[0].visuals
    assert isinstance(visual.geometry, Mesh)
    assert visual.geometry.path == tmp_path / "walk.dae"
    assert visual.geometry.scale == (2, 2, 2)
    (person,) = found.links[0].collisions
    assert person.geometry.length == pytest.approx(3.6)


POPULATION = """<population name='p'><model name='can'><link name='l'/></model>
<pose>1 2 3 0 0 {yaw}</pose>{region}<model_count>{count}</model_count>
<distribution><type>{kind}</type>{rest}</distribution></population>"""
BOX = "<box><size>4 2 0.5</size></box>"
TUBE = "<cylinder><radius>1</radius><length>2</length></cylinder>"


def spread(kind, count=12, region=BOX, yaw=0, rest=""):
    found = world(
        POPULATION.format(kind=kind, count=count, region=region, yaw=yaw, rest=rest)
    ).models
    return found, np.array([m.pose.position for m in found]) - (1, 2, 3)


@pytest.mark.parametrize("kind", ["random", "uniform"])
@pytest.mark.parametrize("region", [BOX, TUBE])
def test_a_population_stays_in_its_region(kind, region):
    models, places = spread(kind, region=region)
    assert [m.name for m in models] == [f"can_clone_{i}" for i in range(12)]
    if region == BOX:
        assert (np.abs(places) <= (2, 1, 0.25)).all()
    else:
        assert np.hypot(places[:, 0], places[:, 1]).max() <= 1
        assert 0 <= places[:, 2].min() < places[:, 2].max() <= 2  # it stands on the pose
    np.testing.assert_array_equal(places, spread(kind, region=region)[1])  # no chance
    gaps = np.linalg.norm(places[:, None] - places[None], axis=2)[~np.eye(12, dtype=bool)]
    assert gaps.min() > (0.2 if kind == "uniform" else 0)


def test_grids_and_rows():
    rest = "<rows>2</rows><cols>3</cols><step>0.5 0.25 0</step>"
    models, places = spread("grid", rest=rest)
    expected = [(x, y, 0) for y in (-0.125, 0.125) for x in (-0.5, 0, 0.5)]
    np.testing.assert_allclose(places, expected)
    assert models[0].links[0].name == "l"
    _, places = spread("linear-x", count=4)
    np.testing.assert_allclose(places, [(x, 0, 0) for x in (-2, -1, 0, 1)])
    _, places = spread("linear-z", count=2)
    np.testing.assert_allclose(places, [(0, 0, -0.25), (0, 0, 0)])


def test_a_turned_population_turns_about_its_corner_and_its_models_stand_upright():
    turned, places = spread("linear-y", count=2, yaw=math.pi / 2)
    np.testing.assert_allclose(places, [(-2, 1, 0), (-3, 1, 0)], atol=1e-12)
    assert turned[0].pose.quaternion == (0, 0, 0, 1)
    upright, places = spread("random", count=50, yaw=math.pi / 2)
    low, high = (-2 - 2, -1, -0.25), (-2, -1 + 4, 0.25)
    assert (places >= low).all()
    assert (places <= high).all()
    assert {m.pose.quaternion for m in upright} == {(0, 0, 0, 1)}


def test_a_populations_pose_takes_the_place_of_its_models():
    text = POPULATION.format(kind="grid", count=1, region="", yaw=0, rest="")
    (found,) = world(text.replace("<link", "<pose>7 7 7 1 1 1</pose><link")).models
    assert found.pose == Pose(1, 2, 3)


def test_five_hundred_models_are_spread_in_less_than_a_second():
    start = time.process_time()
    spread("uniform", count=500)
    assert time.process_time() - start < 1.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"kind": "rnadom"}, "did you mean 'random'"),
        ({"kind": "random", "region": ""}, "needs a <box> or a <cylinder>"),
        ({"kind": "linear-x", "region": TUBE}, "'linear-x' needs a <box>"),
        ({"kind": "random", "region": "<box><size>1 0 1</size></box>"}, "greater than zero"),
        ({"kind": "random", "region": TUBE.replace(">1<", ">-1<")}, "<radius> must be greater"),
        ({"kind": "random", "count": -3}, "<model_count> must be at least 1, found -3"),
        ({"kind": "grid", "rest": "<rows>0</rows>"}, "<rows> must be at least 1, found 0"),
        ({"kind": "grid", "rest": "<cols>-2</cols>"}, "<cols> must be at least 1, found -2"),
    ],
)
def test_a_population_that_makes_no_sense_is_left_out_as_in_gazebo(options, message):
    text = POPULATION.format(**{"region": BOX, "count": 2, "yaw": 0, "rest": ""} | options)
    with pytest.warns(FormatWarning) as said:
        found = world(f"<model name='kept'><link name='l'/></model>\n{text}")
    assert [model.name for model in found.models] == ["kept"]
    (warning,) = said
    assert re.search(message, str(warning.message))
    assert "the population is left out" in str(warning.message)
    assert re.match(r"test\.sdf:[567]: ", str(warning.message))


def test_a_population_without_a_model_is_left_out():
    with pytest.warns(FormatWarning, match="needs a <model>: the population is left out"):
        assert world(f"<population name='p'>{BOX}</population>").models == ()


@pytest.mark.parametrize(
    "options",
    [
        {"kind": "random", "count": 10**9},
        {"kind": "grid", "rest": "<rows>99999</rows><cols>99999</cols>"},
    ],
)
def test_a_population_too_large_for_a_world_is_refused(options):
    with pytest.raises(FormatError, match="up to 10000 models"):
        spread(**options)


def test_saved_changes_are_made():
    found = world(
        "<model name='a'><link name='l'/></model><model name='b'><link name='l'/></model>"
        "<light name='sun' type='point'/><state world_name='w'><insertions>"
        "<model name='c'><link name='l'/></model><model name='a'><link name='x'/></model>"
        "<light name='lamp' type='point'/></insertions>"
        "<deletions><name>b</name><name>sun</name></deletions>"
        "<model name='c'><pose>1 2 3 0 0 0</pose></model></state>"
    )
    assert [m.name for m in found.models] == ["a", "c"]
    assert found.models[0].links[0].name == "l"
    assert found.models[1].pose == Pose(1, 2, 3)
    assert [light.name for light in found.lights] == ["lamp"]
    assert [child.tag for child in found.states[0].children] == ["model"]


def test_bullets_terms_serve_where_odes_are_missing():
    text = (
        "<physics type='bullet'><bullet><solver><iters>70</iters><sor>1.5</sor></solver>"
        "<constraints><erp>0.4</erp></constraints></bullet></physics>"
    )
    found = world(text).profile
    assert (found.type, found.ode.iters, found.ode.sor, found.ode.erp) == ("bullet", 70, 1.5, 0.4)
    assert [extra.tag for extra in found.extras] == ["bullet"]
