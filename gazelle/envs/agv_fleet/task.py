"""The fleet in many halls at once: each AGV of each hall is one learner."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.envs.agv_fleet import hall
from gazelle.envs.agv_fleet.contract import fleet_contract
from gazelle.envs.batched_task import BatchedTask, Info, TaskOutcome
from gazelle.envs.contract import PolicyContract
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.limits import MAX_AGENTS, MAX_LIDAR_SAMPLES
from gazelle.envs.options import TaskOptions, TaskSettings, check_integer, check_name
from gazelle.envs.polar import heading_to
from gazelle.errors import TaskError
from gazelle.simulation import Simulation
from gazelle.stage import stage_of
from gazelle.streams import Stream

PERIOD = 0.2
SPEED, TURN = 1.0, 1.0
REACH = 6.0
ARRIVED = 0.5
GOAL_REWARD, COLLISION_REWARD, STEP_REWARD, PROGRESS = 10.0, -10.0, -0.02, 1.0

PLACES = ("training", "held-out")
"""Positions of starts and goals: on a grid, or in the middles of its squares."""

_STEPS = 4
_TRIES = 24
_FARTHEST = math.hypot(hall.LENGTH, hall.WIDTH)


class FleetOptions(TaskOptions, total=False):
    """Further options of the fleet; see `FleetSettings`."""

    agents: int
    lidar_samples: int
    places: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetSettings(TaskSettings):
    """Options of the fleet, checked.

    Attributes:
        agents: AGVs in each hall.
        lidar_samples: Ranges in the observation, 2 or more.
        places: ``training`` or ``held-out``: where AGVs start and goals are.
    """

    engine: str = "planar"
    agents: int = 8
    lidar_samples: int = 24
    places: str = "training"

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        TaskSettings.__post_init__(self)
        check_integer("agents", self.agents, 1, MAX_AGENTS)
        check_integer("lidar_samples", self.lidar_samples, 2, MAX_LIDAR_SAMPLES)
        check_name("kind of places", str(self.places), PLACES)
        if self.engine != "planar":
            raise TaskError(
                f"AGVFleet runs in the plane, not with the engine '{self.engine}'",
                hint='leave out engine, or set engine="planar"',
            )
        if self.time_step is not None:
            raise TaskError(f"AGVFleet has a step of its own, {PERIOD / _STEPS:g} s")
        most = len(self.free_places()) // 2
        if self.agents > most:
            raise TaskError(f"the hall is too small for {self.agents} AGVs", hint=f"at most {most}")

    def free_places(self) -> Floats:
        """Return positions of starts and goals [m], shape (n, 2)."""
        return hall.places(between=self.places == "held-out")


class AGVFleetTask(BatchedTask):
    """AGVs drive to goals among each other; see `AGVFleetEnv` for the data sheet.

    Args:
        nworld: AGVs in all halls together, a whole multiple of those in one.
        settings: Options of the user.

    Raises:
        TaskError: The number of AGVs does not fit.
    """

    scenario_names = ("start_x", "start_y", "start_heading", "goal_x", "goal_y")

    def __init__(self, nworld: int, settings: FleetSettings) -> None:
        super().__init__(nworld, settings.max_episode_steps)
        self.agents = min(settings.agents, nworld)
        if nworld % self.agents:
            raise TaskError(
                f"{nworld} AGVs do not fill halls of {self.agents}",
                hint="num_envs counts AGVs; make it a multiple of agents",
            )
        self.halls = nworld // self.agents
        self.control_period = PERIOD
        self.observation_space = _observation_space(settings.lidar_samples)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (2,), np.float32)
        world = hall.world(
            self.agents, step=PERIOD / _STEPS, samples=settings.lidar_samples, reach=REACH
        )
        self.simulation = Simulation(
            world, settings.engine, nworld=self.halls, threads=settings.threads
        )
        self.agvs = stage_of(self.simulation)
        self._samples = settings.lidar_samples
        self._places = settings.free_places()
        self._start = np.zeros((nworld, 3))
        self._goal = np.zeros(nworld, np.intp)
        self._distance = np.zeros(nworld)
        self._reached = np.zeros(nworld, np.int64)
        self._frozen = np.zeros(nworld, np.bool_)
        self._seed(settings.seed or 0)

    @property
    def contract(self) -> PolicyContract:
        """Contract of its policies."""
        return fleet_contract(
            self.action_space,
            samples=self._samples,
            reach=REACH,
            farthest=_FARTHEST,
            speed=SPEED,
            turn=TURN,
            control_period=PERIOD,
            goal_distance=ARRIVED,
            max_episode_steps=self.max_episode_steps,
        )

    @property
    def poses(self) -> Floats:
        """x, y [m] and heading [rad] of all AGVs, hall by hall, shape (nworld, 3)."""
        return self.agvs.poses.reshape(-1, 3)

    @property
    def goals(self) -> Floats:
        """Goal of each AGV [m], shape (nworld, 2)."""
        return self._places[self._goal]

    def freeze(self, rows: Worlds) -> None:
        """Stop AGVs, as obstacles of others, until their next episode."""
        self._frozen[rows] = True

    def render(self, world: int) -> NDArray[np.uint8]:
        """Return the hall of one AGV from above."""
        first = world // self.agents * self.agents
        rows = slice(first, first + self.agents)
        return hall.picture(self.poses[rows], self.goals[rows])

    def close(self) -> None:
        """Close the simulation; a second call does nothing."""
        self.simulation.close()

    def _seed(self, seed: int) -> None:
        self._number = seed
        self._stream = Stream(seed, "agv_fleet", self.nworld)
        self.simulation.reset(seed=seed)
        self._frozen[:] = False

    def _begin(self, worlds: Worlds) -> None:
        """Place AGVs at free places; halls are independent of each other."""
        self._frozen[worlds], self._reached[worlds] = False, 0
        where = self._free_places(worlds)
        yaw = (self._stream.uniform(1, worlds)[:, 0] * 2.0 - 1.0) * math.pi
        # only those: cosines of the others' headings, taken again, could differ in the last bit
        poses = np.column_stack((self._places[where], yaw))
        self.agvs.place(worlds, poses)
        self._start[worlds] = poses
        self._goal[worlds] = where
        self._next_goals(worlds)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return start (x, y, heading) and first goal (x, y) of each AGV."""
        return np.hstack((self._start[worlds], self.goals[worlds]))

    def _free_places(self, worlds: Worlds) -> Worlds:
        """Return places [index] away from all others in the hall, sampled by rejection."""
        at = self.poses[:, :2].copy()
        at[worlds] = np.inf
        chosen = np.zeros(self.nworld, np.intp)
        pending = worlds
        for attempt in range(_TRIES):
            drawn = self._stream.uniform(1, pending)[:, 0]
            chosen[pending] = (drawn * len(self._places)).astype(np.intp)
            places = self._places[chosen[pending]]
            halls = pending // self.agents
            others = at.reshape(self.halls, self.agents, 2)[halls]
            away = np.hypot(*np.moveaxis(others - places[:, None, :], 2, 0)).min(axis=1)
            free = (away > hall.APART) | (attempt == _TRIES - 1)
            # Of those that draw the same place in the same hall the first gets it.
            key = halls * len(self._places) + chosen[pending]
            key = np.where(free, key, -1 - np.arange(len(key)))
            first = np.zeros(len(key), np.bool_)
            first[np.unique(key, return_index=True)[1]] = True
            done = free & first
            at[pending[done]] = places[done]
            pending = pending[~done]
            if not len(pending):
                break
        return chosen[worlds]

    def _next_goals(self, worlds: Worlds) -> None:
        """Sample other goals for these AGVs."""
        count = len(self._places) - 1
        drawn = (self._stream.uniform(1, worlds)[:, 0] * count).astype(np.intp)
        last = self._goal[worlds]
        self._goal[worlds] = np.where(drawn >= last, drawn + 1, drawn)
        self._distance[worlds] = _distance(self.poses[worlds], self.goals[worlds])

    def _hold(self, worlds: Worlds) -> Any:
        self.freeze(worlds)  # until it begins, in the way of the others
        return self._stream.counters[worlds]

    def _release(self, worlds: Worlds, kept: Any) -> None:
        self._stream.counters[worlds] = kept

    @property
    def floor_plan(self) -> FloorPlan:  # type: ignore[override]  # not fixed there
        """Walls and shelves, seen from above."""
        statics = self.agvs.fleet.scene.table
        return FloorPlan(statics.segments, statics.discs)

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        no = np.zeros(len(worlds), np.bool_)
        return self.observe()[worlds], self._info(worlds, self._distance[worlds], no, no)

    def observe(self) -> Floats32:
        """Return the present observations of all AGVs, shape (nworld, size)."""
        ranges = self.agvs.scan().reshape(self.nworld, -1)
        poses, goals = self.poses, self.goals
        velocity = self.agvs.velocities.reshape(-1, 3)
        moving = ~self.agvs.stalled.reshape(-1)
        columns = (
            _distance(poses, goals),
            heading_to(poses, poses[:, 2], goals),
            velocity[:, 0] * moving,
            velocity[:, 2] * moving,
        )
        return np.concatenate((ranges, np.stack(columns, axis=1)), axis=1, dtype=np.float32)

    def _act(self, actions: ArrayLike) -> TaskOutcome:
        chosen = np.asarray(actions, np.float64)
        if chosen.shape != (self.nworld, 2) or np.isnan(chosen).any():
            raise TaskError(f"actions must be numbers of shape ({self.nworld}, 2)")
        chosen = np.where(self._frozen[:, None], 0.0, np.clip(chosen, -1.0, 1.0))
        speed = np.where(self._frozen, 0.0, (chosen[:, 0] + 1.0) * (SPEED / 2.0))
        shape = (self.halls, self.agents)
        commands, bumped = self.agvs.commands, self.agvs.bumped
        commands[..., 0], commands[..., 2] = (
            speed.reshape(shape),
            chosen[:, 1].reshape(shape) * TURN,
        )
        bumped[:] = False
        self.simulation.step(_STEPS)
        crashed = bumped.reshape(-1).copy()
        crashed &= ~self._frozen
        poses = self.poses
        distance = _distance(poses, self.goals)
        arrived = distance < ARRIVED
        reward = STEP_REWARD + PROGRESS * (self._distance - distance)
        reward = np.where(arrived, reward + GOAL_REWARD, reward)
        reward = np.where(crashed, COLLISION_REWARD, reward)
        self._distance = distance.copy()
        self._reached += arrived
        everywhere = np.arange(self.nworld)
        if arrived.any():
            self._next_goals(everywhere[arrived])
        info = self._info(everywhere, distance, arrived, crashed)
        return TaskOutcome(self.observe(), reward, crashed, info)

    def _info(self, worlds: Worlds, distance: Floats, arrived: Bools, crashed: Bools) -> Info:
        return {
            "is_success": arrived.copy(),
            "is_collision": crashed.copy(),
            "distance": distance,
            "goal": self.goals[worlds],
            "position": self.poses[worlds, :2],
            "goals_reached": self._reached[worlds],
        }

    def _state(self) -> dict[str, Any]:
        return {
            "seed": np.array(self._number),
            "draws": self._stream.counters.copy(),
            "simulation": self.simulation.snapshot(),
            "goal": self._goal.copy(),
            "distance": self._distance.copy(),
            "reached": self._reached.copy(),
            "frozen": self._frozen.copy(),
        }

    def _set_state(self, state: dict[str, Any]) -> None:
        self._seed(int(state["seed"]))
        self._stream.counters[:] = state["draws"]
        self.simulation.restore(bytes(state["simulation"]))
        self._goal[:], self._distance[:] = state["goal"], state["distance"]
        self._reached[:], self._frozen[:] = state["reached"], state["frozen"]


def _observation_space(samples: int) -> gym.spaces.Box:
    low = [0.0] * samples + [0.0, -math.pi, 0.0, -TURN]
    high = [REACH] * samples + [_FARTHEST, math.pi, SPEED, TURN]
    return gym.spaces.Box(np.array(low, np.float32), np.array(high, np.float32))


def _distance(position: Floats, goal: Floats) -> Floats:
    """Return straight distances [m], shape (n,), with the same rounding in any batch."""
    x, y = goal[:, 0] - position[:, 0], goal[:, 1] - position[:, 1]
    away: Floats = np.sqrt(x * x + y * y)
    return away
