"""A plugin of your own: drives a model with the velocity that comes on /<model>/cmd_vel.

A file names it:   <plugin name="drive" filename="drive_plugin:VelocityDrive"/>
and it is found:   gazelle run my.world --ros --plugins examples
"""

from gazelle.description import Parameters
from gazelle.rotations import rotate
from gazelle.simulation import ModelPlugin, Output, Placement, Robot, TwistInput


class VelocityDrive(ModelPlugin):
    """Sets the model's velocity at every step and publishes its pose at 30 Hz."""

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Open a port for commands and one for the pose."""
        self._robot, self._simulation = robot, robot.simulation
        self._period, self._next = 1.0 / parameters.get("updateRate", 30.0), 0.0
        self._command = TwistInput(self._simulation.nworld, f"/{robot.name}/cmd_vel")
        self._pose = Output(f"/{robot.name}/pose", Placement, robot.placement)
        robot.inputs["cmd_vel"], robot.outputs["pose"] = self._command, self._pose

    def on_update(self, time: float) -> None:
        """Move the model in its own axes."""
        turn = self._robot.quaternion
        self._robot.set_twist(rotate(turn, self._command.linear), self._command.angular)
        if time >= self._next:
            self._next = time + self._period
            self._pose.publish()

    def reset(self, worlds: object) -> None:  # noqa: ARG002  all worlds alike
        """Reset the command."""
        self._next = 0.0
