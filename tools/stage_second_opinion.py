"""Print the table of docs/reference/stage.md that compares Gazelle with Stage 4.3 itself, scene by scene.

Needs Stage: a program 'stage' on PATH, or given as the argument, and g++ for stage_probe.cc.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "tools")]


def main() -> None:
    """Print one row a measure."""
    from _stage_itself import find
    from stage_scenes import SCENES

    stage = find(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
    if stage is None or stage.plugins is None:
        raise SystemExit("this needs Stage 4.3, its header, and g++")
    rows = ["| scene | compared | how many | apart | at most | why |", "|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            rows += ["| " + " | ".join(row) + " |" for row in scene(stage, Path(folder))]
    print("\n".join(rows))


if __name__ == "__main__":
    main()
