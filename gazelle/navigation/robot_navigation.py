"""``robot.navigation``: the whole stack in process, in simulated time."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import SimulationError, did_you_mean
from gazelle.navigation.exploration import ExploreSettings
from gazelle.navigation.live_map import LiveMap
from gazelle.navigation.localization import AmclSettings, Localizer, PlanarScan
from gazelle.navigation.move_base import GoalOutcome, navigation_stack
from gazelle.navigation.move_base.state_machine import goal_of
from gazelle.navigation.outline import outline_of
from gazelle.navigation.plugin import laser_of
from gazelle.navigation.right_of_way import RightOfWay, RightOfWaySettings
from gazelle.navigation.true_map import true_map
from gazelle.navigation.usual_parameters import USUAL, merged, with_outline
from gazelle.navigation.world_pilot import WorldPilot
from gazelle.rotations import rotate, yaw_of
from gazelle.sensors import LaserScan
from gazelle.simulation import ModelPlugin, Robot, SensorUnit
from gazelle.simulation.clock import Schedule
from gazelle.simulation.inputs import chosen, one_world
from gazelle.simulation.navigation import NavigationPlan

_SOURCES = ("truth", "amcl", "slam")
_LOST_SEED = 7


class RobotNavigation(ModelPlugin):
    """Takes the model that it is on to goals by ``move_base``'s law, in every world by itself.

    It uses the model's own ports: its laser's scans, its odometry, and its drive's ``cmd_vel``, which it
    commands only while there is a goal. Worlds are gone through one by one, and only those with a goal:
    right for some worlds, not for thousands.

    Attributes:
        pilots: Of the worlds where it has had a goal.
        traffic: Of each world, the arbiter of right of way, shared by all robots.
    """

    update_rate = 10.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Find a laser and a drive.

        Raises:
            SimulationError: There is none.
        """
        if "cmd_vel" not in robot.inputs or "odom" not in robot.outputs:
            raise SimulationError(
                f"'{robot.name}' has no drive to navigate with",
                hint="add a plugin with cmd_vel and odom, such as libgazebo_ros_diff_drive.so",
            )
        if robot.inputs["cmd_vel"].steers:
            raise SimulationError(
                f"'{robot.name}' has Ackermann steering, which no planner here supports",
                source=robot.description.source,
                hint="use a drive that can turn on the spot, 'diff' or 'omni'",
            )
        self._robot = robot
        self._unit, self._laser = laser_of(robot, parameters)
        self._values: Mapping[str, Any] = USUAL
        self._grid: OccupancyMap | None = None
        self._source = "truth"
        self.pilots: dict[int, WorldPilot] = {}
        self._scan: LaserScan | None = None
        self._sleep: Callable[[], None] | None = None
        # Shared by all robots of the simulation; one for each world.
        self.traffic: dict[int, RightOfWay] = next((p.traffic for p in self._peers()), {})

    def _peers(self) -> Iterator[RobotNavigation]:
        """Yield all present ones of the simulation."""
        for entry in self._robot.simulation.plugins:
            if isinstance(entry.plugin, RobotNavigation):
                yield entry.plugin

    def configure(
        self,
        parameters: Mapping[str, Any] | None = None,
        *,
        grid: OccupancyMap | None = None,
        localization: str = "truth",
    ) -> None:
        """Set other parameters, another map, or another localisation.

        Goals are forgotten.

        Args:
            parameters: As below ``~`` of ``move_base``, nested; what is not there keeps its default for
                robots of a TurtleBot3's size. ``amcl`` below them has those of ``amcl``, ``gmapping`` those
                of ``slam_gmapping``.
            grid: The map; by default the true one of the world, without robots.
            localization: ``truth``; ``amcl`` by odometry and laser, from the true pose on; or ``slam``: the
                map is built while driving, in the frame of the odometry's beginning.

        Raises:
            SimulationError: The method is unknown, or a map is given that is to be built.
            Error: A parameter is wrong.
        """
        if localization not in _SOURCES:
            raise SimulationError(
                f"localization must be truth, amcl or slam, not '{localization}'",
                hint=did_you_mean(localization, _SOURCES),
            )
        if localization == "slam" and grid is not None:
            raise SimulationError(
                "a robot with localization='slam' takes no map", hint="leave out 'grid'"
            )
        values = merged(USUAL, parameters or {})
        navigation_stack({**values, **with_outline(values, self._outline())})
        RightOfWaySettings.read(values)
        self._values, self._source = values, localization
        self._grid = grid if grid is not None else self._grid
        self._keep_to(float(values["controller_frequency"]))
        self.pilots.clear()

    def _keep_to(self, rate: float) -> None:
        """Set the rate of cycles [Hz]."""
        self.update_rate = rate
        simulation = self._robot.simulation
        for entry in simulation.plugins:
            if entry.plugin is self:
                entry.schedule = Schedule(rate)
                simulation.lock.changes += 1

    def go_to(
        self, x: float, y: float, yaw: float | None = None, *, worlds: Worlds | None = None
    ) -> GoalTask:
        """Set a goal; the simulation has to run, by itself or by ``wait`` of what is returned.

        Args:
            x: In the map's frame: the world's, unless a map was given [m].
            y: Likewise [m].
            yaw: Heading to take there [rad]; that from here to there if None.
            worlds: Worlds; all if None.

        Raises:
            SimulationError: There is nothing at the laser's height to make a map of.
            Error: A number is not finite.
        """
        some = self._some(worlds)
        poses = self._robot.planar_pose()
        for world in some:
            here = poses[world]
            heading = math.atan2(y - here[1], x - here[0]) if yaw is None else yaw
            goal = goal_of(float(x), float(y), float(heading))
            self._pilot(world).go(goal, self._robot.simulation.time)
        self._listen()
        return GoalTask(self._robot, [self.pilots[world] for world in some])

    def explore(
        self, settings: ExploreSettings | None = None, *, worlds: Worlds | None = None
    ) -> GoalTask:
        """Explore frontiers of the map until none is left; the simulation has to run.

        With ``localization="slam"`` that is until the map is whole. The law is that of ``explore_lite``.

        Args:
            settings: As of ``explore_lite``.
            worlds: Worlds; all if None.
        """
        some = self._some(worlds)
        for world in some:
            self._pilot(world).explore(settings or ExploreSettings())
        self._listen()
        return GoalTask(self._robot, [self.pilots[world] for world in some])

    def map(self, world: int = 0) -> OccupancyMap | None:
        """Return the map that a world's robot uses.

        None before the first scan of one that is made.
        """
        return self._pilot(one_world(world, self._robot.simulation.nworld)).grid

    def cancel(self, worlds: Worlds | None = None) -> None:
        """Cancel the goal and stop."""
        some = list(self.pilots) if worlds is None else self._some(worlds)
        for world in some:
            pilot = self.pilots.get(world)
            if pilot is not None and pilot.busy:
                pilot.cancel()
                self._robot.inputs["cmd_vel"].send(0.0, 0.0, np.array([world]))

    def _some(self, worlds: Worlds | None) -> list[int]:
        """Return the worlds that are meant."""
        nworld = self._robot.simulation.nworld
        found = chosen(worlds, nworld)
        return list(range(nworld)) if found is None else found.tolist()

    def plans(self) -> dict[int, NavigationPlan]:
        """Return the goal of each world that has one, and the path to it."""
        goals = {world: pilot.goal for world, pilot in self.pilots.items()}
        return {
            world: NavigationPlan(goal, self.pilots[world].path)
            for world, goal in goals.items()
            if goal is not None
        }

    def on_update(self, time: float) -> None:
        """Run a cycle in each world with a goal."""
        busy = {world: pilot for world, pilot in self.pilots.items() if pilot.busy}
        scan = self._scan
        if not busy or scan is None:
            if not busy:
                self._disable_laser()
            return
        true, odom = self._robot.planar_pose(), self._robot.outputs["odom"].last
        yaws = yaw_of(odom.quaternion)
        for world, pilot in busy.items():
            x, y, heading = true[world].tolist()
            reckoned = (*odom.position[world, :2].tolist(), float(yaws[world]))
            linear = odom.linear[world]
            speed = float(linear[0]), float(linear[1]), float(odom.angular[world, 2])
            velocity = pilot.cycle(
                time, (x, y, heading), reckoned, speed, self._planar(scan, world), scan.stamp
            )
            if velocity is not None:
                forward, aside, turning = velocity
                command = self._robot.inputs["cmd_vel"]
                linear_command = forward if not aside else (forward, aside, 0.0)
                command.send(linear_command, turning, np.array([world]))
            self._resolve_deadlocks(time, world)

    def _resolve_deadlocks(self, time: float, world: int) -> None:
        """Resolve deadlocks between robots of a world."""
        traffic = self.traffic.setdefault(world, RightOfWay())
        if time < traffic.due - 1e-6:
            return
        pilots = [peer.pilots.get(world) for peer in self._peers()]
        present = [pilot for pilot in pilots if pilot is not None and pilot.makes_way]
        if len(present) > 1:
            traffic.update(time, present)

    # What it is made of -------------------------------------------------------------------

    def _pilot(self, world: int) -> WorldPilot:
        if world not in self.pilots:
            values = {**self._values, **with_outline(self._values, self._outline())}
            stack = navigation_stack(values)
            grid = None if self._source == "slam" else self._map()
            place = self._localizer(world)
            rules = RightOfWaySettings.read(values)
            self.pilots[world] = WorldPilot(
                stack, grid, self._height(), place, self._robot.name, rules
            )
        return self.pilots[world]

    def _localizer(self, world: int) -> Localizer | LiveMap | None:
        """Return the localizer of a world's robot; None for the true pose."""
        if self._source == "slam":
            return LiveMap(self._values.get("gmapping", {}), _LOST_SEED + world)
        if self._source == "truth":
            return None
        settings = AmclSettings.read(self._values.get("amcl", {}))
        localizer = Localizer(settings, self._map(), seed=_LOST_SEED + world)
        x, y, heading = self._robot.planar_pose()[world].tolist()
        localizer.begin((x, y, heading), np.diag([0.04, 0.04, 0.02]))
        return localizer

    def _outline(self) -> Floats | None:
        return outline_of(self._robot.description)

    def _height(self) -> float:
        """Return the height of the laser above the ground [m]."""
        unit = self._unit
        for link in self._robot.links.values():
            if unit.description in link.description.sensors:
                place = link.placement(np.array([0]))
                mount = np.array([unit.description.pose.position])
                return float((place.position + rotate(place.quaternion, mount))[0, 2])
        return 0.2

    def _map(self) -> OccupancyMap:
        if self._grid is None:
            self._grid = true_map(self._robot.simulation.world, self._height(), margin=2.0)
        return self._grid

    def _planar(self, scan: LaserScan, world: int) -> PlanarScan:
        """Return one world's scan: the middle row, if there are several."""
        rows = self._unit.model.rows
        ranges = np.array(scan.ranges[world].reshape(rows, -1)[rows // 2], np.float64)
        count = np.arange(len(ranges), dtype=np.float64)
        angles: Floats = np.asarray(scan.angle_min + scan.angle_increment * count, np.float64)
        return PlanarScan(ranges, angles, scan.range_max, scan.range_min, self._laser)

    def _listen(self) -> None:
        if self._sleep is None:
            self._sleep = self._unit.subscribe(self._receive_scan)

    def _receive_scan(self, unit: SensorUnit) -> None:
        self._scan = unit.reading(unit.current())

    def _disable_laser(self) -> None:
        """Disable the laser while there is no goal."""
        if self._sleep is not None:
            self._sleep()
            self._sleep = None
        self._scan = None

    def reset(self, worlds: Worlds | None) -> None:
        """Clear the goal and all but the map."""
        for world in [*self.pilots] if worlds is None else worlds.tolist():
            self.pilots.pop(world, None)
            self.traffic.pop(world, None)
        self._disable_laser()


class GoalTask:
    """An active goal of a robot.

    Args:
        robot: Robot with the goal.
        pilots: Of the worlds where it was sent.
    """

    def __init__(self, robot: Robot, pilots: list[WorldPilot]) -> None:
        self._robot, self.pilots = robot, pilots

    @property
    def done(self) -> bool:
        """True if it is reached or given up, in all of its worlds."""
        return not any(pilot.busy for pilot in self.pilots)

    @property
    def succeeded(self) -> bool:
        """True if it is reached in all of its worlds."""
        return all(pilot.outcome is GoalOutcome.SUCCEEDED for pilot in self.pilots)

    @property
    def text(self) -> str:
        """Status text of the first world that is done."""
        return next((pilot.text for pilot in self.pilots if pilot.text), "")

    def wait(self, seconds: float = 300.0) -> bool:
        """Run the simulation until it is done, or for so long [simulated s]; whether it succeeded."""
        simulation = self._robot.simulation
        end = simulation.time + seconds
        while not self.done and simulation.time < end:
            simulation.run(seconds=min(0.5, end - simulation.time))
        return self.succeeded
