"""Tables of success rates in the docs are those of the data file."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from gazelle.errors import Error
from gazelle.training import published_claims

ROOT = Path(__file__).parents[1]


@pytest.fixture
def render(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import render_claims

    yield render_claims
    for name in ("render_claims", "_claim_table"):
        del sys.modules[name]


def test_each_page_says_what_the_data_says(render):
    pages = list(render.pages())
    assert ROOT / "docs" / "explanation" / "benchmarks.md" in pages
    for page in pages:
        text = page.read_text()
        assert render.rendered(text, published_claims()) == text, (
            f"{page.name} differs: python tools/render_claims.py"
        )


def test_each_published_claim_stands_on_a_page(render):
    shown = {
        train
        for page in render.pages()
        for found in render.BLOCK.finditer(page.read_text())
        for train in render.trainings(found["names"], published_claims())
    }
    assert shown == {claim.train for claim in published_claims().claims}


def test_another_result_changes_the_page(render):
    claims = published_claims()
    (claim,) = claims.of("KobukiEmpty")
    new = replace(claim.trials[0], seed=7, attempts=1000, success=512, commit="f" * 12)
    page = "a\n<!-- claims: KobukiEmpty -->\nold\n<!-- /claims -->\nb\n"
    text = render.rendered(page, claims.with_claim(replace(claim, trials=(new,))))
    assert text.startswith("a\n<!-- claims: KobukiEmpty -->\n| training")
    assert text.endswith("\n<!-- /claims -->\nb\n")
    assert "old" not in text
    assert "51.2 %" in text
    assert "one seed" in text
    assert "`ffffffffffff`" in text


def test_a_block_of_a_training_that_there_is_not_is_an_error(render):
    page = "<!-- claims: KobukiEmtpy -->\n<!-- /claims -->\n"
    with pytest.raises(Error, match="no claim is of 'KobukiEmtpy'") as caught:
        render.rendered(page, published_claims())
    assert "KobukiEmpty" in caught.value.hint
