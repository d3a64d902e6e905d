"""A plugin that starts late does the same, to the bit: its intervals are counted in nanoseconds."""

import numpy as np
import pytest
import scenes
from kobuki_model import kobuki
from models import GROUND, plugin
from test_builtin import ARM
from test_tricycle import tricycle

from gazelle import formats
from gazelle.simulation import Simulation

DAY = 86_400_000_000_000  # [ns]

CONTROLLER = plugin("libJointControlPlugin.so").replace(
    "</plugin>",
    """<controller type="position"><joint>elbow</joint><target>0.7</target>
    <pid_gains>50 20 10</pid_gains></controller></plugin>""",
)


def from_text(text):
    world = f'<sdf version="1.6"><world name="w">{GROUND}{text}</world></sdf>'
    return formats.load_string(world).models[-1]


MODELS = {
    "diff drive": lambda: scenes.burger(
        wheelAcceleration=0.7, odometrySource="encoder", updateRate=50
    ),
    "tricycle": lambda: from_text(tricycle(odometrySource="encoder", wheelAcceleration=0.7)),
    "kobuki": lambda: from_text(kobuki()),
    "joint control": lambda: from_text(ARM.format(plugin=CONTROLLER)),
}


def run(model, start_ns, step):
    """Return the state of a model and its plugins after a while."""
    with Simulation(scenes.world(scenes.ground(), step=step)) as sim:
        sim.clock.now_ns = start_ns
        robot = sim.spawn(model)
        if "cmd_vel" in robot.inputs:
            robot.inputs["cmd_vel"].send(linear=0.3, angular=0.4)
        sim.run(seconds=1.5)
        states = [dict(entry.plugin.state()) for entry in sim.plugins]
        return sim.engine.snapshot(), states


@pytest.mark.parametrize("step", [0.001, 0.02])
@pytest.mark.parametrize("kind", MODELS)
def test_what_starts_late_does_the_same_to_the_bit(kind, step):
    early, states = run(MODELS[kind](), 0, step)
    late, later = run(MODELS[kind](), 100 * DAY, step)
    np.testing.assert_array_equal(late, early)
    counts = ("last_time", "last_ns", "reckoned_ns", "time", "times")
    for before, after in zip(states, later, strict=True):
        for name, value in before.items():
            if name not in counts:
                np.testing.assert_array_equal(after[name], value, err_msg=name)
