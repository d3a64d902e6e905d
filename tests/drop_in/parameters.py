"""openai_ros' tasks with their bundled parameters, and no graph."""

import importlib
from types import SimpleNamespace

import pytest

from gazelle.clients.descriptions import find_file
from gazelle.drop_in.openai_ros.task_envs import graph_task
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import MODULES
from gazelle_ros.launch.values import load_yaml

READERS = ("_read_steering", "_read_parameters", "get_params")


def bundled(module):
    """Return what the YAML file of a task sets, by its namespace."""
    folder, _, file = module.partition(".")
    path = find_file(f"src/openai_ros/task_envs/{folder}/config/{file}.yaml", "openai_ros")
    return load_yaml(path.read_text(encoding="utf-8"))


def getter(values):
    """Return what stands for ``rospy.get_param``."""

    def get(name, *default):
        value = values
        for part in name.strip("/").split("/"):
            if part not in value:
                (value,) = default
                return value
            value = value[part]
        return value

    return get


def on_a_graph(name):
    """Return a task that has read its parameters, without topics and controllers."""
    module, kind = MODULES[name]
    values = bundled(module)
    home = importlib.import_module(f"gazelle.drop_in.openai_ros.task_envs.{module}")
    made = object.__new__(getattr(home, kind))
    with pytest.MonkeyPatch.context() as patch:
        for each in (graph_task, home):
            patch.setattr(each, "rospy", SimpleNamespace(get_param=getter(values)), raising=False)
        for reader in READERS:
            getattr(made, reader, lambda: None)()
        if "forwards_reward" in values[made.space]:
            made._read_motion_rewards()
    made.steps_beyond_done, made.dec_obs = None, 1
    return made
