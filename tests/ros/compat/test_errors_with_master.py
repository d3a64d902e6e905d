"""Exceptions of the modules behind ROS's tools while a master answers: the real ones' classes."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from ros import real

from gazelle_ros import Master

CALLS = (
    "rosparam.get_param('/missing')",
    "rosparam.get_param('missing')",
    "rosparam.get_param('/there')",
    "rosparam.get_param('')",
    "rosparam.delete_param('/missing')",
    "rosparam.delete_param('/')",
    "rosparam.dump_params(None, '/missing')",
    "rosparam.dump_params('/no/such/folder/x', '/')",
    "rosparam.set_param('/a', '[1')",
    "rosparam.set_param('/a', '{a: b: c}')",
    "rosparam.set_param('/a', '12345678901')",
    "rosparam.set_param('/a', '')",
    "rosparam.set_param('/a', '{1: 2}')",
    "rosparam.set_param('/a', '[{1: 2}]')",
    "rosparam.set_param('/', '5')",
    "rosparam.set_param_raw('/a', None)",
    "rosparam.set_param_raw('/a', object())",
    "rosparam.set_param_raw('/a', {'b': None})",
    "rosparam.set_param_raw('', 5)",
    "rosparam.upload_params('/', 5)",
    "rosparam.upload_params('/ns', 5)",
    "rosparam.upload_params('/ns', {1: 5})",
    "rosparam.upload_params('/ns', {'a': {'b': [1, 2.5, 'x']}})",
    "rosparam.load_file('/no/such/file.yaml')",
    "rosparam.load_file(BAD)",
    "rosparam.load_str('[1', 'name')",
    "rosparam.load_str('a: rad(nonsense', 'name')",
    "rosparam.load_str('a: rad(import os)', 'name')",
    "rosparam.list_params('/nothing')",
    "rosparam.get_param_server().getParam('/missing')",
    "rosparam.get_param_server().getParamNames()",
    "rosparam.get_param_server().lookupNode('/nobody')",
)
"""Each is asked of both; BAD is a file that is no YAML.

Not among them: numbers of more than 64 bits, on which the real one stumbles over a name of its own."""

SCRIPT = f"""
import json, os, sys
import rosparam
BAD = sys.argv[1]
rosparam.set_param("/there", "1")
found = {{}}
for call in {list(CALLS)!r}:
    try:
        eval(call)
    except Exception as error:
        found[call] = [each.__name__ for each in type(error).__mro__]
    else:
        found[call] = None
print("FOUND", json.dumps(found))
"""


def ask(command, env):
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    lines = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    assert lines, done.stderr
    return json.loads(lines[0].removeprefix("FOUND "))


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("script")
    (folder / "ask.py").write_text(SCRIPT)
    (folder / "bad.yaml").write_text("a: [1")
    return str(folder / "ask.py"), str(folder / "bad.yaml")


@pytest.fixture(scope="module")
def ours(files):
    with Master(port=0, rosout=False) as master:
        command = [sys.executable, "-m", "gazelle_ros.cli.main", "exec", *files]
        return ask(command, os.environ | {"ROS_MASTER_URI": master.uri})


@pytest.fixture(scope="module")
def theirs(files):
    with Master(port=0, rosout=False) as master:
        return ask([real.PYTHON, *files], real.environment(master.uri))


EXPECTED = {
    "rosparam.get_param('/missing')": "MasterError",
    "rosparam.delete_param('/missing')": "MasterError",
    "rosparam.dump_params(None, '/missing')": "MasterError",
    "rosparam.set_param('/a', '[1')": "YAMLError",
    "rosparam.set_param('/a', '{a: b: c}')": "YAMLError",
    "rosparam.set_param('/a', '12345678901')": "OverflowError",
    "rosparam.set_param('/a', '')": "TypeError",
    "rosparam.load_str('[1', 'name')": "YAMLError",
    "rosparam.upload_params('/', 5)": "RosParamException",
    "rosparam.load_file('/no/such/file.yaml')": "RosParamException",
    "rosparam.get_param_server().getParam('/missing')": "MasterError",
    "rosparam.get_param_server().lookupNode('/nobody')": "MasterError",
}


@pytest.mark.parametrize("call", EXPECTED)
def test_errors_have_the_class_that_programs_catch(ours, call):
    assert EXPECTED[call] in ours[call]


@pytest.mark.ros
@real.needs_ros
@pytest.mark.parametrize("call", CALLS)
def test_the_real_ones_raise_no_others(ours, theirs, call):
    mine, real_ones = ours[call], theirs[call]
    assert (mine is None) == (real_ones is None), (mine, real_ones)
    assert set(real_ones or ()) <= set(mine or ()), (mine, real_ones)
