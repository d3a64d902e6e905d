"""Print the table of docs/explanation/accuracy.md that compares the engine with Bullet, scene by scene.

Needs Bullet: pip install 'gazelle[oracle]'.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

STEPS = (0.001, 0.00025)


def main() -> None:
    """Print one row a measure."""
    from second_engine.comparing import compare
    from second_engine.ten_scenes import SCENES

    rows = ["| scene | compared | moves by | apart at 1 ms | at 0.25 ms | why |"]
    rows.append("|---|---|---|---|---|---|")
    for scene in SCENES:
        coarse, fine = (compare(scene, step) for step in STEPS)
        for measure, first, second in zip(scene.measures, coarse, fine, strict=True):
            figures = (first.moved, first.difference, second.difference)
            shown = " | ".join(f"{rounded(figure)} {measure.unit}" for figure in figures)
            rows.append(f"| {scene.name} | {measure.name} | {shown} | {measure.why} |")
    print("\n".join(rows))


def rounded(figure: float) -> str:
    """Return a figure with two digits; nothing below a millionth."""
    if figure < 1e-6:
        return "< 1e-6"
    return f"{figure:.0f}" if figure >= 10.0 else f"{figure:.2g}"


if __name__ == "__main__":
    main()
