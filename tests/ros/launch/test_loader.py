"""roslaunch XML into plans."""

from __future__ import annotations

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.launch import (
    LaunchError,
    MissingArgumentError,
    MissingPackageError,
    Packages,
    ParameterCommand,
    describing,
    load_launch,
    load_launch_text,
)
from gazelle_ros.launch.document import read_document
from gazelle_ros.launch.loader import declared_arguments

NODE = '<node pkg="robot" type="t" name="{}"/>'


def node(name, inner="", **attributes):
    extra = "".join(f' {key.replace("_", "-")}="{each}"' for key, each in attributes.items())
    return f'<node pkg="robot" type="t" name="{name}"{extra}>{inner}</node>'


# Parameters ------------------------------------------------------------------------------


def test_parameters_are_set_with_types_and_the_last_wins(values):
    body = """
    <param name="a" value="1"/> <param name="/b" value="1" type="str"/>
    <param name="a" value="2.5"/> <param name="n/c" value="true"/>
    """
    assert values(body) == {"/a": 2.5, "/b": "1", "/n/c": True}


def test_files_become_parameters(values, tmp_path):
    (tmp_path / "t.txt").write_text("hello\n")
    (tmp_path / "b.bin").write_bytes(b"\0\xff")
    body = (
        f'<param name="t" textfile="{tmp_path}/t.txt"/><param name="b" binfile="{tmp_path}/b.bin"/>'
    )
    assert values(body) == {"/t": "hello\n", "/b": b"\0\xff"}


def test_commands_are_kept_and_not_run(values, tmp_path):
    body = f'<param name="c" command="touch {tmp_path}/x" type="yaml"/>'
    assert values(body) == {"/c": ParameterCommand(f"touch {tmp_path}/x", "yaml")}
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<param name="a"/>', "exactly one of"),
        ('<param name="a" value="1" command="x"/>', "exactly one of"),
        ('<param value="1"/>', "'name' is missing"),
        ('<param nme="a" value="1"/>', "did you mean 'nme'"),
        ('<param name="a" value="x" type="int"/>', "'x' is not of type int"),
        ('<param name="a" value="1" type="intt"/>', "did you mean 'int'"),
        ('<param name="a" textfile="/no/such"/>', "cannot be read"),
    ],
)
def test_a_wrong_parameter_names_file_line_and_element(load, body, message):
    with pytest.raises(LaunchError) as caught:
        load("\n" + body)
    assert message in str(caught.value)
    assert caught.value.file.endswith("main.launch")
    assert caught.value.line == 3
    assert caught.value.element.startswith("param")


def test_private_parameters_go_to_the_nodes_that_follow(values):
    body = f"""
    {node("before")}
    <group ns="g"><param name="~p" value="1"/>{node("in")}</group>
    <param name="~q" value="2"/> {node("after", '<param name="q" value="3"/>')}
    """
    assert values(body) == {"/g/in/p": 1, "/after/q": 3}


def test_parameters_of_a_node_are_private(values):
    inner = '<param name="a" value="1"/><param name="~b" value="2"/><rosparam>{c: 3}</rosparam>'
    body = f'<group ns="g">{node("n", inner)}</group>'
    assert values(body) == {"/g/n/a": 1, "/g/n/b": 2, "/g/n/c": 3}


def test_yaml_is_unrolled(values, tmp_path):
    (tmp_path / "y.yaml").write_text("a: {b: 1}\nl: [1, 2]\n")
    body = f"""
    <rosparam file="{tmp_path}/y.yaml" ns="n"/> <rosparam param="v">[3]</rosparam>
    <rosparam ns="o" subst_value="true">{{x: $(eval 1 + 1)}}</rosparam> <rosparam/>
    """
    with pytest.raises(LaunchError, match="whole of the attribute"):
        values(body)
    body = body.replace("$(eval 1 + 1)", "$(optenv NOPE 2)")
    assert values(body) == {"/n/a/b": 1, "/n/l": [1, 2], "/v": [3], "/o/x": 2}


