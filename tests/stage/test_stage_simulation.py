"""Stage worlds that run: drives, bounds, stall, odometry, rangers, reset, batches."""

import math
import threading
import time

import numpy as np
import pytest
from stage_samples import draw, write

from gazelle import SimulationError, formats
from gazelle.errors import FormatWarning, SimulationWarning
from gazelle.stage import StageSimulation

HEAD = "interval_sim 100\n"
FREE = "velocity_bounds [ -9 9 -9 9 0 0 -900 900 ]"


@pytest.fixture
def start(tmp_path):
    made = []

    def make(text, **options):
        made.append(StageSimulation(write(tmp_path, HEAD + text), threads=1, **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()


def test_a_robot_drives_along_an_exact_arc(start):
    sim = start(f"position ( {FREE} )")
    sim.commands[:] = (1.0, 0.0, 0.5)
    sim.step(10)
    assert sim.time == pytest.approx(1.0)
    assert sim.poses[0, 0] == pytest.approx(
        [math.sin(0.5) / 0.5, (1 - math.cos(0.5)) / 0.5, 0.5], abs=1e-12
    )


def test_a_robot_may_move_as_stage_moves_it(start):
    sim = start(f"position ( {FREE} )", euler=True)
    sim.commands[:] = (1.0, 0.0, math.pi * 5)
    sim.step(2)
    assert sim.poses[0, 0, :2] == pytest.approx([0.1, 0.1], abs=1e-12)
    assert abs(sim.poses[0, 0, 2]) == pytest.approx(math.pi)


def test_drives_move_as_they_can(start):
    sim = start(
        f'position ( drive "diff" {FREE} ) position ( drive "omni" {FREE} pose [0 9 0 0] )'
        f' position ( drive "car" wheelbase 2 {FREE} pose [0 -9 0 0] )'
    )
    sim.commands[:] = (1.0, 1.0, math.pi / 6)
    sim.step()
    assert sim.velocities[0] == pytest.approx(
        np.array(
            [
                [1.0, 0.0, math.pi / 6],
                [1.0, 1.0, math.pi / 6],
                [math.cos(math.pi / 6), 0.0, 0.25],
            ]
        )
    )
    assert sim.poses[0, 2, 2] == pytest.approx(0.025)


def test_velocities_are_bounded(start):
    sim = start("position ( velocity_bounds [ -0.5 0.4 0 0 0 0 -90 45 ] ) position ( )")
    sim.commands[:] = (9.0, 0.0, 9.0)
    sim.step()
    assert sim.velocities[0, 0] == pytest.approx([0.4, 0.0, math.pi / 4])
    assert sim.velocities[0, 1] == pytest.approx([1.0, 0.0, math.pi / 2])


def test_a_move_that_would_hit_something_is_not_made(start):
    sim = start("position ( size [1 1 1] ) model ( size [1 1 1] pose [1.05 0 0 0] )")
    sim.commands[:, :, 0] = 0.4
    sim.step()
    assert not sim.stalled[0, 0]
    assert sim.poses[0, 0, 0] == pytest.approx(0.04)
    sim.step()
    assert sim.stalled[0, 0]
    assert sim.poses[0, 0, 0] == pytest.approx(0.04)
    sim.commands[:, :, 0] = -0.4
    sim.step()
    assert not sim.stalled[0, 0]


@pytest.mark.parametrize(
    ("obstacle", "hit"),
    [
        ("obstacle_return 1", True),
        ("obstacle_return 0", False),
        ("pose [1.1 0 5 0]", False),
    ],
)
def test_only_obstacles_at_the_same_height_are_hit(start, obstacle, hit):
    sim = start(f"position ( size [1 1 1] ) model ( size [1 1 1] pose [1.1 0 0 0] {obstacle} )")
    sim.commands[:, :, 0] = 1.0
    sim.step(2)
    assert bool(sim.stalled[0, 0]) is hit


def test_robots_do_not_pass_each_other_nor_walls_of_bitmaps(start, tmp_path):
    draw(tmp_path, ["####", "#..#", "#..#", "####"])
    sim = start(
        'model ( bitmap "map.png" size [4 4 1] )'
        + "".join(
            f"position ( size [.3 .3 .3] pose [{x} {y} 0 {17 * x} ] )"
            for x in (-0.5, 0.5)
            for y in (-0.5, 0.5)
        )
    )
    rng = np.random.default_rng(0)
    stalls = 0
    for _ in range(200):
        sim.commands[0] = rng.uniform(-1, 1, (4, 3))
        sim.step()
        stalls += int(sim.stalled.sum())
        assert np.abs(sim.poses[0, :, :2]).max() < 0.85
    assert stalls > 10


RANGER = "ranger ( pose [0 0 -0.5 0] sensor ( range [0 8] fov 180 samples 181 {} ) )"


def test_rangers_measure_from_where_they_are(start):
    sim = start(f"position ( {RANGER.format('')} ) model ( size [1 1 2] pose [3.5 0 0 0] )")
    ranges = sim.scan_of("position:0")
    assert ranges.shape == (181,)
    assert ranges[90] == pytest.approx(3.0)
    assert ranges[0] == 8.0
    assert ranges[95] == pytest.approx(3.0 / math.cos(math.radians(5)))


def test_rangers_do_not_see_their_own_robot_but_others(start):
    sim = start(
        f'define r position ( {RANGER.format("")} )r ( name "a" ) r ( name "b" pose [2 0 0 180] )'
    )
    assert sim.scan_of("a")[90] == pytest.approx(1.8)
    assert sim.scan(0).shape == (1, 2, 181)


@pytest.mark.parametrize(
    ("wall", "seen"),
    [
        ("ranger_return -1", 8.0),
        ("obstacle_return 0", 1.5),
        ("pose [2 0 3 0]", 8.0),
        ("size [1 1 .1]", 8.0),
    ],
)
def test_rangers_see_what_reflects_at_their_height(start, wall, seen):
    sim = start(f"position ( {RANGER.format('')} ) model ( size [1 1 2] pose [2 0 0 0] {wall} )")
    assert sim.scan_of("position:0")[90] == pytest.approx(seen)


def test_rangers_tell_how_bright_things_are(start):
    sim = start(
        f"define r position ( {RANGER.format('')} ranger_return 0.5 )"
        "r ( ) r ( pose [0 3 0 0] ) model ( size [1 1 2] pose [3 0 0 0] ranger_return 250 )"
    )
    found = sim.returns(0, 0)
    assert (found[90], found[180], found[0]) == (250.0, 0.5, 0.0)


def test_each_sensor_of_a_sonar_is_measured(start):
    sim = start(
        "position ( ranger ( sensor ( pose [0 0 0 90] ) sensor ( pose [0 0 0 0] ) "
        "sensor ( range [0 9] ) ) ) model ( size [1 1 9] pose [0 2 0 0] )"
    )
    assert sim.scanners == 2
    found = [sim.scan_of("position:0", sensor=i)[0] for i in range(3)]
    assert found == pytest.approx([1.5, 5.0, 9.0])


def test_noise_is_drawn_from_the_seed(start):
    text = f"position ( {RANGER.format('noise [0.01 0 0]')} ) model ( size [1 9 2] pose [3 0 0 0] )"
    first, same, other = start(text, seed=1), start(text, seed=1), start(text, seed=2)
    scans = [sim.scan_of("position:0") for sim in (first, same, other)]
    assert (scans[0] == scans[1]).all()
    assert not (scans[0] == scans[2]).all()
    exact = start(text.replace("noise [0.01 0 0]", "")).scan_of("position:0")
    met = exact < 8.0
    assert 0.08 < np.std((scans[0] - exact)[met]) < 0.12  # the file gives the variance
    assert (scans[0][~met] == 8.0).all()


def test_the_share_of_noise_is_the_most_that_ranges_are_off_by(start):
    text = f"position ( {RANGER.format('noise [0 0.1 0]')} ) model ( size [1 9 2] pose [3 0 0 0] )"
    exact = start(text.replace("noise [0 0.1 0]", "")).scan_of("position:0")
    share = (start(text).scan_of("position:0") / exact - 1.0)[exact < 7.0]
    assert np.abs(share).max() <= 0.1
    assert (np.histogram(share, 4, (-0.1, 0.1))[0] > len(share) / 8.0).all()  # all as likely


def test_a_scan_is_made_once_a_step(start):
    sim = start(f"position ( {RANGER.format('noise [0.1 0 0]')} ) model ( pose [2 0 0 0] )")
    first = sim.scan_of("position:0")
    assert (sim.scan_of("position:0") == first).all()
    sim.step()
    assert not (sim.scan_of("position:0") == first).all()


def test_a_pose_can_be_set(start):
    sim = start(f'position ( name "r" {RANGER.format("")} ) model ( size [1 1 2] pose [9 0 0 0] )')
    assert sim.scan_of("r")[90] == 8.0
    sim.set_pose("r", (6.0, 0.0, 0.0))
    assert sim.poses[0, 0] == pytest.approx([6.0, 0.0, 0.0])
    assert sim.scan_of("r")[90] == pytest.approx(2.5)
    assert not sim.true_velocities.any()
    with pytest.raises(SimulationError, match="there are: r"):
        sim.set_pose("q", (0.0, 0.0, 0.0))
    with pytest.raises(SimulationError, match="finite numbers"):
        sim.set_pose("r", (math.nan, 0.0, 0.0))


def test_true_velocities_are_in_the_worlds_axes(start):
    sim = start("position ( pose [0 0 0 90] )")
    sim.commands[:, :, 0] = 0.5
    sim.step(3)
    assert sim.true_velocities[0, 0] == pytest.approx([0.0, 0.5, 0.0], abs=1e-12)


def test_a_reset_is_a_reset(start):
    text = (
        f'define r position ( localization "odom" {RANGER.format("noise [.1 0 0]")} )'
        "r ( ) r ( pose [3 0 0 90] )"
    )
    sim = start(text, seed=3)

    def run():
        sim.commands[:] = (0.5, 0.0, 0.2)
        sim.step(10)
        return sim.poses.copy(), sim.odometry.copy(), sim.scan(0).copy()

    first = run()
    sim.reset()
    assert sim.time == 0.0
    assert not sim.commands.any()
    assert not sim.stalled.any()
    for one, other in zip(first, run(), strict=True):
        assert (one == other).all()


def test_worlds_of_a_batch_are_what_they_are_alone(start):
    text = f'define r position ( localization "odom" {RANGER.format("noise [.1 0 0]")} ) r ( )'
    many, one = start(text, nworld=3, seed=5), start(text, seed=5)
    for sim in (many, one):
        sim.commands[:] = (0.5, 0.0, 0.2)
        sim.step(10)
    assert many.scan(0).shape == (3, 1, 181)
    assert (many.poses[0] == one.poses[0]).all()
    assert (many.odometry[0] == one.odometry[0]).all()
    assert (many.scan(0)[0] == one.scan(0)[0]).all()
    assert not (many.odometry[0] == many.odometry[1]).all()
    many.reset_positions(np.array([1]))
    assert not many.poses[1].any()
    assert many.poses[0].any()


def test_other_threads_have_things_done_between_steps(start):
    sim = start('position ( name "r" )')
    done = []

    def work():
        for i in range(50):
            with sim.lock:
                sim.set_pose("r", (float(i), 0.0, 0.0))
        done.append(True)

    thread = threading.Thread(target=work)
    thread.start()
    while thread.is_alive():
        sim.step()
    thread.join()
    assert done
    assert sim.poses[0, 0, 0] == 49.0


def test_listeners_hear_of_every_step(start):
    sim = start("position ( )")
    heard = []
    end = sim.subscribe(lambda: heard.append(sim.time))
    sim.step(3)
    end()
    sim.step(3)
    assert heard == pytest.approx([0.1, 0.2, 0.3])


def test_steps_cannot_be_negative_nor_after_the_end(start):
    sim = start("position ( )")
    with pytest.raises(SimulationError):
        sim.step(-1)
    sim.close()
    with pytest.raises(SimulationError, match="closed"):
        sim.step()


def test_wander_keeps_robots_moving_and_off_the_walls(start, tmp_path):
    draw(tmp_path, ["#" * 20] + ["#" + "." * 18 + "#"] * 18 + ["#" * 20])
    robots = "".join(
        f"r ( pose [{x} {y} 0 {31 * x + 77 * y}] )" for x in (-3, 0, 3) for y in (-3, 0, 3)
    )
    sim = start(
        f'model ( bitmap "map.png" size [10 10 1] ) define r position ( size [.3 .3 .3] '
        f'ctrl "wander" ranger ( pose [0 0 -.1 0] sensor ( fov 180 samples 91 range [0 8] ) ) ) {robots}'
    )
    before = sim.poses.copy()
    sim.step(600)
    assert (np.linalg.norm((sim.poses - before)[0, :, :2], axis=1) > 0.3).all()
    assert sim.stalled.mean() < 0.5


def test_wander_needs_a_ranger(start):
    with pytest.warns(SimulationWarning, match="'wander' needs a ranger"):
        start('position ( ctrl "wander" )')


def test_lasernoise_spoils_scans(start):
    text = f"position ( {{}} {RANGER.format('')} ) model ( size [1 9 2] pose [3 0 0 0] )"
    clean = start(text.format("")).scan_of("position:0")
    noisy = start(text.format('ctrl "lasernoise"')).scan_of("position:0")
    met = clean < 8.0
    assert 0.02 < np.std((noisy - clean)[met]) < 0.1


def test_controllers_can_be_left_out(start):
    sim = start(f'position ( ctrl "wander" {RANGER.format("")} )', controllers=False)
    sim.step(5)
    assert not sim.commands.any()


def test_other_controllers_are_left_out_with_a_warning(start):
    with pytest.warns(FormatWarning, match="'benchctrl' is a program for Stage itself"):
        sim = start('position ( ctrl "benchctrl roam" )')
    sim.step()


def test_only_stage_worlds_run_here(tmp_path):
    sdf = write(tmp_path, '<sdf version="1.6"><world name="w"/></sdf>')
    with pytest.raises(SimulationError, match="not a world of Stage"):
        StageSimulation(sdf)
    loaded = formats.load(write(tmp_path, "position ( )"))
    with StageSimulation(loaded, threads=1) as sim:
        assert len(sim.robots) == 1


def test_a_fleet_is_the_same_at_any_number_of_threads(tmp_path):
    draw(tmp_path, ["#" * 20] + ["#" + "." * 18 + "#"] * 18 + ["#" * 20])
    robots = "".join(
        f"r ( pose [{x / 2} {y / 2} 0 {31 * x + 77 * y}] )"
        for x in range(-7, 8)
        for y in range(-7, 8)
    )
    text = (
        'model ( bitmap "map.png" size [10 10 1] ) define r position ( size [.3 .3 .3] '
        'ctrl "wander" ranger ( pose [0 0 -.1 0] sensor ( fov 180 samples 31 range [0 8] ) ) )'
        + robots
    )
    file = write(tmp_path, text)
    found = []
    for threads in (1, 2):
        with StageSimulation(file, threads=threads, seed=1) as sim:
            sim.step(50)
            found.append((sim.poses.tobytes(), sim.scan(0).tobytes()))
    assert found[0] == found[1]


def test_running_at_a_rate_keeps_to_it_though_steps_are_long(start):
    sim = start("position ( )")
    begin = time.monotonic()
    sim.run(1.0, rate=4.0)
    assert sim.time == pytest.approx(1.0)
    assert time.monotonic() - begin > 0.24
