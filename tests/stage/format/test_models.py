"""Stage's models: defaults, properties of each type, names and poses, old words."""

import math

import pytest
from stage_samples import read

from gazelle import FormatError
from gazelle.errors import FormatWarning
from gazelle.stage.description import StageController, StagePose
from gazelle.stage.description.devices import (
    StageActuator,
    StageBlinkenlight,
    StageBlobfinder,
    StageBumper,
    StageCamera,
    StageFiducial,
    StageGripper,
    StageLightIndicator,
    StagePosition,
    StageRanger,
    StageSensor,
)
from gazelle.stage.description.models import StageGui, StagePower, StageReturns


def one(folder, text):
    (model,) = read(folder, text).models
    return model


def test_a_world_has_stages_defaults(tmp_path):
    world = read(tmp_path, "resolution 0.02")
    assert world.name == "test"
    assert (world.interval_sim, world.resolution, world.quit_time) == (0.1, 0.02, 0.0)
    assert (world.speedup, world.paused, world.threads) == (1.0, False, 1)
    assert (world.show_clock, world.show_clock_interval) == (False, 100)
    assert world.confirm_on_quit
    assert world.window is None


def test_a_worlds_properties_are_read(tmp_path):
    text = """
    name "w" interval_sim 20 resolution 0.05 quit_time 60 speedup -1 paused 1 threads 4
    show_clock 1 show_clock_interval 10 confirm_on_quit 0
    window ( size [ 600 500 ] center [ 1 2 ] rotate [ 30 -10 ] scale 25 show_data 1
             follow_model "r0" pcam_loc [ 0 0 5 ] )
    """
    world = read(tmp_path, text)
    assert (world.name, world.interval_sim, world.quit_time) == ("w", 0.02, 60.0)
    assert (world.resolution, world.speedup, world.paused, world.threads) == (0.05, -1.0, True, 4)
    assert (world.show_clock, world.show_clock_interval) == (True, 10)
    assert not world.confirm_on_quit
    window = world.window
    assert (window.size, window.center, window.scale) == ((600.0, 500.0), (1.0, 2.0), 25.0)
    assert window.rotate == (30.0, -10.0)
    assert dict(window.settings) == {
        "show_data": 1.0,
        "follow_model": "r0",
        "pcam_loc": (0.0, 0.0, 5.0),
    }


def test_a_model_has_stages_defaults(tmp_path):
    model = one(tmp_path, "model ( )")
    assert (model.name, model.type, model.size) == ("model:1", "model", (0.4, 0.4, 1.0))
    assert (model.pose, model.origin) == (StagePose(), StagePose())
    assert model.color == (1.0, 0.0, 0.0, 1.0)
    assert (model.returns, model.gui, model.power) == (StageReturns(), StageGui(), StagePower())
    assert (model.update_interval, model.always_on, model.stack_children) == (0.1, False, True)
    assert (model.mass, model.map_resolution, model.device) == (0.0, 0.1, None)
    assert model.source.line == 1


def test_a_models_properties_are_read(tmp_path):
    text = """
    model ( name "m" pose [1 2 3 180] size [4 5 6] origin [.1 .2 .3 90] color "blue"
      obstacle_return 0 ranger_return -1 fiducial_return 7 fiducial_key 2 blob_return 0
      gripper_return 1 gui_nose 1 gui_grid 1 gui_outline 0 gui_move 0 trail_length 5
      trail_interval 2 say "hi" mass 23 friction .5 update_interval 50 alwayson 1
      stack_children 0 map_resolution .2 watts 3 give_watts 4 take_watts 5 kjoules 400
      joules_capacity 900 ctrl [ "wander" "lasernoise 0.1 2" ] debug 0 event_queue 1 )
    """
    model = one(tmp_path, text)
    assert model.pose == pytest.approx((1.0, 2.0, 3.0, math.pi))
    assert model.origin == pytest.approx((0.1, 0.2, 0.3, math.pi / 2))
    assert (model.size, model.color) == ((4.0, 5.0, 6.0), (0.0, 0.0, 1.0, 1.0))
    assert model.returns == StageReturns(False, -1.0, 7, 2, False, True)
    assert model.gui == StageGui(True, True, False, False, 5, 2, "hi")
    assert (model.mass, model.friction, model.update_interval) == (23.0, 0.5, 0.05)
    assert (model.always_on, model.stack_children, model.map_resolution) == (True, False, 0.2)
    assert model.power == StagePower(3.0, 4.0, 5.0, 400_000.0, 900.0)
    assert model.controllers == (
        StageController("wander"),
        StageController("lasernoise", "0.1 2"),
    )


