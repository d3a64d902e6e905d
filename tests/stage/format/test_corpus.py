"""Every Stage file of the corpus loads, or is refused for a reason that a human agrees with."""

import time

import pytest

from gazelle import formats
from gazelle.stage.format import is_stage

pytestmark = pytest.mark.corpus

RL = "Acmece__rl-collision-avoidance/stage_ros-add_pose_and_crash/world/"
ROS = "ros-simulation__stage_ros/world/"
TEB = "rst-tu-dortmund__teb_local_planner_tutorials/stage/"
TURTLE = "turtlebot__turtlebot_simulator/turtlebot_stage/maps/stage/"

# of each file: models, robots, rays of all robots together
LOADED = {
    RL + "simple.world": (25, 24, 24 * 512),
    ROS + "erratic-inc.world": (0, 0, 0),
    ROS + "intense.world": (8, 1, 1081),
    ROS + "willow-erratic.world": (3, 1, 1081),
    ROS + "willow-four-erratics-multisensor.world": (6, 4, 8 * 1081),
    ROS + "willow-four-erratics.world": (6, 4, 4 * 1081),
    "ros-planning__navigation_tutorials/roomba_stage/roomba_lse_arena.world": (2, 1, 1081),
    TEB + "corridor.world": (15, 14, 1920),
    TEB + "empty_box.world": (3, 2, 1920),
    TEB + "maze_carlike.world": (2, 1, 640),
    TEB + "maze_diff_drive.world": (2, 1, 640),
    TEB + "maze_omnidir.world": (2, 1, 640),
    TEB + "robots/carlike_robot.inc": (0, 0, 0),
    TEB + "robots/diff_drive_robot.inc": (0, 0, 0),
    TEB + "robots/diff_drive_robot_gps.inc": (0, 0, 0),
    TEB + "robots/obstacle.inc": (0, 0, 0),
    TEB + "robots/omnidir_robot.inc": (0, 0, 0),
    TURTLE + "maze.world": (2, 1, 640),
    TURTLE + "turtlebot.inc": (0, 0, 0),
}
# the corpus leaves these pictures out
REFUSED = {
    RL + "Obstacles.world": "there is no picture './Obstacles.jpg'",
    RL + "willow-erratic.world": "there is no picture 'willow-full.pgm'",
    RL + "willow-four-erratics-multisensor.world": "there is no picture 'willow-full.pgm'",
    RL + "willow-four-erratics.world": "there is no picture 'willow-full.pgm'",
    TURTLE + "robopark_plan.world": "there is no picture '../robopark2.bmp'",
}


def rays(robot):
    return sum(sensor.samples for ranger in robot.rangers for sensor in ranger.device.sensors)


def test_stage_files_are_told_from_others(corpus):
    found = [
        str(file.relative_to(corpus))
        for kind in ("world", "inc", "sdf", "urdf", "xacro")
        for file in corpus.rglob(f"*.{kind}")
        if is_stage(file.read_bytes(), file.suffix)
    ]
    assert sorted(found) == sorted([*LOADED, *REFUSED])


@pytest.mark.parametrize("name", LOADED)
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_it_loads(corpus, name):
    start = time.process_time()
    stage = formats.load(corpus / name).content
    assert time.process_time() - start < 1.0
    found = (len(stage.models), len(stage.robots), sum(map(rays, stage.robots)))
    assert found == LOADED[name]


@pytest.mark.parametrize("name", REFUSED)
def test_it_is_refused_with_file_and_line(corpus, name):
    (error,) = [p for p in formats.check(corpus / name) if p.severity == "error"]
    assert error.message == REFUSED[name]
    assert error.file == str(corpus / name)
    assert error.line


def test_nothing_is_said_of_files_but_old_words(corpus):
    words = {
        problem.element
        for name in LOADED
        for problem in formats.check(corpus / name)
        if problem.rule is None
    }
    assert words == {"laser_return", "range_max", "range_min"}
