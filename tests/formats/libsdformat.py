"""Replacement of `ign sdf`, without Ruby and the loading of libsdformat for every file.

`ign` is a Ruby program that loads libsdformat and calls one function of it. A server loads it once, and
calls the same function in a fork of itself for each file. Which library that is, says the part of
`ign` that libsdformat brings.
"""

from __future__ import annotations

import functools
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

SERVER = """
import ctypes, json, os, sys, tempfile
library = ctypes.CDLL(sys.argv[1])
for line in sys.stdin:
    function, file, environment = json.loads(line)
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = os.fork()
        if child == 0:
            os.dup2(out.fileno(), 1)
            os.dup2(err.fileno(), 2)
            os.environ.update(environment)
            code = getattr(library, function)(os.fsencode(file))
            ctypes.CDLL(None).fflush(None)
            os._exit(code & 255)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        said = []
        for stream in (out, err):
            stream.seek(0)
            said.append(stream.read().decode(errors="surrogateescape"))
    print(json.dumps([code, *said]), flush=True)
"""
FUNCTIONS = {"-p": "cmdPrint", "-k": "cmdCheck"}


def library():
    """Return the file of libsdformat, or None without it."""
    for part in sorted(Path("/usr/lib/ruby/ignition").glob("cmdsdformat*.rb"), reverse=True):
        if named := re.search(r"^LIBRARY_NAME = '(.+)'", part.read_text(), re.MULTILINE):
            return part.parent / named[1]
    return None


def needed():
    """Skip the test where it is not installed."""
    if library() is None:
        pytest.skip("libsdformat's `ign sdf` is not installed (Debian: libsdformat-dev)")


@functools.cache
def server():
    """Start the server, which runs until this process ends."""
    words = [sys.executable, "-E", "-S", "-c", SERVER, str(library())]
    pipe = subprocess.PIPE
    return subprocess.Popen(words, stdin=pipe, stdout=pipe, text=True, bufsize=1)


def ign_sdf(option, path, *, roots=None):
    """Return the answer of ``ign sdf OPTION PATH``; ``roots`` are the folders of ``SDF_PATH``."""
    needed()
    folders = os.environ.get("SDF_PATH", "") if roots is None else ":".join(map(str, roots))
    request = (FUNCTIONS[option], str(Path(path).resolve()), {"SDF_PATH": folders})
    running = server()
    running.stdin.write(json.dumps(request) + "\n")
    code, out, err = json.loads(running.stdout.readline())
    return subprocess.CompletedProcess(["ign", "sdf", option, str(path)], code, out, err)


def printed(path, *, roots=None):
    """Return the file as libsdformat prints it; None where it refuses it."""
    said = ign_sdf("-p", path, roots=roots).stdout
    return said[said.index("<sdf") :] if "<sdf" in said else None