@pytest.mark.parametrize(
    ("text", "device"),
    [
        ("position ( )", StagePosition()),
        ("ranger ( )", StageRanger()),
        ("ranger ( sensor ( ) )", StageRanger((StageSensor(),))),
        ("camera ( )", StageCamera()),
        ("blobfinder ( )", StageBlobfinder()),
        ("fiducial ( )", StageFiducial()),
        ("bumper ( )", StageBumper()),
        ("gripper ( )", StageGripper()),
        ("actuator ( )", StageActuator()),
        ("blinkenlight ( )", StageBlinkenlight()),
        ("lightindicator ( )", StageLightIndicator()),
    ],
)
def test_every_type_has_its_defaults(tmp_path, text, device):
    assert one(tmp_path, text).device == device


def test_default_figures_are_stages():
    assert StagePosition().velocity_bounds[3] == pytest.approx((-math.pi / 2, math.pi / 2))
    assert StagePosition().odom_error is None
    assert (StageSensor().range, StageSensor().fov, StageSensor().samples) == ((0.0, 5.0), 0.1, 1)
    assert StageCamera().fov == pytest.approx((math.radians(70), math.radians(40)))
    assert (StageBlobfinder().range, StageBlobfinder().image) == (12.0, (80, 60))
    assert (StageFiducial().range, StageFiducial().range_id) == ((0.0, 8.0), 5.0)


def test_a_position_is_read(tmp_path):
    text = """
    position ( drive "car" velocity [1 0 0 90] localization "odom"
      localization_origin [1 2 0 180] odom_error [0.1 0.2 0 3 99] wheelbase 0.4
      velocity_bounds [-1 2 -3 4 0 0 -90 90] acceleration_bounds [-1 1 0 0 0 0 -180 180] )
    """
    device = one(tmp_path, text).device
    assert (device.drive, device.localization, device.wheelbase) == ("car", "odom", 0.4)
    assert device.velocity == pytest.approx((1.0, 0.0, 0.0, math.pi / 2))
    assert device.localization_origin == pytest.approx((1.0, 2.0, 0.0, math.pi))
    assert device.odom_error == pytest.approx((0.1, 0.2, 0.0, math.radians(3)))
    assert device.velocity_bounds[:2] == ((-1.0, 2.0), (-3.0, 4.0))
    assert device.velocity_bounds[3] == pytest.approx((-math.pi / 2, math.pi / 2))
    assert device.acceleration_bounds[3] == pytest.approx((-math.pi, math.pi))


def test_a_rangers_sensors_are_read(tmp_path):
    text = """
    ranger ( size [.1 .2 .3]
      sensor ( pose [1 0 .5 90] size [0 0 .1] range [.1 8] fov 180 samples 361
               noise [.01 .02 .5] color_rgba [0 0 1 .2] )
      sensor ( fov 10 ) )
    """
    model = one(tmp_path, text)
    first, second = model.device.sensors
    assert first.pose == pytest.approx((1.0, 0.0, 0.5, math.pi / 2))
    assert (first.range, first.samples, first.color) == ((0.1, 8.0), 361, (0.0, 0.0, 1.0, 0.2))
    assert first.noise == pytest.approx((0.01, 0.02, math.radians(0.5)))
    assert first.fov == pytest.approx(math.pi)
    assert first.height == pytest.approx(0.55)
    assert second.fov == pytest.approx(math.radians(10))
    assert model.blocks == ()


