"""The names of six, where it is not installed."""

import sys

import pytest

import gazelle_ros as ros


@pytest.fixture
def six(monkeypatch):
    for name in [each for each in sys.modules if each.split(".")[0] == "six"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(sys, "path", [each for each in sys.path if "site-packages" not in each])
    with ros.install():
        import six

        yield six


def test_names_of_both_pythons(six):
    assert (six.PY2, six.PY3) == (False, True)
    assert isinstance("a", six.string_types)
    assert list(six.iteritems({1: 2})) == [(1, 2)]
    assert six.int2byte(65) == six.b("A") == six.ensure_binary("A") == b"A"
    assert six.ensure_str(b"a") == six.u("a") == "a"


def test_moved_modules(six):
    import six.moves
    from six.moves import configparser, queue, reduce, urllib  # noqa: F401
    from six.moves.urllib.parse import quote, urlparse
    from six.moves.urllib.request import urlopen  # noqa: F401

    assert urlparse("http://a/b").path == "/b"
    assert urllib.parse.quote("a b") == quote("a b") == "a%20b"
    assert list(six.moves.xrange(2)) == [0, 1]


def test_metaclasses(six):
    class Meta(type):
        pass

    class First(six.with_metaclass(Meta, dict)):
        pass

    @six.add_metaclass(Meta)
    class Second:
        __slots__ = ()

    assert type(First) is type(Second) is Meta
    assert issubclass(First, dict)


def test_exceptions_and_code(six):
    names = {}
    six.exec_("x = 1", names)
    assert names["x"] == 1
    with pytest.raises(KeyError):
        six.reraise(KeyError, None, None)
