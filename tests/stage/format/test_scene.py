"""Stage worlds through every door: load, check, convert, the 3-D engine."""

import math

import numpy as np
import pytest
from stage_samples import SQUARE, draw, write

import gazelle
from gazelle import formats
from gazelle.cli.main import main
from gazelle.description import Box, Polyline
from gazelle.errors import FormatWarning

WORLD = """
define floorplan model ( color "gray30" boundary 1 )
define scanner ranger ( sensor ( range [0 8] fov 180 samples 181 ) )
define robot position ( size [0.4 0.4 0.3] scanner ( pose [0.1 0 -0.1 0] ) )
floorplan ( name "plan" bitmap "map.png" size [10 10 1] )
robot ( name "r0" pose [1 2 0 90] )
robot ( name "r1" pose [-1 2 0 0] )
"""


@pytest.fixture
def file(tmp_path):
    draw(tmp_path, ["####", "#..#", "#.##", "####"])
    return write(tmp_path, WORLD)


def test_load_tells_stage_from_sdf_by_content(tmp_path):
    sdf = '<sdf version="1.6"><world name="w"/></sdf>'
    assert gazelle.load(write(tmp_path, sdf)).content is None
    assert gazelle.load(write(tmp_path, "resolution 0.5")).content.resolution == 0.5


@pytest.mark.parametrize("text", ["# only words\nresolution 0.5", 'include"a.inc"', "model()"])
def test_the_suffix_does_not_matter_where_the_text_is_stages(tmp_path, text):
    write(tmp_path, "", "a.inc")
    assert gazelle.load(write(tmp_path, text, "any.txt")).content is not None


@pytest.mark.parametrize("text", ["just some words", "solid cube\nfacet", "%YAML", "{}"])
def test_other_texts_are_not_taken_for_stage(tmp_path, text):
    with pytest.raises(gazelle.FormatError, match="this is not XML"):
        gazelle.load(write(tmp_path, text, "any.txt"))


def test_text_can_be_loaded_too():
    world = formats.load_string("model ( name 'a' )".replace("'", '"'))
    assert [model.name for model in world.models] == ["ground_plane", "a"]


def test_a_world_holds_models_and_what_stage_said(file):
    world = gazelle.load(file)
    assert [model.name for model in world.models] == ["ground_plane", "plan", "r0", "r1"]
    assert [model.static for model in world.models] == [True, True, False, False]
    assert [robot.name for robot in world.content.robots] == ["r0", "r1"]
    assert world.models[2].pose.yaw == pytest.approx(math.pi / 2)


def test_robots_of_one_macro_share_their_bodies(file):
    _, _, first, second = gazelle.load(file).models
    assert first.links[0].collisions is second.links[0].collisions
    assert [sensor.name for sensor in second.links[0].sensors] == ["ranger:0"]


def test_robots_drive_and_see_under_stage_ros_names(file):
    _, _, _, robot = gazelle.load(file).models
    (drive,), (laser,) = robot.plugins, robot.links[0].sensors[0].plugins
    assert drive.filename == "libgazebo_ros_planar_move.so"
    assert drive.parameters.get("robotNamespace", "") == "robot_1"
    assert drive.parameters.get("odometryFrame", "") == "robot_1/odom"
    assert laser.parameters.get("topicName", "") == "base_scan"
    assert laser.parameters.get("frameName", "") == "robot_1/base_laser_link"


def test_several_lidars_are_numbered_and_the_first_sensor_of_each_is_published(tmp_path):
    text = "position ( ranger ( sensor ( ) sensor ( ) ) ranger ( sensor ( ) ) model ( ranger ( sensor ( ) ) ) )"
    (link,) = gazelle.load(write(tmp_path, text)).models[1].links
    topics = [
        plugin.parameters.get("topicName", "")
        for sensor in link.sensors
        for plugin in sensor.plugins
    ]
    assert topics == ["base_scan_0", "base_scan_1"]
    assert len(link.sensors) == 4


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_robots_drive_in_any_engine(file, engine):
    with gazelle.Simulation(gazelle.load(file), engine=engine) as sim:
        robot = sim.robots["r1"]
        robot.inputs["cmd_vel"].send(linear=0.5)
        sim.run(seconds=0.2)
        assert robot.pose.x == pytest.approx(-0.9, abs=0.02)
        assert robot.outputs["base_scan"].last.ranges.shape[-1] == 181


def test_names_are_made_unique(tmp_path):
    world = gazelle.load(write(tmp_path, 'model ( name "a" ) model ( name "a" )'))
    assert [model.name for model in world.models] == ["ground_plane", "a", "a_1"]


