"""Goals of ``gazelle bench env`` and ``gazelle bench stage``, and whether a run reached them."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Goals:
    """Figures of a run.

    Attributes:
        stage: Robot updates a second of Stage in this run, by robots and sensor.
        reached: Of each goal what it is, the figure, the bound, and whether it is reached.
    """

    stage: dict[tuple[int, str], float] = field(default_factory=dict)
    reached: list[tuple[str, str, str, bool]] = field(default_factory=list)

    def least(self, what: str, value: float, bound: float) -> None:
        """Check a figure that must not be lower."""
        self.reached.append((what, shown(value), f">= {shown(bound)}", value >= bound))

    def most(self, what: str, value: float, bound: float) -> None:
        """Check a figure that must not be higher."""
        self.reached.append((what, shown(value), f"<= {shown(bound)}", value <= bound))

    def show(self) -> None:
        """Print one line a goal."""
        if self.reached:
            print(f"\n{'goal':<46}{'here':>12}{'wanted':>14}{'met':>7}")
        for what, value, bound, good in self.reached:
            print(f"{what:<46}{value:>12}{bound:>14}{'yes' if good else 'NO':>7}")


def shown(value: float) -> str:
    """Return a value with three digits at least."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"
