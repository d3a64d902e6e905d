"""Detection of Python 2 code in a script, with replacements.

What changed is from https://docs.python.org/3.0/whatsnew/3.0.html.
"""

from __future__ import annotations

import linecache
import re
import traceback
from dataclasses import dataclass
from pathlib import Path

_STATEMENTS = (
    (re.compile(r"^\s*print\s+(?![=(.,)\]])(?P<rest>.+?)(?:,\s*)?$"), "print is a function"),
    (re.compile(r"^\s*print\s*$"), "print is a function"),
    (re.compile(r"^\s*print\s*>>"), "print is a function"),
    (re.compile(r"^\s*except\s+[\w.]+\s*,\s*\w+\s*:"), "write 'except Error as name:'"),
    (re.compile(r"^\s*except\s+\(.*\)\s*,\s*\w+\s*:"), "write 'except (Errors) as name:'"),
    (re.compile(r"^\s*raise\s+[\w.]+\s*,"), "write 'raise Error(text)'"),
    (re.compile(r"^\s*exec\s+[\"'\w]"), "exec is a function: write exec(code)"),
    (re.compile(r"[\w)\]]\s*<>\s*[\w(\[\"']"), "write != for <>"),
    (re.compile(r"(?<![\w.\"'])0[0-7]+(?![\w.])"), "write octal numbers with 0o"),
    (re.compile(r"(?<![\w.\"'])\d+[lL](?!\w)"), "leave out the L of long numbers"),
    (re.compile(r"\b[uU][rR][\"']"), "write r'...' for ur'...'"),
    (re.compile(r"^\s*def\s+\w+\(.*\([\w, ]+\)"), "arguments in parentheses cannot be unpacked"),
)
_MODULES = {
    "BaseHTTPServer": "http.server",
    "ConfigParser": "configparser",
    "Cookie": "http.cookies",
    "HTMLParser": "html.parser",
    "Queue": "queue",
    "SimpleHTTPServer": "http.server",
    "SimpleXMLRPCServer": "xmlrpc.server",
    "SocketServer": "socketserver",
    "StringIO": "io",
    "Tkinter": "tkinter",
    "__builtin__": "builtins",
    "cPickle": "pickle",
    "cStringIO": "io",
    "commands": "subprocess",
    "copy_reg": "copyreg",
    "httplib": "http.client",
    "thread": "threading",
    "tkMessageBox": "tkinter.messagebox",
    "urllib2": "urllib.request",
    "urlparse": "urllib.parse",
    "xmlrpclib": "xmlrpc.client",
}
_NAMES = {
    "basestring": "str",
    "cmp": "(a > b) - (a < b)",
    "execfile": "exec(open(file).read())",
    "file": "open",
    "long": "int",
    "raw_input": "input",
    "reduce": "functools.reduce",
    "reload": "importlib.reload",
    "unichr": "chr",
    "unicode": "str",
    "xrange": "range",
}
_METHODS = {
    "has_key": "'key in mapping'",
    "iteritems": "items()",
    "iterkeys": "keys()",
    "itervalues": "values()",
    "getcwdu": "getcwd()",
    "next": "next(iterator)",
}
_FROM_ITERTOOLS = {"izip": "zip", "imap": "map", "ifilter": "filter", "izip_longest": "zip_longest"}
_MOST_NAMED = 4


@dataclass(frozen=True, slots=True)
class Python2Finding:
    """Something written for Python 2."""

    line: int | None
    advice: str
    file: str | None = None
    """None for the script itself."""


def explain(error: BaseException, source: str) -> list[Python2Finding]:
    """Find the Python 2 code in a script that explains an error; empty if there is none.

    Args:
        error: Exception of compiling or running the script.
        source: The script.
    """
    if isinstance(error, SyntaxError):
        return _statements(error, source)
    advice = _advice(error) or _beside(error)
    if not advice:
        return []
    frames = traceback.extract_tb(error.__traceback__)
    place = frames[-1] if frames else None
    return [Python2Finding(place and place.lineno, advice, place and place.filename)]


def _statements(error: SyntaxError, source: str) -> list[Python2Finding]:
    if isinstance(error, TabError):
        return [Python2Finding(error.lineno, "tabs and spaces are mixed: indent with spaces only")]
    found = []
    for number, line in enumerate(source.splitlines(), 1):
        code = line.partition("#")[0]
        for pattern, advice in _STATEMENTS:
            match = pattern.search(code)
            if match:
                rest = match.groupdict().get("rest")
                found.append(Python2Finding(number, f"write print({rest})" if rest else advice))
                break
    # Where the error is on another line, what was found may be text in a string.
    return found if any(each.line == error.lineno for each in found) else []


def _advice(error: BaseException) -> str:
    name = str(getattr(error, "name", None) or "")
    if isinstance(error, ModuleNotFoundError) and name in _MODULES:
        return f"the module {name} is called {_MODULES[name]}"
    if isinstance(error, ImportError):
        wanted = next((each for each in _FROM_ITERTOOLS if f"'{each}'" in str(error)), "")
        return f"write {_FROM_ITERTOOLS[wanted]} for {wanted}" if wanted else ""
    if isinstance(error, NameError) and name in _NAMES:
        return f"write {_NAMES[name]} for {name}"
    if isinstance(error, AttributeError):
        if name in _METHODS:
            return f"write {_METHODS[name]} for {name}()"
        if name in _FROM_ITERTOOLS:
            return f"write {_FROM_ITERTOOLS[name]} for {name}"
    return ""


def _beside(error: BaseException) -> str:
    """Return advice on a module that lies beside the one that imports it: Python 2 looked there."""
    frames = list(traceback.walk_tb(error.__traceback__))
    if not frames or not isinstance(error, ModuleNotFoundError) or not error.name:
        return ""
    frame, line = frames[-1]
    file = Path(frame.f_code.co_filename)
    top = error.name.partition(".")[0]
    modules = {file.with_name(f"{top}.py"), file.with_name(top) / "__init__.py"} - {file}
    if not frame.f_globals.get("__package__") or not any(each.is_file() for each in modules):
        return ""
    statement = linecache.getline(str(file), line).split("#")[0].split()
    named = statement[:1] == ["from"]
    start = f"from .{statement[1]} import ..." if named else f"from . import {top}"
    return f"Python 2 looked beside this module first, where {top} is: write '{start}'"


def advice_text(findings: list[Python2Finding]) -> str:
    """Return readable advice: the first findings, and the number of further ones."""
    first = findings[:_MOST_NAMED]
    lines = ", ".join(
        each.advice if place == 0 else f"line {each.line}: {each.advice}"
        for place, each in enumerate(first)
    )
    more = len(findings) - len(first)
    return lines + (f", and {more} more" if more else "")
