"""docs/reference/formats/check.md names every rule of `gazelle check`."""

import ast
import re
from pathlib import Path

import gazelle

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "formats" / "check.md"
PACKAGE = Path(gazelle.__file__).parent
RULE = re.compile(r"[a-z]+(-[a-z]+)*")


def literals_of(path):
    """Yield constants that a module gives findings as their rules."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            given = [each.value for each in node.keywords if each.arg == "rule"]
            given += node.args[:1] if name == "Diagnostic" else []
            yield from (each.value for each in given if isinstance(each, ast.Constant))


def rules_of_the_code():
    return {
        rule
        for folder in ("formats", "control")
        for path in (PACKAGE / folder).rglob("*.py")
        for rule in literals_of(path)
        if rule and RULE.fullmatch(rule)
    }


def rules_of_the_page():
    rows = re.findall(r"(?m)^\| (`.*?) \| .* \|$", PAGE.read_text(encoding="utf-8"))
    return {rule for row in rows for rule in re.findall(r"`([a-z-]+)`", row)}


def test_the_page_names_every_rule():
    rules = rules_of_the_code()
    assert len(rules) > 20
    assert rules - rules_of_the_page() == set()
