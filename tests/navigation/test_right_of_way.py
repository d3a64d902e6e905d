"""Robots that block each other make way, by priority, where there is room to."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import gazelle
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.right_of_way import RightOfWay, RightOfWaySettings
from gazelle.navigation.waiting_places import RobotDisc, WaitingPlaceMap
from gazelle.stage import stage_of

ROOM = """
interval_sim 100
define laser ranger
( sensor ( range [0.05 6.0] fov 270 samples 136 ) size [0.1 0.1 0.1] pose [0.05 0 -0.1 0] )
define base position ( size [0.3 0.24 0.2] localization "gps" laser() )
define block model ( gui_move 0 )
"""
BRISK = {
    "global_costmap": {"inflation_layer": {"inflation_radius": 0.5}},
    "local_costmap": {"inflation_layer": {"inflation_radius": 0.5}},
    "DWAPlannerROS": {
        "max_vel_x": 0.5, "max_vel_trans": 0.5, "acc_lim_x": 2.0, "min_vel_theta": 0.3, "vth_samples": 20,
    },
}  # fmt: skip
HALF = 0.3
"""Of the width of ways, in which no two robots pass each other [m]."""


def walls(boxes):
    """Return blocks of a Stage world from their corners (x0, y0, x1, y1)."""
    return "\n".join(
        f"block ( size [{x1 - x0} {y1 - y0} 0.5] pose [{(x0 + x1) / 2} {(y0 + y1) / 2} 0 0] )"
        for x0, y0, x1, y1 in boxes
    )


CORRIDOR = walls([
    (-4, -2, 4, -HALF), (-4, HALF, -0.5, 2), (0.5, HALF, 4, 2), (-0.5, 1.0, 0.5, 2),
    (-7.1, -2, -7, 2), (7, -2, 7.1, 2), (-7.1, -2.1, 7.1, -2), (-7.1, 2, 7.1, 2.1),
])  # fmt: skip
"""Two rooms and a corridor of 8 m, with a bay half-way."""
CROSSING = walls([
    box for a in (-1, 1) for b in (-1, 1) for box in (
        tuple(sorted((a * HALF, a * 3)) + sorted((b * HALF, b * 3))),
        tuple(sorted((a * 3, a * 5.6)) + sorted((b * 1.2, b * 5.6))),
        tuple(sorted((a * 1.2, a * 3)) + sorted((b * 3, b * 5.6))),
    ) for box in [(box[0], box[2], box[1], box[3])]
] + [(-5.7, -5.6, -5.6, 5.6), (5.6, -5.6, 5.7, 5.6), (-5.6, -5.7, 5.6, -5.6), (-5.6, 5.6, 5.6, 5.7)])  # fmt: skip
"""Two ways that cross, with a room at each end."""
MEETINGS = {
    "two in a corridor": (CORRIDOR, {"a": (-5.5, 0, 0, 5.5, 0), "b": (5.5, 0, 180, -5.5, 0)}),
    "two at a crossing": (CROSSING, {"a": (-4.5, 0, 0, 0, 4.5), "b": (0, 4.5, -90, -4.5, 0)}),
}  # fmt: skip


def meet(tmp_path, name, settings, seed=None):
    """Return the order of arrivals, the commands of others, and collisions.

    With a seed robots begin a little elsewhere, and up to 8 s apart.
    """
    blocks, trips = MEETINGS[name]
    random = np.random.default_rng(seed)
    spread = np.zeros(4) if seed is None else np.array([0.2, 0.1, 20.0, 4.0])
    off = {each: random.uniform(-spread, spread) for each in trips}
    robots = [
        f'base ( name "{each}" pose [{x + off[each][0]} {y + off[each][1]} 0 {a + off[each][2]}] )'
        for each, (x, y, a, *_) in trips.items()
    ]
    path = tmp_path / "meeting.world"
    path.write_text("\n".join([ROOM, blocks, *robots]))
    with gazelle.Simulation(path, engine="planar", seed=0, threads=1) as sim:
        tasks, reached, failed, touched = {}, [], {}, np.zeros(len(trips), np.bool_)
        while len(reached) + len(failed) < len(trips) and sim.time < 200.0:
            for each, (*_, x, y) in trips.items():
                if each not in tasks and sim.time >= off[each][3] + spread[3]:
                    rules = {"right_of_way": settings.get(each, {})}
                    sim.robots[each].navigation.configure(BRISK | rules)
                    tasks[each] = sim.robots[each].navigation.go_to(x, y)
            sim.step()
            touched |= stage_of(sim).stalled[0]
            done = {each: task for each, task in tasks.items() if task.done}
            reached += [e for e, task in done.items() if task.succeeded and e not in reached]
            failed = {each: task.text for each, task in done.items() if not task.succeeded}
        return reached, failed, touched


BOTH = {"a": {"enabled": True}, "b": {"enabled": True}}


@pytest.mark.slow
def test_two_that_meet_nearly_always_reach_their_goals_touching_nothing(tmp_path):
    good = 0
    for name in MEETINGS:
        for seed in range(4):
            reached, failed, touched = meet(tmp_path, name, BOTH, seed)
            print(f"{name}, {seed}: reached {reached}, {failed}, touched {touched.tolist()}")
            good += len(reached) == 2 and not touched.any()
    print(f"{good} of {4 * len(MEETINGS)}")
    assert good >= 7


@pytest.mark.slow
def test_who_has_priority_goes_first(tmp_path):
    assert meet(tmp_path, "two in a corridor", BOTH)[0] == ["a", "b"]
    first = {"enabled": True, "priority": 1}
    assert meet(tmp_path, "two in a corridor", BOTH | {"b": first})[0] == ["b", "a"]


@pytest.mark.slow
def test_without_it_they_wait_for_each_other_until_they_give_up(tmp_path):
    reached, failed, _ = meet(tmp_path, "two in a corridor", {})
    assert reached == []
    assert sorted(failed) == ["a", "b"]


def test_parameters_of_the_wrong_kind_are_refused(tmp_path):
    with pytest.raises(Error, match="'priority' must be of type float, not 'high'"):
        meet(tmp_path, "two in a corridor", {"a": {"priority": "high"}})


# The law by itself --------------------------------------------------------------------------------


@dataclass
class Told:
    """A robot that does at once what it is told."""

    name: str
    body: RobotDisc | None
    goal: tuple[float, float, float] | None
    grid: OccupancyMap
    right_of_way: RightOfWaySettings = field(
        default_factory=lambda: RightOfWaySettings(enabled=True)
    )
    aside: bool = False
    told: list[str] = field(default_factory=list)

    def stand(self):
        self.told.append("stand")

    def step_aside(self, x, y, time):
        self.body = replace(self.body, x=x, y=y)
        self.aside = True
        self.told.append("aside")

    def go_on(self, time, known, others):
        self.told.append("go on")


def corridor_map(bay):
    """Return a corridor of 10 m by 0.6 m in cells of 5 cm, closed at both ends."""
    cells = np.full((60, 204), 100, np.int8)
    cells[10:22, 2:202] = 0
    if bay:
        cells[22:40, 120:140] = 0
    return OccupancyMap(cells, 0.05, gazelle.Pose(0.0, 0.0))


def two(bay):
    grid = corridor_map(bay)
    a = Told("a", RobotDisc(4.0, 0.8, 0.12, 0.2), (9.0, 0.8, 0.0), grid)
    b = Told("b", RobotDisc(5.5, 0.8, 0.12, 0.2), (1.0, 0.8, 0.0), grid)
    return a, b


def run(law, robots, seconds, start=0.0):
    for tick in range(round(seconds / 0.5)):
        law.update(start + 0.5 * tick, robots)


def test_one_steps_into_the_bay_until_the_other_has_passed():
    a, b = two(bay=True)
    law = RightOfWay()
    run(law, [b, a], 6.0)
    assert (a.told, b.told) == (["stand", "go on"], ["stand", "aside"])
    assert 6.0 < b.body.x < 7.0
    assert b.body.y - 0.8 > 0.5
    a.body = replace(a.body, x=7.2)
    run(law, [b, a], 0.5, 6.0)
    assert b.told[2:] == []  # it is past, but near
    a.body = replace(a.body, x=8.5)
    run(law, [b, a], 0.5, 6.5)
    assert b.told[2:] == ["go on"]


def test_nobody_is_told_anything_where_there_is_no_room_or_no_need():
    a, b = two(bay=False)
    a.goal, b.goal = (9.8, 0.8, 0.0), (0.4, 0.8, 0.0)
    run(RightOfWay(), [a, b], 20.0)
    assert a.told == b.told == []
    a, b = two(bay=True)
    b.goal = None
    run(RightOfWay(), [a, b], 20.0)
    assert a.told == b.told == []


def test_who_loses_the_goal_lets_the_other_go_on():
    a, b = two(bay=True)
    law = RightOfWay()
    run(law, [a, b], 5.0)
    a.goal = None
    run(law, [a, b], 1.0, 5.0)
    assert b.told == ["stand", "aside", "go on"]


@given(st.floats(0.4, 9.6), st.floats(0.4, 9.6), st.floats(0.1, 0.25))
def test_a_refuge_is_beside_the_way_and_never_beyond_the_leader(first, second, radius):
    assume(abs(first - second) > 3.0 * radius)
    ground = WaitingPlaceMap(corridor_map(bay=True))
    leader = RobotDisc(first, 0.8, 0.6 * radius, radius)
    robot = RobotDisc(second, 0.8, 0.6 * radius, radius)
    path = ground.path(leader, (9.6 if second > first else 0.4, 0.8))
    found = ground.waiting_place(robot, leader, path, [], [])
    reachable = (6.5 - first) * (second - first) > 0.0
    if found is not None:
        assert np.hypot(*(path - (found.x, found.y)).T).min() >= robot.apart(leader) - 0.05
        assert ground.has(np.array([[found.x, found.y]])).sum() == 0 or radius < 0.15
    if reachable and abs(first - 6.5) > 1.5:
        assert found is not None
