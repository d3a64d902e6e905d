from __future__ import annotations

import argparse

import pytest

from gazelle.cli.commands import COMMANDS
from gazelle.clients import gz, spawn_model
from gazelle_ros.base.argument_types import port_number, positive_float, positive_int
from gazelle_ros.cli.parsing import Parser, key_value


@pytest.mark.parametrize(("text", "number"), [("1", 1), ("2_000", 2000), ("1e6", 1_000_000)])
def test_whole_numbers_can_be_written_in_several_ways(text, number):
    assert positive_int(text) == number


@pytest.mark.parametrize("text", ["0", "-3", "1.5", "many", "", "1e999", "nan"])
def test_what_is_no_whole_number_above_0_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="above 0"):
        positive_int(text)


@pytest.mark.parametrize("text", ["1e19", str(2**63)])
def test_a_count_that_no_array_can_hold_is_refused(text):
    assert positive_int(str(2**63 - 1)) == 2**63 - 1
    with pytest.raises(argparse.ArgumentTypeError, match=r"below 2\^63"):
        positive_int(text)


@pytest.mark.parametrize("text", ["0", "-1", "inf", "nan", "fast"])
def test_what_is_no_number_above_0_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="above 0"):
        positive_float(text)


@pytest.mark.parametrize("text", ["1e308", "1e10", "1e-10", "5e-324", "9" * 30])
def test_a_number_that_no_clock_can_count_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="from 1e-9 to 1e9"):
        positive_float(text)


@pytest.mark.parametrize("text", ["nan", "inf", "-inf", "1e308", "-1e400", "", "soon"])
@pytest.mark.parametrize("option", ["--start", "--delay"])
def test_no_seconds_are_refused(cli, text, option):
    code, _, err = cli("bag", "play", "a.bag", option, text)
    assert code == 2
    assert "expected seconds from -1e9 to 1e9" in err


@pytest.mark.parametrize("text", ["-1", "65536", "1e400", "nan", "", "9" * 30])
def test_what_is_no_port_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="from 0 to 65535"):
        port_number(text)


@pytest.mark.parametrize("text", ["0", "00", "65536", "x"])
def test_a_master_that_others_find_has_a_port(cli, text):
    code, _, err = cli("launch", "-p", text, "a.launch")
    assert code == 2
    assert "expected a port from" in err


@pytest.mark.parametrize("word", [" ", "", "\t", "=", "--="])
def test_an_extra_word_is_refused_whatever_it_is(capsys, word):
    with pytest.raises(SystemExit, match="2"):
        Parser(prog="x").parse_args([word])
    assert "unrecognized arguments" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "pair"),
    [
        ("a=1", ("a", 1)),
        ("a=0.5", ("a", 0.5)),
        ("a=true", ("a", True)),
        ("a=[[1, 2]]", ("a", [[1, 2]])),
        ("a=word", ("a", "word")),
        ("a=b=c", ("a", "b=c")),
    ],
)
def test_options_are_read_as_json_or_text(text, pair):
    assert key_value(text) == pair


@pytest.mark.parametrize("text", ["a", "=1", "two words=1"])
def test_options_need_a_name(text):
    with pytest.raises(argparse.ArgumentTypeError, match="KEY=VALUE"):
        key_value(text)


class Refused(Exception):
    """An error of a parser."""


def refuse(_parser, message):
    raise Refused(message)


def complaint(parser, words):
    try:
        parser.parse_args(words)
    except Refused as refused:
        return str(refused)
    return ""


def parsers(parser):
    """Yield a parser and those of its sub-commands."""
    yield parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for inner in action.choices.values():
                yield from parsers(inner)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_of_every_command_takes_values_that_begin_with_a_minus_sign(name, monkeypatch):
    monkeypatch.setattr(Parser, "error", refuse)
    whole = Parser(prog=name)
    COMMANDS[name].load().configure(whole)
    for parser in parsers(whole):
        for action in parser._actions:
            if not action.option_strings or action.nargs == 0:
                continue
            action.type = action.choices = None
            count = action.nargs if isinstance(action.nargs, int) else 1
            for value in ("-3", "-1,0.5", "-.5,2,3", "-1e-3", "-2x3", "-inf"):
                given = [[action.option_strings[-1], *[value] * count]]
                if count == 1 and action.option_strings[-1].startswith("--"):
                    given.append([f"{action.option_strings[-1]}={value}"])
                for words in given:
                    said = complaint(parser, words)  # about a file that is not given, at most
                    assert not said or "the following arguments are required" in said, words


