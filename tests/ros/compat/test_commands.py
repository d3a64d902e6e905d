"""The main functions of rosparam, rostopic, rosnode and rosservice, called from Python."""

import importlib
import io
import subprocess
import sys

import pytest


def test_a_command_line_writes_to_the_programs_output(node, capsys):
    rosparam = importlib.import_module("rosparam")
    rosparam.yamlmain(["rosparam", "set", "/gain", "2.5"])
    assert node.get_param("/gain") == 2.5
    rosparam.yamlmain(["rosparam", "get", "-v", "/gain"])
    assert capsys.readouterr().out == "getting parameter [/gain]\n2.5\n"


def test_a_command_line_reads_the_programs_input(node, monkeypatch):
    rosparam = importlib.import_module("rosparam")
    monkeypatch.setattr(sys, "stdin", io.StringIO("a: 1\nb: {c: x}\n"))
    rosparam.yamlmain(["rosparam", "load", "-", "/given"])
    assert node.get_param("/given") == {"a": 1, "b": {"c": "x"}}


@pytest.mark.parametrize("words", [["get"], ["get", "/none"], ["nonsense"], []])
def test_what_fails_ends_the_program(node, words):
    rosparam = importlib.import_module("rosparam")
    with pytest.raises(SystemExit) as stop:
        rosparam.yamlmain(["rosparam", *words])
    assert stop.value.code


@pytest.mark.parametrize(
    ("module", "function", "words", "said"),
    [
        ("rostopic", "rostopicmain", ["list"], "/rosout\n"),
        ("rosnode", "rosnodemain", ["list"], "/probe\n"),
        ("rosservice", "rosservicemain", ["list"], "/probe/get_loggers\n"),
    ],
)
def test_the_arguments_are_by_default_the_programs(
    node, monkeypatch, capsys, module, function, words, said
):
    monkeypatch.setattr(sys, "argv", [module, *words])
    getattr(importlib.import_module(module), function)()
    assert said in capsys.readouterr().out


def test_a_command_may_be_a_node_of_a_launch_file(node):
    line = ["rosparam", "set", "/gain", "3", "__name:=setter", "__log:=/dev/null"]
    script = f"import gazelle_ros as r; r.install(); import rosparam; rosparam.yamlmain({line})"
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60)
    assert node.get_param("/gain") == 3