def test_dump_and_delete_are_actions(load):
    plan = load(
        '<group ns="g"><rosparam command="dump" file="f.yaml"/>'
        '<rosparam command="delete" param="x"/></group>'
    )
    assert [(each.command, each.name, each.file) for each in plan.actions] == [
        ("dump", "/g", "f.yaml"),
        ("delete", "/g/x", None),
    ]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<rosparam command="lod"/>', "did you mean 'load'"),
        ("<rosparam>[1]</rosparam>", "needs the attribute 'param'"),
        ('<rosparam file="/no.yaml"/>', "cannot be read"),
        ("<rosparam>a: [</rosparam>", "not valid YAML"),
        ('<rosparam command="delete" file="x"/>', "takes no 'file'"),
        ('<rosparam command="dump"/>', "needs the attribute 'file'"),
    ],
)
def test_a_wrong_rosparam_is_an_error(load, body, message):
    with pytest.raises(LaunchError, match=message):
        load(body)


def test_parameters_that_hide_each_other_are_noticed(load):
    plan = load('<param name="a" value="1"/><param name="a/b" value="1"/>')
    assert ["/a/b" in notice for notice in plan.notices] == [True]


# Arguments -------------------------------------------------------------------------------


def test_arguments_take_defaults_unless_given(values):
    body = '<arg name="a" default="1"/><param name="p" value="$(arg a)"/>'
    assert values(body) == {"/p": 1}
    assert values(body, {"a": "x"}) == {"/p": "x"}


def test_constants_cannot_be_given(load):
    with pytest.raises(LaunchError, match="constant"):
        load('<arg name="a" value="1"/>', {"a": "2"})


def test_a_required_argument_is_missed_where_it_is_used(load):
    body = '<arg name="a"/>\n<param name="p" value="$(arg a)"/>'
    with pytest.raises(MissingArgumentError, match="give it as a:=VALUE") as caught:
        load(body)
    assert caught.value.line == 3
    load('<arg name="a"/>')


def test_an_argument_is_declared_once(load):
    with pytest.raises(LaunchError, match="declared before"):
        load('<arg name="a" default="1"/><arg name="a" default="2"/>')


def test_arguments_of_a_group_stay_in_it(load):
    with pytest.raises(MissingArgumentError):
        load('<group><arg name="a" value="1"/></group><param name="p" value="$(arg a)"/>')


def test_a_superfluous_argument_is_noticed(load):
    (notice,) = load('<arg name="model" default="1"/>', {"modle": "x"}).notices
    assert "did you mean 'model'" in notice


def test_arguments_are_listed_with_their_texts(load, workspace):
    load(
        '<arg name="a" doc="what"/><arg name="b" default="2"/><arg name="c" value="3"/>', {"a": ""}
    )
    plan = declared_arguments(workspace / "robot" / "launch" / "main.launch")
    found = {each.name: (each.default, each.doc, each.constant) for each in plan.arguments.values()}
    assert found == {"a": (None, "what", False), "b": ("2", "", False), "c": (None, "", True)}


@pytest.mark.parametrize(("value", "taken"), [("true", True), ("1", True), ("False", False)])
def test_conditions_choose(values, value, taken):
    body = f'<param if="{value}" name="i" value="1"/><param unless="{value}" name="u" value="1"/>'
    assert set(values(body)) == {"/i" if taken else "/u"}


def test_conditions_guard_what_is_inside(values):
    body = '<arg name="x" default="false"/><group if="$(arg x)"><param name="p" value="$(env NO)"/></group>'
    assert values(body) == {}


@pytest.mark.parametrize("attributes", ['if="1" unless="1"', 'if="yes"'])
def test_wrong_conditions_are_errors(load, attributes):
    with pytest.raises(LaunchError):
        load(f"<group {attributes}/>")


# Includes --------------------------------------------------------------------------------


def test_includes_get_arguments_and_a_namespace(values):
    body = '<include file="$(dirname)/other.launch" ns="n"><arg name="a" value="5"/></include>'
    other = '<arg name="a"/><param name="p" value="$(arg a)"/>'
    assert values(body, other=other) == {"/n/p": 5}


def test_arguments_are_local_to_their_file(load):
    body = '<arg name="a" value="1"/><include file="$(dirname)/other.launch"/>'
    with pytest.raises(MissingArgumentError, match="give it in the <include>"):
        load(body, other='<arg name="a"/><param name="p" value="$(arg a)"/>')


