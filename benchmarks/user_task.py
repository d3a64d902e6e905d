"""A task and a drive as a user writes them, from the docs: a cart that drives on without a crash."""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import formats
from gazelle.envs import BatchedTask, TaskOutcome, TaskVectorEnv
from gazelle.simulation import ModelPlugin, TwistInput, register

BOX = "<{0} name='{0}'><pose>{1}</pose><geometry><box><size>{2}</size></box></geometry></{0}>"
WALLS = ("2.5 0 .5 0 0 0", ".1 5 1"), ("-2.5 0 .5 0 0 0", ".1 5 1"), ("0 2.5 .5 0 0 0", "5 .1 1"), (
    "0 -2.5 .5 0 0 0", "5 .1 1"), ("1 1 .5 0 0 0", ".3 .3 1"), ("-1 1 .5 0 0 0", ".3 .3 1")  # fmt: skip
GROUND = """<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>"""
BUILT = "".join(
    f"<model name='wall{i}'><static>1</static><link name='l'>{BOX.format('collision', *wall)}</link></model>"
    for i, wall in enumerate(WALLS)
)
WORLD = f"<sdf version='1.7'><world name='hall'>{GROUND}{BUILT}</world></sdf>"
WHEEL = """<link name='{0}'><pose>0 {1} .05 -1.5708 0 0</pose><collision name='c'><geometry><cylinder>
<radius>.05</radius><length>.02</length></cylinder></geometry></collision></link><joint name='{0}_joint'
type='revolute'><parent>base</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
CASTER = """<collision name='{0}'><pose>{1} 0 -.05 0 0 0</pose><geometry><sphere><radius>.05</radius></sphere></geometry>
<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>"""
CART = f"""<sdf version='1.7'><model name='cart'><link name='base'><pose>0 0 .1 0 0 0</pose>
{BOX.format("collision", "0 0 .02 0 0 0", ".3 .2 .1")}{CASTER.format("front", 0.1)}{CASTER.format("back", -0.1)}<sensor name='eyes' type='ray'><pose>0 0 .1 0 0 0</pose><ray><scan><horizontal>
<samples>24</samples><min_angle>-3.14159</min_angle><max_angle>2.87979</max_angle></horizontal></scan>
<range><min>.05</min><max>4</max></range><noise><type>gaussian</type><stddev>.01</stddev></noise></ray></sensor>
</link>{WHEEL.format("left", 0.12)}{WHEEL.format("right", -0.12)}
<plugin name='drive' filename='libcart_drive.so'/></model></sdf>"""


class CartDrive(ModelPlugin):
    """Two wheels that gain 0.05 m/s in an update at most."""

    def load(self, robot, parameters):  # noqa: ARG002  it needs none
        self.update_rate = 10.0
        self.wheels = [robot.joints["left_joint"], robot.joints["right_joint"]]
        for wheel in self.wheels:
            wheel.add_motor(0.3)
        self.command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, "/cmd_vel")
        self.speeds = np.zeros((robot.simulation.nworld, 2))

    def on_update(self, time):  # noqa: ARG002  what is commanded now is done now
        turning = self.command.angular[:, 2] * 0.12
        wanted = np.stack(
            (self.command.linear[:, 0] - turning, self.command.linear[:, 0] + turning), 1
        )
        self.speeds += np.clip(wanted - self.speeds, -0.05, 0.05)
        for wheel, speed in zip(self.wheels, self.speeds.T, strict=True):
            wheel.drive(speed / 0.05)

    def reset(self, worlds):
        self.speeds[slice(None) if worlds is None else worlds] = 0.0


class Cruise(BatchedTask):
    """Reward 1 a step; the episode ends where anything is nearer than 0.25 m."""

    observation_space = gym.spaces.Box(0.0, 4.0, (24,), np.float32)
    action_space, control_period = gym.spaces.Box(-1.0, 1.0, (2,), np.float32), 0.2

    def __init__(self, nworld, engine="planar", max_episode_steps=500):
        super().__init__(nworld, max_episode_steps)
        register("libcart_drive.so", CartDrive)
        self.sim = gazelle.Simulation(
            formats.load_string(WORLD), engine, nworld=nworld, time_step=0.02
        )
        self.cart = self.sim.spawn(formats.load_string(CART).models[0])

    def _see(self, worlds):
        return np.clip(self.cart.sensors["eyes"].measure(worlds), 0.0, 4.0).astype(np.float32)

    def _seed(self, seed):
        self.sim.reset(seed=seed)

    def _begin(self, worlds):
        self.sim.reset(worlds)

    def _look(self, worlds):
        return self._see(worlds), {}

    def _act(self, actions):
        self.cart.inputs["cmd_vel"].send(0.15 + 0.15 * actions[:, 0], 1.5 * actions[:, 1])
        self.sim.run(self.control_period)
        ranges = self._see(None)
        return TaskOutcome(ranges, np.ones(self.nworld), ranges.min(axis=1) < 0.25, {})

    def _state(self):
        return {"simulation": self.sim.snapshot()}

    def _set_state(self, state):
        self.sim.restore(bytes(state["simulation"]))

    def render(self, world):  # noqa: ARG002  there is nothing to see
        return np.zeros((1, 1, 3), np.uint8)

    def close(self):
        self.sim.close()


def make(num_envs, engine="planar"):
    """Return the task as a Gymnasium vector environment."""
    return TaskVectorEnv(Cruise(num_envs, engine))
