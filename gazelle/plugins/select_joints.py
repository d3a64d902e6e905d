"""ros_control for some of a robot's joints: what ``libgazebo_ros_control_select_joints.so`` does.

Tags and rules are those of tu-darmstadt's package of that name (Noetic), which are gazebo_ros_control's
beside ``<joints>``.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence

from gazelle.description import Model, Transmission
from gazelle.errors import ControlWarning, did_you_mean, located
from gazelle.plugins.ros_control import RosControl


class SelectedRosControl(RosControl):
    """Controllers for the joints in ``<joints>`` that have transmissions.

    Without ``<joints>`` it is all of them, as with `RosControl`. Others of these plugins may control the
    rest, each in a namespace of its own.
    """

    def transmissions_of(self, model: Model) -> Sequence[Transmission]:
        """Return the transmissions of named joints."""
        if "joints" not in self._parameters:
            return model.transmissions
        names = self._parameters.get("joints", "").split()
        joints = {each.joints[0][0]: each for each in model.transmissions if each.joints}
        for name in names:
            if name not in joints:
                text = (
                    f"<joints> names '{name}', which has no transmission and is not controlled; "
                    f"{did_you_mean(name, joints)}"
                )
                warnings.warn(ControlWarning(located(text, self._parameters.source)), stacklevel=4)
        return [each for each in model.transmissions if each.joints and each.joints[0][0] in names]
