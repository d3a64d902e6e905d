"""The controllers of a robot as openai_ros sees them: switched off and on again between episodes."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.clients.controllers import Controllers
from gazelle.clients.errors import ClientError
from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.state import process

_STRICT = 2


class ControllersConnection:
    """Calls a robot's ``controller_manager``.

    Args:
        namespace: Of the robot, without slashes; empty for none.
        controllers_list: The controllers that `reset_controllers` starts again.
    """

    def __init__(self, namespace: str, controllers_list: Sequence[str] = ()) -> None:
        self.controllers_list = list(controllers_list)
        space = namespace.strip("/")
        self.switch_service_name = (
            f"{'/' + space if space else ''}/controller_manager/switch_controller"
        )
        self._controllers = Controllers(process.require(), space)

    def switch_controllers(
        self,
        controllers_on: Sequence[str],
        controllers_off: Sequence[str],
        strictness: int = 1,
    ) -> bool:
        """Start some and stop others at one moment.

        Args:
            controllers_on: Those to start.
            controllers_off: Those to stop.
            strictness: 1 to do what can be done, 2 for all or nothing.

        Returns:
            Whether it was done; why not is in the log.
        """
        try:
            self._controllers.switch(controllers_on, controllers_off, strict=strictness == _STRICT)
        except ClientError as error:
            rospy.logerr(f"the controllers are not switched: {error}")
            return False
        return True

    def reset_controllers(self) -> bool:
        """Stop all of the list, then start them again; returns whether both was done."""
        stopped = self.switch_controllers([], self.controllers_list)
        return stopped and self.switch_controllers(self.controllers_list, [])

    def wait_running(self, timeout: float) -> None:
        """Wait until all of the list run, as after their launch.

        Raises:
            ClientError: It takes longer than ``timeout`` [s of wall time].
        """
        self._controllers.wait_for(self.controllers_list, timeout=timeout)

    def update_controllers_list(self, new_controllers_list: Sequence[str]) -> None:
        """Reset other controllers from now on."""
        self.controllers_list = list(new_controllers_list)
