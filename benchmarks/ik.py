"""Inverse kinematics: poses found, and the time of each, on four arms.

Poses are those of positions drawn within the limits; every search starts in the middle of them, and
ends at an error of 1e-5 m and rad. What takes more than the limit counts as not found. Times are of
the processor, so that others who work beside do not count. The figures of KDL and TRAC-IK are those
of TRAC-IK's README, with the same poses, errors and limit: on another machine.

    gazelle bench ik
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np

from gazelle.description import Pose
from gazelle.formats import load_model
from gazelle.kinematics import InverseKinematics, JointModelGroup, RobotModel

ARMS = {
    "fetch": ("torso_lift_link", "gripper_link", (92.5, 99.99)),
    "panda": ("panda_link0", "panda_tool", (61.8, 99.7)),
    "iiwa": ("iiwa_link0", "iiwa_tool", (37.6, 99.84)),
    "ur5": ("ur5_link0", "ur5_tool", None),
}
"""Base, tip, and the percentages of KDL and TRAC-IK."""


def measure(robot: RobotModel, group: JointModelGroup, count: int, limit: float) -> list[float]:
    """Return seconds of processor time of each pose, infinite without a solution in time."""
    full = np.tile(robot.zero(), (count, 1))
    full[:, group.columns] = group.sample(np.random.default_rng(0), count)
    poses = robot.forward(full, group.tip)
    middle = robot.zero()
    low, high = np.nan_to_num(group.lower, neginf=0.0), np.nan_to_num(group.upper, posinf=0.0)
    middle[group.columns] = (low + high) / 2.0
    solver = InverseKinematics(robot, group)
    spent = []
    for pose in poses:
        wanted = Pose.from_matrix(pose)
        start = time.process_time()
        found = solver.solve(wanted, middle)
        taken = time.process_time() - start
        spent.append(taken if found is not None and taken <= limit else np.inf)
    return spent


def main() -> None:
    """Measure all arms."""
    parser = argparse.ArgumentParser(prog="gazelle bench ik", description=__doc__)
    parser.add_argument("--poses", type=int, default=10_000, help="of each arm")
    parser.add_argument("--limit", type=float, default=0.005, help="seconds a pose")
    args = parser.parse_args()
    data = Path(__file__).parent.parent / "tests" / "data"
    print(f"{args.poses} reachable poses, error 1e-5, at most {args.limit * 1e3:g} ms each")
    print(f"{'arm':8}{'found %':>9}{'mean ms':>9}{'slowest ms':>12}{'KDL %':>8}{'TRAC-IK %':>11}")
    for name, (base, tip, others) in ARMS.items():
        robot = RobotModel(load_model(data / f"{name}_arm.urdf"))
        spent = np.array(measure(robot, robot.chain(base, tip), args.poses, args.limit))
        good = spent[np.isfinite(spent)]
        peers = "".join(f"{value:>10.4g}" for value in others or ())
        print(
            f"{name:8}{100.0 * len(good) / len(spent):>9.2f}{good.mean() * 1e3:>9.3f}"
            f"{good.max() * 1e3:>12.3f}{peers}"
        )


if __name__ == "__main__":
    main()