def test_walls_of_a_bitmap_become_boxes_that_cover_it(file):
    plan = gazelle.load(file).models[1].links[0]
    boxes = [c for c in plan.collisions if min(c.geometry.size[:2]) > 0.1]
    area = sum(c.geometry.size[0] * c.geometry.size[1] for c in boxes)
    assert area == pytest.approx(13 * 2.5 * 2.5)
    for corner in (-1.2, -1.2), (-1.2, 1.2), (1.2, 1.2):
        covered = any(
            abs(corner[0] - c.pose.x) < c.geometry.size[0] / 2
            and abs(corner[1] - c.pose.y) < c.geometry.size[1] / 2
            for c in boxes
        )
        assert not covered
    assert any(abs(1.2 - c.pose.x) < c.geometry.size[0] / 2 for c in boxes)


def test_a_lidar_is_where_stage_has_it(file):
    (sensor,) = gazelle.load(file).models[2].links[0].sensors
    assert sensor.pose.x == pytest.approx(0.1)
    assert sensor.pose.z == pytest.approx(0.3 - 0.1 + 0.01)
    assert sensor.lidar.horizontal.samples == 181
    assert sensor.lidar.horizontal.max_angle == pytest.approx(math.pi / 2)
    assert sensor.update_rate == pytest.approx(10.0)


def test_a_lidar_inside_of_its_robot_sees_from_the_robots_edge_on(file):
    (sensor,) = gazelle.load(file).models[2].links[0].sensors
    assert sensor.lidar.range_min == pytest.approx(math.hypot(0.3, 0.2))
    assert sensor.lidar.range_max == 8.0


def test_prisms_that_are_no_boxes_are_kept_as_outlines(tmp_path):
    triangle = "points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1] z [1 2]"
    world = gazelle.load(
        write(tmp_path, f"model ( size [1 1 2] block ( {triangle} ) block ( {SQUARE} ) )")
    )
    outline, box = world.models[1].links[0].collisions
    assert isinstance(outline.geometry, Polyline)
    assert (outline.pose.z, outline.geometry.height) == (1.0, 1.0)
    assert isinstance(box.geometry, Box)


def test_what_is_no_obstacle_shows_but_does_not_collide(tmp_path):
    link = gazelle.load(write(tmp_path, "model ( obstacle_return 0 )")).models[1].links[0]
    assert (len(link.collisions), len(link.visuals)) == (0, 1)


def test_random_colours_differ(tmp_path):
    text = 'define r position ( color "random" ) ' + "r ( ) " * 4
    models = gazelle.load(write(tmp_path, text)).models[1:]
    assert len({model.links[0].visuals[0].material for model in models}) == 4


def test_a_bitmap_with_too_many_boxes_is_drawn_coarser(tmp_path, monkeypatch):
    monkeypatch.setattr("gazelle.stage.format.scene.MAX_BOXES", 3)
    draw(tmp_path, ["#.#.#.#."] * 8)
    with pytest.warns(FormatWarning, match="drawn 2 times coarser"):
        world = gazelle.load(write(tmp_path, 'model ( bitmap "map.png" size [7 8 1] )'))
    (box,) = world.models[1].links[0].collisions
    assert box.geometry.size[:2] == pytest.approx((7.0, 8.0))


@pytest.mark.parametrize(
    ("text", "step", "rate"),
    [
        ("", 0.01, 100.0),
        ("interval_sim 5", 0.005, 200.0),
        ("speedup 4", 0.01, 400.0),
        ("speedup -1", 0.01, 0.0),
    ],
)
def test_other_engines_keep_the_pace_with_steps_of_their_own(tmp_path, text, step, rate):
    physics = gazelle.load(write(tmp_path, f"{text} model ( )")).profile
    assert (physics.max_step_size, physics.real_time_update_rate) == (step, pytest.approx(rate))


def test_check_lists_problems_of_stage_files(file, capsys):
    assert main(["check", str(file)]) == 0
    assert "ok" in capsys.readouterr().out
    file.write_text("\nmodel ( hue 3 )\nmodell ( )")
    assert main(["check", str(file)]) == 1
    assert f"error: {file}:3:" in capsys.readouterr().out


def test_a_stage_file_converts_to_sdf(file, tmp_path, capsys):
    target = tmp_path / "out.sdf"
    assert main(["convert", str(file), str(target)]) == 0
    world = gazelle.load(target)
    assert [model.name for model in world.models] == ["ground_plane", "plan", "r0", "r1"]
    assert world.models[1] == gazelle.load(file).models[1]


def test_stage_files_are_not_written(file, tmp_path, capsys):
    assert main(["convert", str(file), str(tmp_path / "out.inc")]) == 1
    assert "Stage can be read, but not written" in capsys.readouterr().err


def test_the_engine_in_space_runs_a_stage_world(file):
    with gazelle.Simulation(gazelle.load(file)) as sim:
        sim.run(seconds=0.2)
        for name, x in (("r0", 1.0), ("r1", -1.0)):
            assert np.allclose(sim.robots[name].pose.position, (x, 2.0, 0.0), atol=2e-3)
