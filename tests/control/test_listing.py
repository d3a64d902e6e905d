"""Lists of controller types by `gazelle controllers` and the registry."""

from __future__ import annotations

from pathlib import Path

from gazelle.cli.main import main
from gazelle.control import registry, types

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "control.md"


def own_types():
    """Return the package's own types: other tests register theirs in the same process."""
    return [n for n in types() if registry._find(n).__module__.startswith("gazelle.")]


def test_each_type_says_what_it_is_for_and_is_listed(capsys):
    assert main(["controllers"]) == 0
    text = capsys.readouterr().out
    for name in own_types():
        assert name in text
        assert registry.purpose(name)
    assert registry.purpose("no/Such") == ""


def test_the_page_names_every_package_of_controllers():
    text = PAGE.read_text(encoding="utf-8")
    assert len(own_types()) > 20
    for name in own_types():
        package, _, kind = name.partition("/")
        assert package.removesuffix("controllers") in text, name
        assert kind in text or "Joint{" in text, name
