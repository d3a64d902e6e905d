"""``$(...)`` in attributes."""

from __future__ import annotations

import contextlib
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.launch.errors import (
    MissingArgumentError,
    MissingPackageError,
    SubstitutionError,
)
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.substitution import Substitution


def words(arguments=None, file="/a/b/c.launch", environment=None):
    environment = {} if environment is None else environment
    packages = Packages(environment)
    return Substitution(packages, file, arguments or {}, environment)


def test_arguments_and_environment_are_replaced():
    known = words({"x": "1", "y": "two words"}, environment={"HOME": "/h"})
    assert known.resolve("$(arg x)-$(arg y)-$(env HOME)") == "1-two words-/h"


def test_a_missing_argument_is_named_with_the_closest():
    with pytest.raises(MissingArgumentError, match="did you mean 'model'"):
        words({"model": "a"}).resolve("$(arg modle)")


def test_a_missing_variable_is_an_error_unless_optional():
    with pytest.raises(SubstitutionError, match="NOPE"):
        words().resolve("$(env NOPE)")
    assert words().resolve("[$(optenv NOPE)]") == "[]"
    assert words().resolve("$(optenv NOPE a b)") == "a b"
    assert words(environment={"NOPE": "c"}).resolve("$(optenv NOPE a b)") == "c"


def test_dirname_is_the_folder_of_the_file():
    assert words().resolve("$(dirname)/../x") == "/a/b/../x"
    with pytest.raises(SubstitutionError):
        words(file=None).resolve("$(dirname)")


def test_anonymous_names_are_the_same_for_the_same_word():
    known = words()
    first, second, other = known.resolve("$(anon a) $(anon a) $(anon b)").split()
    assert first == second
    assert first.startswith("a_")
    assert other.startswith("b_")


def test_packages_are_found(workspace):
    known = words(environment={"ROS_PACKAGE_PATH": str(workspace)})
    assert known.resolve("$(find robot)/x y") == f"{workspace}/robot/x y"
    assert known.resolve("-f $(find robot)/a $(find robot)/b") == (
        f"-f {workspace}/robot/a {workspace}/robot/b"
    )


JOINED = {
    "$(find robot)launch/a.launch": "{0}/launch/a.launch",
    "$(find robot)": "{0}",
    "$(find robot)/": "{0}",
    "$(find robot)launch/": "{0}/launch/",
    "$(find robot).txt": "{0}/.txt",
    "$(find robot)//a": "/a",
    "$(find robot)\\b": "{0}/b",
    "$(find robot) /a": "{0} /a",
    "$(find robot)a $(find robot)b": "{0}/a {0}/b",
    "$(find robot)$(find robot)": "{0}/{0}",
    "$(find robot)/$(find robot)x": "{0}/{0}/x",
    "x$(find robot)/../y": "x{0}/../y",
    '"$(find robot)a"': '"{0}/a"',
}


@pytest.mark.parametrize("text", JOINED)
def test_a_slash_joins_a_package_and_what_follows(workspace, text):
    known = words(environment={"ROS_PACKAGE_PATH": str(workspace)})
    assert known.resolve(text) == JOINED[text].format(workspace / "robot")


@pytest.mark.long
@pytest.mark.skipif(not Path("/usr/lib/python3/dist-packages/roslaunch").exists(), reason="no ROS")
def test_roslaunch_joins_so_itself(workspace):
    program = (
        "import sys; from roslaunch.substitution_args import resolve_args\n"
        "for text in sys.argv[1:]: print(resolve_args(text, {}))"
    )
    run = subprocess.run(
        ["/usr/bin/python3", "-c", program, *JOINED],
        capture_output=True,
        text=True,
        check=True,
        env={"ROS_PACKAGE_PATH": str(workspace), "HOME": str(workspace)},
    )
    folder = workspace / "robot"
    assert run.stdout.splitlines() == [each.format(folder) for each in JOINED.values()]


def test_a_missing_package_is_named_with_the_closest(workspace):
    known = words(environment={"ROS_PACKAGE_PATH": str(workspace)})
    with pytest.raises(MissingPackageError, match="did you mean 'robot'") as caught:
        known.resolve("$(find robt)/x")
    assert caught.value.package == "robt"


def test_an_argument_may_hold_a_package(workspace):
    known = words({"f": "$(find robot)/x"}, environment={"ROS_PACKAGE_PATH": str(workspace)})
    assert known.resolve("$(arg f)") == f"{workspace}/robot/x"


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2", "3"),
        ("x * 2", "14"),
        ("arg('x') + 0.5", "7.5"),
        ("'a' + s", "ab"),
        ("not t", "False"),
        ("s == 'b' and true", "True"),
        ("cos(pi)", "-1.0"),
        ("env('HOME') + '/x'", "/h/x"),
        ("optenv('NOPE', 'd')", "d"),
        ("dirname()", "/a/b"),
        ("[n * x for n in range(2)]", "[0, 7]"),
        ("list(map(str, [1]))[0] + str(int('2'))", "12"),
        ("len(s)", "1"),
    ],
)
def test_expressions_are_evaluated(expression, value):
    known = words({"x": "7", "s": "b", "t": "true"}, environment={"HOME": "/h"})
    assert known.resolve(f"$(eval {expression})") == value


@pytest.mark.parametrize(
    "expression",
    ["nope + 1", "1 /", "1 / 0", "().__class__", "open('/etc/passwd')", "arg('nope')"],
)
def test_bad_expressions_are_errors(expression):
    with pytest.raises(SubstitutionError):
        words().resolve(f"$(eval {expression})")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$(fnd robot)", "did you mean 'find'"),
        ("$(arg)", "needs a name"),
        ("$(arg a b)", "one name"),
        ("$(find a b)", "one package"),
        ("$(arg $(env X))", "inside"),
        ("$(arg (x))", "inside"),
        ("a $(eval 1)", "whole of the attribute"),
    ],
)
def test_malformed_substitutions_are_errors(text, message):
    with pytest.raises(SubstitutionError) as caught:
        words({"a": "1"}).resolve(text)
    assert message in str(caught.value)


@pytest.mark.parametrize("text", ["", "plain", "$", "$x (y)", "$()", "$(arg x", "50 $ ()"])
def test_other_text_stays_as_it_is(text):
    assert words().resolve(text) == text


@given(st.text(alphabet="$()ab eval rgfindx"))
def test_nothing_but_our_errors_comes_out(text):
    known = words({"a": "1", "b": "$"})
    with contextlib.suppress(SubstitutionError):
        assert isinstance(known.resolve(text), str)