def test_pass_all_args_passes_all(values):
    body = (
        '<arg name="a" value="1"/><arg name="z" value="0"/>'
        '<include file="$(dirname)/other.launch" pass_all_args="true"><arg name="b" value="2"/></include>'
    )
    other = '<arg name="a" default="9"/><arg name="b"/><param name="p" value="$(arg a)$(arg b)"/>'
    assert values(body, other=other) == {"/p": 12}


def test_an_argument_that_the_file_does_not_declare_is_an_error(load):
    body = '<include file="$(dirname)/other.launch"><arg name="modle" value="1"/></include>'
    with pytest.raises(LaunchError, match="did you mean 'model'"):
        load(body, other='<arg name="model" default="1"/>')


def test_a_name_that_no_file_can_have():
    with pytest.raises(LaunchError, match="cannot be read"):
        read_document("a" * 5000 + ".launch")


def test_a_missing_include_names_who_includes_it(load):
    with pytest.raises(LaunchError, match="no such launch file") as caught:
        load('\n<include file="/no/such.launch"/>')
    assert caught.value.file.endswith("main.launch")
    assert caught.value.line == 3


def test_files_that_include_each_other_end(load):
    with pytest.raises(LaunchError, match="include each other"):
        load('<include file="$(dirname)/main.launch"/>')


def test_errors_name_the_included_file(load):
    body = '<include file="$(dirname)/other.launch"/>'
    with pytest.raises(LaunchError) as caught:
        load(body, other='\n\n<param name="x"/>')
    assert caught.value.file.endswith("other.launch")
    assert caught.value.line == 4


# Nodes -----------------------------------------------------------------------------------


def test_nodes_have_all_their_attributes(load):
    attributes = {
        "args": "-a 1",
        "respawn": "true",
        "respawn_delay": "2",
        "output": "screen",
        "cwd": "node",
        "launch-prefix": "nice -n 5",
        "ns": "in",
    }
    text = "".join(f' {key}="{each}"' for key, each in attributes.items())
    (found,) = load(f'<group ns="g"><node pkg="robot" type="t" name="n"{text}/></group>').nodes
    assert found.full_name == "/g/in/n"
    assert (found.arguments, found.respawn, found.respawn_delay) == ("-a 1", True, 2.0)
    assert (found.output, found.cwd, found.launch_prefix) == ("screen", "node", "nice -n 5")
    assert found.place.line == 2


def test_remappings_and_environment_are_inherited(load):
    body = f"""
    <remap from="a" to="b"/> <env name="E" value="1"/>
    <group><remap from="a" to="c"/><remap from="d" to="e"/>{node("in")}</group>
    {node("out", '<env name="F" value="2"/><remap from="x" to="/y"/>')}
    {node("last")}
    """
    inside, out, last = load(body).nodes
    assert inside.remappings == (("a", "c"), ("d", "e"))
    assert out.remappings == (("a", "b"), ("x", "/y"))
    assert out.environment == (("E", "1"), ("F", "2"))
    assert last.environment == (("E", "1"),)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<node pkg="a" type="b"/>', "'name' is missing"),
        ('<node type="b" name="c"/>', "'pkg' is missing"),
        (node("a/b"), "cannot have a namespace"),
        (node("n", output="scren"), "did you mean 'screen'"),
        (node("n", respawn="true", required="true"), "not both"),
        (node("n", respawn="yes"), "neither true nor false"),
        (node("n", cwd="here"), "cwd='here' is unknown"),
        (node("n") + node("n"), "two nodes are called '/n'"),
        ('<remap from="a b" to="c"/>', "not a legal name"),
        ('<remap from="a"/>', "'to' is missing"),
        ('<group ns=""/>', "ns is empty"),
        ('<group clear_params="true"/>', "needs the attribute 'ns'"),
        ('<env name="" value="1"/>', "empty"),
        ('<test test-name="t" pkg="a" type="b" output="screen"/>', "a test has no 'output'"),
        ('<test test-name="t" pkg="a" type="b" time-limit="0"/>', "above 0"),
        ('<machine name="m" address="x" ros-ip="1"/>', "not supported"),
    ],
)
def test_wrong_elements_are_errors(load, body, message):
    with pytest.raises(LaunchError) as caught:
        load(body)
    assert message in str(caught.value)
    assert caught.value.line == 2


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<nod pkg="a"/>', "did you mean 'node'"),
        ('<node pkg="a" type="b" name="c" arg="x"/>', "did you mean 'args'"),
        ("<master/>", "no meaning"),
        (node("n", "<node/>"), "no place in a node"),
        ('<node pkg="a" type="b" name="1x"/>', "not a legal name"),
    ],
)
def test_what_is_ignored_is_noticed(load, body, message):
    (notice,) = load(body).notices
    assert message in notice
    assert "main.launch:2:" in notice


