"""The simulation that a TurtleBot3 task runs in."""

from __future__ import annotations

from gazelle import assets, formats
from gazelle.description import Model, Pose, World
from gazelle.envs.lidars import FittedLidar, fit_lidar
from gazelle.envs.options import NavigationSettings
from gazelle.envs.turtlebot3.rules import Rules
from gazelle.errors import SimulationError, TaskError
from gazelle.simulation import Robot, Simulation

ROBOT = "turtlebot3_burger"
COMMAND = "cmd_vel"


class TaskScene:
    """World and robot, loaded once and run with any seed.

    Args:
        rules: Of the stage.
        settings: Options of the user.
        nworld: Number of worlds.

    Attributes:
        simulation: Simulation.
        robot: The robot in it.
        lidar: Its lidar, as fitted to the task.

    Raises:
        FormatError: A file cannot be read.
        TaskError: The robot does not fit the task.
    """

    simulation: Simulation
    robot: Robot
    _beginning: bytes

    def __init__(self, rules: Rules, settings: NavigationSettings, nworld: int) -> None:
        self._settings = settings
        self._nworld = nworld
        self._start = Pose(*rules.start)
        self._time_step = settings.time_step or rules.time_step
        _check_time_step(self._time_step, rules.control_period)
        self._world = _load_world(settings.world or rules.world)
        self.lidar = _fit(settings)
        self._run(settings.seed or 0)

    def restart(self, seed: int) -> None:
        """Start everything over, as if the scene had just been made with this seed."""
        try:
            self.simulation.restore(self._beginning)
        except SimulationError:  # models came or went meanwhile
            self.simulation.close()
            self._run(seed)
        if seed != self.simulation.seed:
            self.simulation.reset(seed=seed)
            self._beginning = self.simulation.snapshot()

    def _run(self, seed: int) -> None:
        settings = self._settings
        self.simulation = Simulation(
            self._world,
            engine=settings.engine,
            nworld=self._nworld,
            seed=seed,
            threads=settings.threads,
            time_step=self._time_step,
        )
        self.robot = self.simulation.spawn(self.lidar.model, name=ROBOT, pose=self._start)
        if COMMAND not in self.robot.inputs:
            self.simulation.close()
            raise TaskError(
                f"the robot '{self.lidar.model.name}' has no input '{COMMAND}'",
                source=self.lidar.model.source,
                hint="its file needs a drive plugin, such as libgazebo_ros_diff_drive.so",
            )
        self._beginning = self.simulation.snapshot()


def _load_world(world: object) -> World:
    if isinstance(world, World):
        return world
    # a task always takes its own files, whatever the environment has under their names
    return formats.load(assets.worlds().get(str(world), str(world)))


def _fit(settings: NavigationSettings) -> FittedLidar:
    """Return the robot with its lidar fitted; without a notice for a bundled one."""
    robot = settings.robot or ROBOT
    if isinstance(robot, Model):
        model = robot
    else:
        model = formats.load_model(assets.robots().get(str(robot), str(robot)))
    return fit_lidar(model, settings.lidar_samples, notice=not _is_bundled_name(robot))


def _is_bundled_name(robot: object) -> bool:
    return isinstance(robot, str) and robot.isidentifier()


def _check_time_step(time_step: float, control_period: float) -> None:
    steps = round(control_period / time_step)
    if steps < 1 or abs(steps * time_step - control_period) > 1e-9:
        raise TaskError(
            f"time_step must divide the control period of {control_period} s, "
            f"and {time_step} does not"
        )
