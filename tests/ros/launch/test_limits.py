"""Limits of launch files: each is one error that names it, within seconds."""

import os
import time

import pytest

from gazelle_ros.launch import LaunchError, Packages, load_launch
from gazelle_ros.launch.limits import communicate
from gazelle_ros.launch.programs import parameter_value

TEN = "".join(
    f"<arg name='a{n}' value='{f'$(arg a{n - 1})' * 10}'/>" if n else "<arg name='a0' value='x'/>"
    for n in range(12)
)


def loaded(tmp_path, text):
    (tmp_path / "a.launch").write_text(f"<launch>{text}</launch>")
    plan = load_launch(tmp_path / "a.launch")
    return [parameter_value(each, Packages()) for each in plan.parameters.values()]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"{TEN}<param name='p' value='$(arg a11)'/>", "characters, more than the limit"),
        ("<param name='p' value=\"$(eval 'ab' * 10**7)\"/>", "makes more than 100000 items"),
        ("<param name='p' textfile='/dev/zero'/>", "more than the limit of 16,777,216 bytes"),
        ("<param name='p' binfile='/dev/zero'/>", "more than the limit of 16,777,216 bytes"),
        ("<rosparam file='/dev/zero'/>", "more than the limit of 16,777,216 bytes"),
        ("<include file='/dev/zero'/>", "more than the limit of 16,777,216 bytes"),
        ("<param name='p' command='yes'/>", "'yes': it writes more than the limit"),
        ("<include file='$(dirname)/b.launch'/>" * 2, "includes more than 2,000 files"),
    ],
)
def test_a_launch_file_that_makes_much_is_refused(tmp_path, text, said):
    for name, after in zip("bcdefghijkl", "cdefghijklm", strict=True):
        inner = f"<include file='$(dirname)/{after}.launch'/>" * 2
        (tmp_path / f"{name}.launch").write_text(f"<launch>{inner}</launch>")
    (tmp_path / "m.launch").write_text("<launch/>")
    start = time.process_time()
    with pytest.raises(LaunchError, match=said):
        loaded(tmp_path, text)
    assert time.process_time() - start < 10.0


@pytest.mark.parametrize(
    "expression",
    [
        "9**9**9**9",
        "1 &lt;&lt; 10**10",
        "'a' * 10**10",
        "[1] * 10**10",
        "max(range(10**12))",
        "[x for x in range(10**5) for y in range(10**5)]",
        "[[0] * 9999 for i in range(99999)]",
        "'%10000000000d' % 1",
        "'%*d' % (10**10, 1)",
        "'{:10000000000}'.format(1)",
        "'{:{}}'.format(1, 10**10)",
        "f'{1:10000000000}'",
        "'a'.ljust(10**10)",
        "'b'.join(['a' * 99999] * 99999)",
        "('a' * 99999).replace('', 'b' * 99999)",
        "('a' * 99999).translate({97: 'b' * 99999})",
        "('{0}' * 9999).format('a' * 99999)",
        "len([a for a in [[]] for b in range(60) if [a.append([a[-1:], a[-1:]])] and str(a)])",
    ],
)
def test_an_expression_that_makes_much_is_refused(tmp_path, expression):
    start = time.process_time()
    with pytest.raises(LaunchError, match=r"the expression|may be padded"):
        loaded(tmp_path, f'<param name="p" value="$(eval {expression})"/>')
    assert time.process_time() - start < 5.0


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("'%.2f %s' % (1.5, 'a')", "1.50 a"),
        ("'%d%%' % 5", "5%"),
        ("'{:_>5}|{!r}'.format('a', 'b')", "____a|'b'"),
        ("f'{1.5:.2f} {str(2)!r} {3}'", "1.50 '2' 3"),
        ("', '.join(['a', 'b']).replace('a', 'cc')", "cc, b"),
        ("7 % 4 + 1", 4),
        ("'a' + 'b'.zfill(3)", "a00b"),
        ("[1] + [2] == [1, 2]", True),
        ("'localhost:11311 * 2000 {}'.format('x')", "localhost:11311 * 2000 x"),
    ],
)
def test_an_expression_of_text_is_as_in_python(tmp_path, expression, value):
    assert loaded(tmp_path, f'<param name="p" value="$(eval {expression})"/>') == [value]


def test_a_pipe_is_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(LaunchError, match="is a pipe"):
        loaded(tmp_path, f"<param name='p' textfile='{tmp_path}/pipe'/>")


def test_the_output_of_a_command_is_read_whole(tmp_path):
    (tmp_path / "long.txt").write_text("a" * 300_000)
    (value,) = loaded(tmp_path, f"<param name='p' command='cat {tmp_path}/long.txt'/>")
    assert value == "a" * 300_000


def test_a_command_that_ends_late_is_refused(tmp_path):
    import subprocess

    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(["/bin/sleep", "60"], **pipes) as process:
        with pytest.raises(subprocess.TimeoutExpired):
            communicate(process, 0.2)
        process.kill()
