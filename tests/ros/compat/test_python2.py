"""Scripts written for Python 2: one line says what to change."""

import pytest

from gazelle_ros.compat.python2 import advice_text, explain


def error_of(source):
    try:
        exec(compile(source, "s.py", "exec"), {})  # the sources below
    except Exception as error:  # noqa: BLE001  # whatever it is
        return error
    return None


@pytest.mark.parametrize(
    ("source", "line", "advice"),
    [
        ('x = 1\nprint "a", x\n', 2, 'write print("a", x)'),
        ("print 'a' % 3,  # comment\n", 1, "write print('a' % 3)"),
        ("try:\n  pass\nexcept ValueError, e:\n  pass\n", 3, "write 'except Error as name:'"),
        ("try:\n  pass\nexcept (ValueError, KeyError), e:\n  pass\n", 3, "(Errors) as name"),
        ("raise ValueError, 'no'\n", 1, "write 'raise Error(text)'"),
        ("exec 'x = 1'\n", 1, "exec is a function"),
        ("if 1 <> 2: pass\n", 1, "write != for <>"),
        ("x = 0777\n", 1, "0o"),
        ("x = 10L\n", 1, "leave out the L"),
        ("if 1:\n\tx = 1\n        y = 2\n", 3, "spaces only"),
        ("import Queue\n", 1, "the module Queue is called queue"),
        ("from itertools import izip\n", 1, "write zip for izip"),
        ("def f():\n  return xrange(3)\nf()\n", 2, "write range for xrange"),
        ("raw_input()\n", 1, "write input for raw_input"),
        ("{}.has_key(1)\n", 1, "write 'key in mapping' for has_key()"),
        ("for k in {}.iteritems(): pass\n", 1, "write items() for iteritems()"),
    ],
)
def test_what_changed_is_named_with_its_line(source, line, advice):
    findings = explain(error_of(source), source)
    assert findings[0].line == line
    assert advice in findings[0].advice


def test_all_that_is_to_change_is_named_but_not_without_end():
    source = "\n".join(f"print {number}" for number in range(9))
    text = advice_text(explain(error_of(source), source))
    assert text.startswith("write print(0), line 2: write print(1)")
    assert text.endswith(", and 5 more")


@pytest.mark.parametrize(
    "source",
    [
        "x = (\n",
        "1 / 0\n",
        "import no_such_module\n",
        "unknown\n",
        "'text'.nothing()\n",
        "text = '''\nprint 1\n'''\nx = (\n",
    ],
)
def test_other_errors_are_left_as_they_are(source):
    assert explain(error_of(source), source) == []
