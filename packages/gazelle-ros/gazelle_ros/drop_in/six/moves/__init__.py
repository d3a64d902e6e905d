"""Modules and functions that have another name in Python 2."""

from __future__ import annotations

import builtins
import configparser
import copyreg
import html.entities as html_entities
import html.parser as html_parser
import http.client as http_client
import http.cookiejar as http_cookiejar
import http.cookies as http_cookies
import pickle as cPickle  # noqa: N812  # six calls it so
import queue
import socketserver
import xmlrpc.client as xmlrpc_client
import xmlrpc.server as xmlrpc_server
from collections import UserDict, UserList, UserString
from functools import reduce
from importlib import reload as reload_module
from io import StringIO
from io import StringIO as cStringIO  # likewise
from itertools import filterfalse, zip_longest
from os import getcwd
from os import getcwdb as getcwdb
from shlex import quote as shlex_quote
from subprocess import getoutput
from sys import intern

__all__ = [
    "StringIO",
    "UserDict",
    "UserList",
    "UserString",
    "builtins",
    "cPickle",
    "cStringIO",
    "configparser",
    "copyreg",
    "filter",
    "filterfalse",
    "getcwd",
    "getcwdb",
    "getoutput",
    "html_entities",
    "html_parser",
    "http_client",
    "http_cookiejar",
    "http_cookies",
    "input",
    "intern",
    "map",
    "queue",
    "range",
    "reduce",
    "reload_module",
    "shlex_quote",
    "socketserver",
    "xmlrpc_client",
    "xmlrpc_server",
    "xrange",
    "zip",
    "zip_longest",
]

filter, input, map, zip = builtins.filter, builtins.input, builtins.map, builtins.zip  # noqa: A001
range = xrange = builtins.range  # noqa: A001