def test_other_devices_are_read(tmp_path):
    text = """
    camera ( resolution [640 480] range [.1 9] fov [90 60] pantilt [10 -20] )
    blobfinder ( colors_count 2 colors ["red" "green"] image [20 10] range 6 fov 30 pan 5 )
    fiducial ( range_min 1 range_max 4 range_max_id 2 fov 90 ignore_zloc 1 )
    bumper ( bcount 2 bpose[0] [1 0 0 0] bpose[1] [-1 0 0 180] blength .3 blength[1] .4 )
    gripper ( paddle_size [.5 .2 .1] paddle_state ["closed" "up"] autosnatch 1 )
    actuator ( type "rotational" min_position -1 max_position 2 start_position .5 max_speed 3 )
    blinkenlight ( period 500 dutycycle .25 enabled 0 )
    """
    camera, blob, fiducial, bumper, gripper, actuator, light = [
        model.device for model in read(tmp_path, text).models
    ]
    assert (camera.resolution, camera.range) == ((640, 480), (0.1, 9.0))
    assert camera.pantilt == pytest.approx((math.radians(10), math.radians(-20)))
    assert blob.colors == ((1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0))
    assert (blob.image, blob.range) == ((20, 10), 6.0)
    assert (fiducial.range, fiducial.range_id, fiducial.ignore_height) == ((1.0, 4.0), 2.0, True)
    assert [length for _, length in bumper.strips] == [0.3, 0.4]
    assert bumper.strips[1][0] == pytest.approx((-1.0, 0.0, 0.0, math.pi))
    assert gripper == StageGripper((0.5, 0.2, 0.1), "closed", "up", True)
    assert actuator == StageActuator("rotational", (0.0, 0.0, 1.0), (-1.0, 2.0), 0.5, 3.0)
    assert light == StageBlinkenlight(0.5, 0.25, False)


def test_models_without_a_name_are_numbered_by_type_below_their_parent(tmp_path):
    text = """
    position ( name "r" ranger ( ) ranger ( ) camera ( name "eye" ) model ( name "/free" ) )
    position ( ranger ( ) ) model ( )
    """
    assert [placed.name for placed in read(tmp_path, text).walk()] == [
        "r",
        "r.ranger:0",
        "r.ranger:1",
        "r.eye",
        "free",
        "position:1",
        "position:1.ranger:0",
        "model:1",  # the ground is Stage's model:0
    ]


def test_children_stand_on_their_parents(tmp_path):
    text = """
    position ( pose [1 2 0.5 90] size [1 1 0.4] ranger ( pose [1 0 -0.1 10] )
               model ( stack_children 0 size [1 1 3] model ( ) ) )
    """
    robot, ranger, model, inner = read(tmp_path, text).walk()
    assert robot.pose.z == 0.5
    assert ranger.pose == pytest.approx((1.0, 3.0, 0.8, math.radians(100)))
    assert (model.pose.z, inner.pose.z) == pytest.approx((0.9, 0.9))


def test_the_body_stands_in_the_frame_of_its_origin(tmp_path):
    (placed,) = read(tmp_path, "model ( pose [1 0 0 90] origin [2 0 1 90] )").walk()
    assert placed.body_pose == pytest.approx((1.0, 2.0, 1.0, math.pi))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("modle ( )", "did you mean 'model'?"),
        ("define rover position ( ) rver ( )", "did you mean 'rover'?"),
        ("map ( )", "write a model with a bitmap"),
        ("wifi ( )", "no wifi"),
        ("position ( sensor ( ) )", "a sensor must stand in a ranger"),
        ("sensor ( )", "is not allowed here"),
        ('position ( drive "dif" )', "did you mean 'diff'?"),
        ('position ( localization "gsp" )', "did you mean 'gps'?"),
        ("position ( wheelbase 0 )", "greater than zero"),
        ("position ( velocity_bounds [1 -1 0 0 0 0 0 0] )", "greater than the greatest"),
        ("model ( size [1 -1 1] )", "must not be negative"),
        ("ranger ( sensor ( range [5 1] ) )", "[ nearest farthest ]"),
        ("ranger ( sensor ( samples 0 ) )", "at least 1"),
        ("camera ( resolution [0 10] )", "1 to 10000 pixels"),
        ('gripper ( paddle_state ["ajar" "up"] )', "paddle_state"),
        ("interval_sim 0", "a time in ms"),
        ("resolution 0", "a length in m"),
        ("model ( ctrl 3 )", "must name a controller"),
        ('model ( name "a::b" )', "not a name"),
    ],
)
def test_what_cannot_be_is_refused_with_a_hint(tmp_path, text, said):
    with pytest.raises(FormatError) as caught:
        read(tmp_path, text)
    assert said in str(caught.value)
    assert caught.value.line == 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("model ( colour 3 )", "'colour' is not a property of a model, and ignored; did you mean"),
        ("ranger ( sensor ( fow 3 ) )", "'fow' is not a property of a sensor"),
        ("resolutoin 3", "did you mean 'resolution'?"),
        ("interval_real 100", "'interval_real' is not a property in Stage 4"),
        ("model ( laser_return 1 )", "'laser_return' is of Stage 3"),
        ("ranger ( sensor ( range_max 6.5 ) )", "write range [ min max ]"),
        ('model ( color "blurple" )', "'blurple' is not an X11 color"),
        ('position ( ctrl "fasr 3" )', "the controller 'fasr' is a program for Stage itself"),
        ("model ( size3 [1 2 3] )", "it is read as 'size'"),
        ("laser ( range_max 4 samples 90 )", "read as a ranger"),
        ("position ( odom [0 0 0 0] )", "'odom' is no longer used"),
    ],
)
def test_what_is_not_done_as_written_is_said_once(tmp_path, text, said):
    with pytest.warns(FormatWarning) as caught:
        read(tmp_path, f"define unused model ( nonsense 1 ) model ( )\n{text}")
    (message,) = [str(each.message) for each in caught]
    assert said in message
    assert f"{tmp_path / 'test.world'}:2:" in message


