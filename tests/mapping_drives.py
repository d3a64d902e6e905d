"""Drives through simulated worlds, and maps made meanwhile."""

import math

import numpy as np

import gazelle
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle.navigation.planners.planar import between, composed
from gazelle.navigation.true_map import true_map
from gazelle.rotations import yaw_of

# As in turtlebot3_slam's file, but for fewer particles.
SETTINGS = {
    "maxUrange": 3.0, "sigma": 0.05, "lsigma": 0.075, "minimumScore": 50, "linearUpdate": 1.0,
    "angularUpdate": 0.2, "temporalUpdate": 0.5, "particles": 4, "xmin": -10, "ymin": -10, "xmax": 10, "ymax": 10,
}  # fmt: skip
WORLD = [(-1.5, -0.5), (-0.55, -1.75), (0.55, -1.75), (1.7, -0.5), (0.55, 0.55), (1.7, 0.5), (0.5, 1.75),
         (-0.5, 1.75), (-0.55, 0.55), (-1.7, 0.5)]  # fmt: skip


def drive(world, start, goals, take):
    """Drive to goals one after another; `take` gets each scan with odometry and the truth."""
    with gazelle.Simulation(world, engine="planar", seed=0) as sim:
        robot = sim.spawn("turtlebot3_burger", pose=gazelle.Pose(*start))
        sensor, stamp = robot.sensors["lds_lfcd_sensor"], -1
        for goal in goals:
            task, end = robot.navigation.go_to(*goal), sim.time + 90.0
            while not task.done and sim.time < end:
                sim.run(seconds=0.1)
                scan = sensor.read()
                if scan.stamp != stamp:
                    stamp, odom = scan.stamp, robot.outputs["odom"].last
                    x, y = odom.position[0, :2].tolist()
                    place = x, y, float(yaw_of(odom.quaternion)[0])
                    take(scan, place, (robot.pose.x, robot.pose.y, robot.pose.yaw))
        return true_map(sim.world, 0.18, margin=2.0)


class Mapper:
    """A `GridSlam` whose odometry slips by a share."""

    def __init__(self, slip, laser=(-0.032, 0.0, 0.0)):
        self.slam = GridSlam(GmappingSettings.read(SETTINGS), seed=3)
        self._slip, self._laser = slip, laser
        self._random = np.random.default_rng(5)
        self._last = self._odom = None
        self.errors = []
        # The same scans at true poses: what of the walls any map of this drive can show.
        self.ideal = GridSlam(GmappingSettings.read({**SETTINGS, "particles": 1}))

    def take(self, scan, odom, true):
        if self._last is None:
            self._odom = odom
        else:
            x, y, turn = between(self._last, odom)
            share = 1.0 + self._slip * self._random.normal(1.0, 1.0)
            turned = turn * (1.0 + self._slip * self._random.normal(1.0, 1.0))
            self._odom = composed(self._odom, (x * share, y * share, turned))
        self._last = odom
        ranges = np.array(scan.ranges, np.float64).reshape(-1)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        if self.slam.update(
            scan.stamp / 1e9, self._odom, ranges, angles, scan.range_max, self._laser
        ):
            seen = np.isfinite(ranges) & (ranges < scan.range_max)
            turned, far = angles[seen], ranges[seen]
            beams = np.stack((far * np.cos(turned), far * np.sin(turned)), axis=1)
            eye = np.array(composed(true, self._laser))
            self.ideal._maps.register(0, eye, beams, SETTINGS["maxUrange"])
            at = composed(self.slam.map_to_odom, self._odom)
            off = math.remainder(at[2] - true[2], 2 * math.pi)
            self.errors.append((math.dist(at[:2], true[:2]), abs(off)))
