"""Stage's controller ``wander``, in native code."""

import numpy as np
import pytest
from stage_samples import write

from gazelle import formats
from gazelle.errors import SimulationError
from gazelle.simulation import Simulation
from gazelle.stage import StageSimulation, stage_of, with_wander
from gazelle.stage.wander import Wander
from gazelle.stage.wandering import Wandering

SCANNER = "ranger ( sensor ( range [0 8] fov 180 samples {} ) )"
ROBOT = 'position ( size [.1 .1 .1] ctrl "wander" ' + SCANNER + " pose [{} {} 0 {}] )"


def wall(x, y):
    """Return a block of 0.2 m with its middle there."""
    return f"model ( size [.2 .2 1] pose [{x} {y} 0 0] )"


@pytest.mark.parametrize("samples", [1, 3, 180, 181])
@pytest.mark.parametrize(
    ("things", "command"),
    [
        ("", (0.4, 0.0, 0.0)),
        (wall(1.5, 0.0), (0.4, 0.0, 0.0)),
        (wall(0.0, 1.0), (0.4, 0.0, 0.0)),  # beside it
        (wall(0.0, 0.5), (0.4, 0.0, 0.0)),
        (wall(0.8, 0.0), (0.05, 0.0, 0.5)),
        (wall(0.3, 0.0), (0.0, 0.0, 0.5)),
    ],
)
def test_it_turns_away_from_what_is_ahead(start, samples, things, command):
    sim = start(ROBOT.format(samples, 0, 0, 0) + things)
    sim.step()
    assert abs(sim.commands[0, 0]) == pytest.approx(command)


@pytest.mark.parametrize("samples", [31, 180, 181])
@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("degrees", [30, 45, 85])
def test_it_stands_and_turns_for_anything_near_wherever_it_is(start, samples, side, degrees):
    x, y = (0.3 * part for part in (np.cos(np.radians(degrees)), np.sin(np.radians(degrees))))
    sim = start(ROBOT.format(samples, 0, 0, 0) + wall(x, side * y))
    sim.step()
    assert sim.commands[0, 0] == pytest.approx((0.0, 0.0, -0.5 * side))


