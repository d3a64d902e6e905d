"""Put the published success rates into the docs.

A page has a block for each table, which names trainings as they stand behind ``gazelle train``:

    <!-- claims: KobukiEmpty; TurtleBot3Stage1 --algo dqn -->
    (this is replaced)
    <!-- /claims -->

``claims, all goals:`` also lists goals in a row and published goals, and how attempts failed.
Without arguments all pages are rewritten; ``--check`` only reports which differ.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle.errors import Error, did_you_mean
from gazelle.training.claims import HELD_OUT, Claim, Claims, read_claims

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))

from _claim_table import table  # noqa: E402  # lies beside the benchmarks

BLOCK = re.compile(
    r"(?ms)^(?P<head><!-- claims(?P<all>, all goals)?: (?P<names>[^>]*?) -->\n)"
    r".*?^(?P<end><!-- /claims -->)$"
)


def main() -> None:
    """Rewrite the pages, or report those that differ."""
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        raise SystemExit(__doc__)
    claims = read_claims()
    different = []
    for page in pages():
        text = page.read_text(encoding="utf-8")
        new = rendered(text, claims)
        if new != text:
            different.append(str(page.relative_to(ROOT)))
            if not check:
                page.write_text(new, encoding="utf-8")
    if different:
        print(f"{'differ' if check else 'rewritten'}: {' '.join(different)}")
    raise SystemExit(1 if check and different else 0)


def pages() -> Iterator[Path]:
    """Yield the pages that have a block."""
    for page in sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]):
        if BLOCK.search(page.read_text(encoding="utf-8")):
            yield page


def rendered(text: str, claims: Claims) -> str:
    """Return a page with its blocks as the data has them."""

    def block(found: re.Match[str]) -> str:
        long = found["all"] is not None
        rows = claims_of(trainings(found["names"], claims), claims, long=long)
        return f"{found['head']}{table(rows, long=long)}{found['end']}"

    return BLOCK.sub(block, text)


def trainings(names: str, claims: Claims) -> list[str]:
    """Return the commands of trainings that a block names."""
    known = {claim.train.removeprefix("gazelle train "): claim.train for claim in claims.claims}
    wanted = [name.strip() for name in names.split(";")]
    for name in wanted:
        if name not in known:
            raise Error(f"no claim is of '{name}'", hint=did_you_mean(name, known))
    return [known[name] for name in wanted]


def claims_of(commands: Sequence[str], claims: Claims, *, long: bool) -> list[Claim]:
    """Return the claims of trainings, in their order."""
    return [
        claim
        for command in commands
        for claim in claims.claims
        if claim.train == command and (long or claim.goals == HELD_OUT)
    ]


if __name__ == "__main__":
    main()
