"""Write what Stage 4.3 says of a few worlds to tests/data/stage_answers.json.

Needs Stage: a program 'stage' on PATH, or given as the argument, and g++ for stage_probe.cc.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "tools")]

AT = (1, 20, 60)  # steps after which poses count
HEIGHTS = ((0.0, 0.3, 0.3, 1.0), (0.0, 0.3, 0.0, 0.0), (0.0, 0.3, 0.31, 1.0), (0.2, 0.1, 0.0, 0.1))

NESTED = (
    "model ( pose [.4 0 0 30] size [.3 .2 .2] )",
    "model ( pose [.4 0 0 30] size [.3 .2 .2] obstacle_return 0 )",
    "model ( pose [.4 0 -.2 9] size [.3 .2 .2] model ( pose [.3 .1 0 0] size [.1 .4 .1] ) )",
    "obstacle_return 0 model ( pose [.4 0 0 30] size [.3 .2 .2] )",
    "origin [.2 .1 0 30]",
    "noblocks 1",
    (
        "block ( points 4 point[0] [0 0] point[1] [3 0] point[2] [3 1] point[3] [0 2] z [0 1] )"
        " block ( points 3 point[0] [4 0] point[1] [5 0] point[2] [4 1] z [0 .5] )"
    ),
    "gripper ( pose [.3 0 -.3 0] )",
    "position ( pose [.5 0 -.3 0] size [.3 .4 .3] )",
)


def main() -> None:
    """Run all of them."""
    from _stage_itself import find
    from stage_scenes import HEAD, both

    stage = find(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
    if stage is None or stage.plugins is None:
        raise SystemExit("this needs Stage 4.3, its header, and g++")
    answers = []
    with tempfile.TemporaryDirectory() as home:
        for name, robots, more in scenes():
            heard = both(stage, Path(home), robots, more)
            seen = heard.senses
            answers.append(
                {
                    "name": name,
                    "world": HEAD + more,
                    "robots": [[robot.text, robot.pose, robot.command] for robot in robots],
                    "poses": {
                        robot: np.round(rows[[step - 1 for step in AT]], 8).tolist()
                        for robot, rows in sorted(heard.poses.items())
                    },
                    "fiducials": {r: v for (kind, r), v in seen.items() if kind == "fiducial"},
                    "bumps": {r: v[0] for (kind, r), v in seen.items() if kind == "bumps"},
                }
            )
    file = ROOT / "tests" / "data" / "stage_answers.json"
    text = json.dumps({"at": AT, "scenes": answers}, indent=None, separators=(",", ":"))
    file.write_text(text.replace('{"name"', '\n{"name"') + "\n", encoding="utf-8")


def scenes() -> Iterator[tuple[str, list[Any], str]]:
    """Yield name, robots, and other contents."""
    from stage_scenes import BASES, SIDES, Robot, anywhere, crowd

    for kind, bases in BASES.items():
        exact = ' localization "odom" odom_error [.1 0 0 5]'
        robots = [
            Robot(text + exact, (20.0 * i, 3.0, 35.0 * i), command)
            for i, (text, command) in enumerate(bases)
        ]
        yield kind, robots, ""
    robots, more = [], []
    for i, (low, high, bottom, height) in enumerate(HEIGHTS):
        more.append(f"model ( size [1 1 {height}] pose [1.03 {3 * i} {bottom} 0] )")
        text = f"size [.4 .4 {high}] origin [0 0 {low} 0]"
        robots.append(Robot(text, (0.0, 3.0 * i, 0.0), (0.5, 0.0, 0.0)))
    yield "heights", robots, "\n".join(more)
    robots, more = [], []
    for i, text in enumerate(NESTED):
        more.append(f"model ( size [.3 4 1] pose [1.93 {12 * i} 0 0] )")
        robots.append(Robot(f"size [.4 .4 .3] {text}", (0.0, 12.0 * i, 3.0), (0.5, 0.0, 0.02)))
    yield "bodies on bodies", robots, "\n".join(more)
    for i, kind in enumerate(("", "range_max 4 range_max_id 2", "fov 60", "range_min 3")):
        rng = np.random.default_rng(30 + i)
        yield f"fiducials {kind}", [anywhere(rng, f"fiducial ( {kind} )")], crowd(i)
    strips = " ".join(f"bpose[{i}] [{x} {y} 0 {90 * i}]" for i, (x, y) in enumerate(SIDES))
    robots, more = [], []
    for i, gap in enumerate((0.001, 0.004, 0.035, 0.06)):
        device = f"bumper ( bcount 4 blength .3 {strips} )"
        more.append(f'model ( name "w{i}" size [1 1 1] pose [{5.73 + gap:.3f} {3 * i} 0 0] )')
        robots.append(Robot(f"size [.4 .4 .3] {device}", (5.01, 3.0 * i, 90.0 * i)))
    yield "bumpers", robots, "\n".join(more)


if __name__ == "__main__":
    main()
