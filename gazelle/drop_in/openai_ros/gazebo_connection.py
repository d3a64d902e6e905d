"""The simulator as openai_ros sees it: pause, unpause, reset, gravity."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from gazelle.clients.errors import ClientError
from gazelle.clients.gazebo import Gazebo
from gazelle.errors import TaskError, did_you_mean
from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.state import process

SIMULATION: Final = "SIMULATION"
WORLD: Final = "WORLD"
NO_RESET_SIM: Final = "NO_RESET_SIM"
_MODES = (SIMULATION, WORLD, NO_RESET_SIM)


class GazeboConnection:
    """Calls the services of Gazebo, Gazelle's or a real one's.

    It puts the world back and pauses it when it is made.

    Args:
        start_init_physics_parameters: Set the physics that openai_ros begins with.
        reset_world_or_sim: Effect of `resetSim`: ``SIMULATION`` resets everything and the time,
            ``WORLD`` the models only, ``NO_RESET_SIM`` nothing.
        max_retry: Number of retries of an interrupted call.

    Raises:
        TaskError: There is no such kind of reset.
        ClientError: No simulator answers within 30 s.
    """

    def __init__(
        self,
        start_init_physics_parameters: bool = True,  # noqa: FBT001, FBT002  # openai_ros' interface
        reset_world_or_sim: str = SIMULATION,
        max_retry: int = 20,
    ) -> None:
        if reset_world_or_sim not in _MODES:
            hint = did_you_mean(reset_world_or_sim, _MODES)
            raise TaskError(f"there is no reset '{reset_world_or_sim}'", hint=hint)
        self.start_init_physics_parameters = start_init_physics_parameters
        self.reset_world_or_sim = reset_world_or_sim
        self._gazebo = Gazebo(process.require(), retries=max_retry)
        self.init_values()
        self.pauseSim()

    def pauseSim(self) -> None:  # noqa: N802  # openai_ros' names, here and below
        """Pause the simulation."""
        self._answered(self._gazebo.pause)

    def unpauseSim(self) -> None:  # noqa: N802
        """Unpause the simulation."""
        self._answered(self._gazebo.unpause)

    def resetSim(self) -> None:  # noqa: N802
        """Reset by ``reset_world_or_sim``."""
        if self.reset_world_or_sim == SIMULATION:
            self.resetSimulation()
        elif self.reset_world_or_sim == WORLD:
            self.resetWorld()

    def resetSimulation(self) -> None:  # noqa: N802
        """Reset everything, time too."""
        self._answered(self._gazebo.reset_simulation)

    def resetWorld(self) -> None:  # noqa: N802
        """Reset the models; time continues."""
        self._answered(self._gazebo.reset_world)

    @staticmethod
    def _answered(call: Callable[[], None]) -> None:
        """Call; at the end of the script, the end is what went wrong."""
        try:
            call()
        except ClientError:
            if rospy.is_shutdown():
                raise rospy.ROSInterruptException("ROS shutdown request") from None
            raise

    def init_values(self) -> None:
        """Reset the simulation, and set the physics on request."""
        self.resetSim()
        if self.start_init_physics_parameters:
            rospy.logdebug("the physics of openai_ros is set")
            self.init_physics_parameters()

    def init_physics_parameters(self) -> None:
        """Set steps of 1 ms, 9.81 m/s² down, and ODE's settings of openai_ros.

        The pace is 1,000 steps a second, as there, unless the simulator is faster already: a world
        that runs as fast as possible continues doing so.
        """
        rate = self._gazebo.physics.max_update_rate
        self._gazebo.set_physics(
            time_step=0.001,
            max_update_rate=max(rate, 1000.0) if rate else rate,
            gravity=(0.0, 0.0, -9.81),
            auto_disable_bodies=False,
            sor_pgs_precon_iters=0,
            sor_pgs_iters=50,
            sor_pgs_w=1.3,
            sor_pgs_rms_error_tol=0.0,
            contact_surface_layer=0.001,
            contact_max_correcting_vel=0.0,
            cfm=0.0,
            erp=0.2,
            max_contacts=20,
        )

    def change_gravity(self, x: float, y: float, z: float) -> None:
        """Set gravity [m/s²]."""
        self.pauseSim()
        self._gazebo.gravity = (x, y, z)
        self.unpauseSim()

    def update_gravity_call(self) -> None:
        """Set the physics again; the world stands still meanwhile, and runs then."""
        self.pauseSim()
        self._gazebo.set_physics()
        self.unpauseSim()
