"""Episodes that failed, as a file: a table, JSON, or a picture of where they did."""

from __future__ import annotations

import argparse
import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.writing import replacing, write_text

if TYPE_CHECKING:
    from gazelle.training import Evaluation

_FORMS = (".csv", ".json", ".png")


def failures_file(text: str) -> Path:
    """Return the file of ``--failures``; its suffix is the format."""
    file = Path(text)
    if file.suffix.lower() not in _FORMS:
        raise argparse.ArgumentTypeError(f"expected a file that ends in {', '.join(_FORMS)}")
    if not file.absolute().parent.is_dir():
        raise argparse.ArgumentTypeError(f"there is no folder {file.parent}")
    return file


def save_failures(evaluation: Evaluation, file: Path) -> None:
    """Write the episodes that failed.

    Raises:
        TaskError: A picture is requested, and the task reports no places.
        OSError: The file cannot be written.
    """
    if file.suffix.lower() == ".png":
        from gazelle.viewer.failures import draw_failures
        from gazelle.viewer.film_files import write_picture

        write_picture(file, draw_failures(evaluation))
        return
    rows = [record.to_row() for record in evaluation.failures]
    if file.suffix.lower() == ".json":
        about = evaluation.to_dict() | {"goals": _by_goal(evaluation), "failures": rows}
        write_text(file, json.dumps(about, indent=2) + "\n")
        return
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with replacing(file) as draft, draft.open("w", newline="", encoding="utf-8") as table:
        writer = csv.DictWriter(table, columns or ["outcome"], restval="")
        writer.writeheader()
        writer.writerows(rows)


def _by_goal(found: Evaluation) -> list[dict[str, Any]]:
    """Return the outcomes of the last attempts at each goal, the worst goals first."""
    goals: dict[tuple[float, ...], dict[str, int]] = {}
    for record in found.records:
        goal = record.info.get("goal")
        if goal is not None and (record.failed or record.goals == 1):
            counts = goals.setdefault(goal, {"tried": 0, "failed": 0})
            counts["tried"] += 1
            counts["failed"] += record.failed
    worst = sorted(goals.items(), key=lambda item: (-item[1]["failed"], item[0]))
    return [{"goal": list(goal), **counts} for goal, counts in worst]