def test_schemas_are_not_noticed(workspace):
    xsi = "http://www.w3.org/2001/XMLSchema-instance"
    file = workspace / "robot" / "launch" / "schema.launch"
    file.write_text(f'<launch xmlns:xsi="{xsi}" xsi:noNamespaceSchemaLocation="l.xsd"/>')
    assert load_launch(file, packages=Packages()).notices == []


def test_namespaces_are_cleared(load):
    plan = load(
        f'<group ns="g" clear_params="true">{node("n", clear_params="true").replace("clear-", "clear_")}</group>'
    )
    assert plan.clear == ["/g/", "/g/n/"]


def test_tests_are_kept_apart(load):
    body = '<test test-name="t" pkg="robot" type="x" time-limit="5" retry="2"/>'
    plan = load(body)
    (found,) = plan.tests
    assert (plan.nodes, found.name, found.time_limit, found.retry) == ([], "t", 5.0, 2)


def test_machines_are_kept(load):
    plan = load(
        '<machine name="m" address="localhost" default="true"/>'
        + node("n")
        + node("o", machine="p")
    )
    assert plan.machines["m"].address == "localhost"
    assert [each.machine for each in plan.nodes] == ["m", "p"]


# Files -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    ["", "<launch>", "<robot/>", "<launch><launch/></launch>", "<launch>&x;</launch>", "text"],
)
def test_what_is_no_launch_file_is_an_error(text):
    with pytest.raises(LaunchError):
        load_launch_text(text, name="f.launch")


def test_entities_are_refused():
    with pytest.raises(LaunchError, match="entities"):
        load_launch_text('<!DOCTYPE l [<!ENTITY a "b">]><launch>&a;</launch>')


def test_deep_nesting_is_refused():
    with pytest.raises(LaunchError, match="deep"):
        load_launch_text("<launch>" + "<group>" * 300 + "</group>" * 300 + "</launch>")


@given(st.text(alphabet='<>/="launch node param $(arg)x \n', max_size=60))
def test_nothing_but_our_errors_comes_out(text):
    for whole in (text, f"<launch>{text}</launch>"):
        with contextlib.suppress(LaunchError):
            load_launch_text(whole, packages=Packages({}))


def test_every_launch_file_of_the_corpus_loads_or_says_what_is_missing(corpus):
    environment = {"ROS_PACKAGE_PATH": str(corpus), "TURTLEBOT3_MODEL": "burger"}
    packages = Packages(environment)
    files = sorted(
        {*corpus.rglob("*.launch"), *corpus.rglob("*.launch.xml"), *corpus.rglob("*.test")}
    )
    loaded, faults = 0, []
    for file in files:
        try:
            load_launch(file, packages=packages, environment=environment)
            loaded += 1
        except MissingPackageError as error:
            if error.package not in str(error) or error.line is None:
                faults.append(str(error))
        except LaunchError as error:
            if error.file is None or error.line is None:
                faults.append(str(error))
    assert faults == []
    assert loaded > 0.6 * len(files)


def test_a_launch_is_told_in_one_line_unless_all_is_wanted():
    plan = load_launch_text(
        '<launch><param name="a" value="1"/><node pkg="p" type="t" name="n"/></launch>',
        name="b/c.launch",
    )
    assert describing.outline(plan) == "c.launch: 1 node, 1 parameter"
    assert " * /a: 1\n" in describing.summary(plan)
    assert "    n (p/t)\n" in describing.summary(plan)