def stages_answer(ranges):
    """Return speed and turn of Stage 4.3's controller for a scan when it is not turning."""
    count = len(ranges)
    third = count // 3
    obstruction = any(r < 1.0 for i, r in enumerate(ranges) if third < i < count - third)
    stop = min(ranges) < 0.3
    if not (obstruction or stop):
        return 0.4, 0.0
    left, right = ranges[count // 2 + 1 :], ranges[: count // 2 + 1]
    return (0.0 if stop else 0.05), (-0.5 if min(left) < min(right) else 0.5)


@pytest.mark.parametrize("samples", [9, 10, 11, 180, 181])
def test_it_answers_any_scan_as_stage_does(samples):
    random = np.random.default_rng(samples)
    settings = {
        "cruise": 0.4,
        "creep": 0.05,
        "turn": 0.5,
        "front": 1.0,
        "stop": 0.3,
        "patience": 10,
    }
    for _ in range(200):
        nearest = random.choice([0.1, 0.5, 1.5])
        ranges = random.uniform(nearest, 8.0, (1, samples)) ** random.choice([1.0, 2.0])
        command, turn_state = np.zeros((1, 3)), np.zeros((1, 2), np.int64)
        zero = np.zeros(1, np.int64)
        law = Wandering(command, ranges, zero, zero, turn_state, nworld=1, seed=5, **settings)
        law.choose(0, 1, 0)
        assert tuple(command[0, [0, 2]]) == stages_answer(ranges[0])


def test_it_looks_at_the_first_ranger_of_more_than_8_samples(start):
    few = "ranger ( sensor ( range [0 8] fov 10 samples 8 ) )"
    many = SCANNER.format(9)
    robot = 'position ( size [.1 .1 .1] ctrl "wander" ' + few + many + " pose [0 0 0 0] )"
    sim = start(robot + wall(0.0, 0.3))  # which the first one does not see
    sim.step()
    assert sim.commands[0, 0, 0] == 0.0


@pytest.mark.parametrize("samples", [180, 181])
@pytest.mark.parametrize("side", [-1, 1])
def test_it_turns_to_where_there_is_more_room(start, samples, side):
    things = wall(0.8, 0.0) + wall(0.3, 0.5 * side)
    sim = start(ROBOT.format(samples, 0, 0, 0) + things)
    sim.step()
    assert sim.commands[0, 0, 2] == pytest.approx(-0.5 * side)


def test_it_turns_for_one_to_two_seconds_once_it_began(start):
    sim = start("".join(ROBOT.format(180, 0, 9 * i, 0) + wall(0.8, 9 * i) for i in range(40)))
    turned = [0] * 40
    for _ in range(25):
        sim.step()
        for i in range(40):
            turned[i] += bool(sim.commands[0, i, 2])
            sim.set_pose_of(i, (-5.0, 9.0 * i, 3.0))  # away from what it saw
    assert set(turned) <= set(range(10, 20))
    assert len(set(turned)) > 5


def test_threads_and_other_worlds_change_nothing(start, tmp_path):
    text = "".join(ROBOT.format(45, i % 10, i // 10, 40 * i) for i in range(100)) + wall(5.5, 5.5)
    file = write(tmp_path, text)
    runs = [
        start(text, seed=2),
        StageSimulation(file, seed=2, threads=2),
        StageSimulation(file, seed=2, threads=2, nworld=3),
    ]
    for sim in runs:
        sim.step(60)
    assert (runs[0].poses == runs[1].poses).all()
    assert (runs[0].poses[0] == runs[2].poses[0]).all()
    for sim in runs[1:]:
        sim.close()
    again = runs[0].poses.copy()
    runs[0].reset()
    runs[0].step(60)
    assert (runs[0].poses == again).all()


@pytest.mark.parametrize(
    ("what", "native"),
    [
        ('ctrl "wander"', True),
        ('ctrl "wander" localization "odom" drive "omni"', True),
        ('ctrl "wander" localization "odom" drive "car"', True),
        ('ctrl [ "wander" "lasernoise 0.1" ]', False),
    ],
)
def test_many_steps_at_once_are_the_same_as_one_by_one(start, monkeypatch, what, native):
    """Without Python between them, if there is nothing for it to do."""
    text = "".join(
        ROBOT.format(45 if i % 3 else 31, 0.6 * (i % 5), 0.6 * (i // 5), 40 * i).replace(
            'ctrl "wander"', what
        )
        for i in range(20)
    ) + wall(3.5, 3.5)
    asked = []
    update = Wander.update
    monkeypatch.setattr(Wander, "update", lambda self: (asked.append(self), update(self)))
    whole, single = start(text, seed=3, nworld=2), start(text, seed=3, nworld=2)
    whole.step(200)
    for _ in range(200):
        single.step()
    assert bool(asked) is not native
    for name in ("poses", "commands", "odometry", "stalled", "true_velocities", "time"):
        assert np.array_equal(getattr(whole, name), getattr(single, name)), name
    assert np.array_equal(whole.scan(0), single.scan(0))
    assert whole.stalled.any() or (whole.commands[..., 2] != 0.0).any()


def test_who_listens_hears_of_every_step(start):
    sim = start(ROBOT.format(9, 0, 0, 0))
    times = []
    sim.subscribe(lambda: times.append(sim.time))
    sim.step(5)
    assert times == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])


def test_robots_that_nothing_drives_wander_if_asked_to(tmp_path):
    """And those that a controller drives keep theirs; what has no drive stands."""
    own = 'position ( size [.1 .1 .1] ctrl "lasernoise 0.1" ' + SCANNER.format(9)
    text = own + " pose [0 3 0 0] )" + wall(5, 5)
    text += "position ( size [.1 .1 .1] " + SCANNER.format(9) + " pose [0 0 0 0] )"
    world = with_wander(formats.load(write(tmp_path, text)))
    with Simulation(world, "planar") as sim:
        assert stage_of(sim).controllers
        sim.run(2.0)
        assert np.hypot(*stage_of(sim).poses[0, :, :2].T).tolist() == pytest.approx(
            [3.0, 0.8], abs=0.1
        )


def test_only_robots_of_stage_files_wander():
    with pytest.raises(SimulationError, match="only robots of Stage files"):
        with_wander(formats.load("empty"))
    with pytest.raises(SimulationError, match="did you mean 'rounds'"):
        with_wander(formats.load("fleet"), "round")