@pytest.mark.parametrize(
    ("words", "place", "value"),
    [
        (["deploy", "run", "--goal", "-1,0.5", "--goal=-2,-3"], "goal", ["-1,0.5", "-2,-3"]),
        (["deploy", "run", "scan:=/lidar", "--scan-yaw", "-1e-3"], "scan_yaw", -1e-3),
        (["film", "a", "b.gif", "--drive", "-0.2,0.3"], "drive", (-0.2, 0.3)),
        (["picture", "a", "b.png", "--eye", "-1,2,3"], "eye", (-1.0, 2.0, 3.0)),
        (["picture", "--target", "-.5,0,-1e-2", "a", "b.png"], "target", (-0.5, 0.0, -0.01)),
        (["map", "a", "b", "--area", "-3", "-1e1", "3", "10"], "area", [-3.0, -10.0, 3.0, 10.0]),
        (["param", "set", "/gain", "-1.5e-3"], "value", "-1.5e-3"),
        (["param", "set", "/limit", "-.inf"], "value", "-.inf"),
        (["topic", "pub", "/x", "std_msgs/Float64", "-1.5"], "values", ["-1.5"]),
        (["topic", "pub", "-1", "/x", "std_msgs/Float64", "-0.5"], "once", True),
    ],
)
def test_negative_values_arrive(words, place, value):
    parser = Parser()
    COMMANDS[words[0]].load().configure(parser)
    assert getattr(parser.parse_args(words[1:]), place) == value


@pytest.mark.parametrize("flags", ["-1l", "-l1", "-1 -l"])
@pytest.mark.parametrize("last", [True, False])
def test_options_of_one_letter_may_be_joined(flags, last):
    parser, words = Parser(), ["/x", "std_msgs/Bool", "data: false"]
    COMMANDS["topic"].load().configure(parser)
    words = [*words, *flags.split()] if last else [*flags.split(), *words]
    args = parser.parse_args(["pub", *words])
    assert (args.once, args.latch, args.values) == (True, True, ["data: false"])


@pytest.mark.parametrize("number", ["-11", "-1e1", "-1.1"])
def test_what_only_begins_like_an_option_is_a_number(number):
    parser = Parser()
    COMMANDS["topic"].load().configure(parser)
    assert parser.parse_args(["pub", "/x", "std_msgs/Float64", number]).values == [number]


def test_programs_of_ros_take_negative_values_too():
    parsed = spawn_model.parse_options(
        ["-urdf", "-file", "a", "-model", "b", "-x", "-1e-3", "-Y", "-.5", "-J", "elbow", "-1e-2"]
    )
    assert (parsed.x, parsed.yaw, parsed.joints) == (-1e-3, -0.5, [["elbow", "-1e-2"]])
    assert gz._parser().parse_args(["physics", "-g", "-1,0,-9.8"]).gravity == (-1.0, 0.0, -9.8)


@pytest.mark.parametrize(
    ("words", "option"),
    [
        ("train TurtleBot3Stage1 --ray=", "--ray"),
        ("eval RUN --import=", "--import"),
        ("run empty --engine=", "--engine"),
        ("topic echo --filter= /a", "--filter"),
    ],
)
def test_an_option_without_a_value_is_refused(cli, words, option):
    code, _, err = cli(*words.split())
    assert code == 2
    assert f"argument {option}: expected a value, not an empty text" in err


def test_an_empty_text_is_a_value_where_it_is_the_default():
    parser = Parser(prog="x")
    parser.add_argument("--exclude", default="")
    assert parser.parse_args(["--exclude="]).exclude == ""
