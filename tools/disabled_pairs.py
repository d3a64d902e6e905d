"""Pairs of links that a robot's SRDF need not check, with reasons: lines for the file.

Links that a joint holds together, those that touch with all joints at zero, those that touch in nearly every
state that is drawn, and those that never touch in any: as MoveIt's setup assistant has it.

    python tools/disabled_pairs.py robot.urdf [--states 10000]
"""

from __future__ import annotations

import argparse
from collections import Counter
from itertools import combinations

import numpy as np

from gazelle.formats import load_model
from gazelle.kinematics import RobotModel
from gazelle.planning import AllowedCollisionMatrix, PlanningScene
from gazelle.planning.robot_bodies import shapes_of

ALWAYS = 0.95


def touching(scene: PlanningScene, state: np.ndarray) -> set[tuple[str, str]]:
    """Return pairs that touch, names in alphabetic order."""
    found = scene.contacts(state)
    return {(min(e.first, e.second), max(e.first, e.second)) for e in found}


def main() -> None:
    """Print the lines."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("urdf")
    parser.add_argument("--states", type=int, default=10_000)
    args = parser.parse_args()
    robot = RobotModel(load_model(args.urdf))
    scene = PlanningScene(robot)
    scene.allowed = AllowedCollisionMatrix()  # everything is looked at
    shapes = [name for name, found in shapes_of(robot).items() if found]
    held = {joint.child: joint.parent for joint in robot.model.joints}
    held |= {frame.name: frame.attached_to for frame in robot.model.frames}
    near = touching(scene, robot.zero())
    random, low_high = np.random.default_rng(0), robot.limits()
    low = np.where(np.isfinite(low_high[0]), low_high[0], -np.pi)
    high = np.where(np.isfinite(low_high[1]), low_high[1], np.pi)
    seen: Counter[tuple[str, str]] = Counter()
    for state in random.uniform(low, high, (args.states, len(low))):
        seen.update(touching(scene, state))
    for first, second in combinations(sorted(shapes), 2):
        count = seen[(first, second)]
        if second == held.get(first) or first == held.get(second):
            reason = "Adjacent"
        elif (first, second) in near:
            reason = "Default"
        elif count >= ALWAYS * args.states:
            reason = "Always"
        elif count == 0:
            reason = "Never"
        else:
            continue
        print(f'  <disable_collisions link1="{first}" link2="{second}" reason="{reason}"/>')


if __name__ == "__main__":
    main()