def test_a_remark_about_a_macro_is_made_once_for_all_its_instances(tmp_path):
    with pytest.warns(FormatWarning) as caught:
        read(tmp_path, "define a model ( nonsense 1 )\n" + "a ( mass 3 )\n" * 10)
    assert len(caught) == 1


def test_a_sensors_old_range_is_not_used_as_in_stage_4(tmp_path):
    with pytest.warns(FormatWarning):
        model = one(tmp_path, "ranger ( sensor ( range_max 6.5 ) )")
    assert model.device.sensors[0].range == (0.0, 5.0)


def test_old_sizes_and_lasers_are_understood(tmp_path):
    with pytest.warns(FormatWarning):
        box, laser = read(
            tmp_path, "model ( size3 [1 2 3] origin3 [1 0 90] ) laser ( range_max 4 samples 90 )"
        ).models
    assert box.size == (1.0, 2.0, 3.0)
    assert box.origin == pytest.approx((1.0, 0.0, 0.0, math.pi / 2))
    assert (laser.type, laser.name) == ("ranger", "ranger:0")
    assert laser.device.sensors[0] == StageSensor(range=(0.0, 4.0), fov=math.pi, samples=90)


@pytest.mark.parametrize(
    ("name", "color"),
    [
        ("gray30", (0.302, 0.302, 0.302)),
        ("green", (0.0, 1.0, 0.0)),
        ("DarkRed", (0.545, 0.0, 0.0)),
        ("light blue", (0.678, 0.847, 0.902)),
        ("red3", (0.804, 0.0, 0.0)),
    ],
)
def test_colours_are_x11s(tmp_path, name, color):
    assert one(tmp_path, f'model ( color "{name}" )').color[:3] == pytest.approx(color, abs=0.001)


@pytest.mark.parametrize(
    "text",
    [
        'model ( color "red" color_rgba [0 1 0 1] )',
        'model ( color_rgba [0 1 0 1] color "red" )',
        'define x model ( color "red" ) x ( color_rgba [0 1 0 1] )',
        'define x model ( color_rgba [0 1 0 1] ) x ( color "red" )',
    ],
)
def test_a_colours_name_counts_more_than_its_numbers(tmp_path, text):
    assert one(tmp_path, text).color == (1.0, 0.0, 0.0, 1.0)


def test_the_range_of_a_blobfinder_has_no_unit(tmp_path):
    text = 'unit_length "cm" blobfinder ( range 3 pose [100 0 0 0] )'
    model = one(tmp_path, text)
    assert (model.device.range, model.pose.x) == (3.0, 1.0)


def test_a_colour_may_be_random(tmp_path):
    assert one(tmp_path, 'model ( color "random" )').color == "random"
