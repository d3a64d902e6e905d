"""Lists of gazebo_ros_pkgs' own ``ros_api_checker``, from the corpus."""

from __future__ import annotations

import pytest
import yaml

import gazelle
from gazelle.bridges import serve_ros
from gazelle_ros import Master
from gazelle_ros.tools import services
from gazelle_ros.tools.graph import GraphInspector

pytestmark = pytest.mark.corpus
FOLDER = "ros-simulation__gazebo_ros_pkgs/gazebo_ros/test/ros_network"
CHECKER = "/ros_network_by_default/"  # the checker's own node


def check(wanted, uri):
    """Check names, types and numbers of publishers as the checker does; return their number."""
    with GraphInspector("checker", uri) as graph:
        publishers, subscribers, offered = graph.master.system_state()
        types = graph.types()
        for each in wanted["topics"]:
            name = each["topic"]
            assert name in {**publishers, **subscribers}
            assert types[name] == each["type"]
            if each["num_publishers"] >= 0:
                assert len(publishers.get(name, ())) == each["num_publishers"]
        own = [each for each in wanted["services"] if not each["service"].startswith(CHECKER)]
        for each in own:
            assert each["service"] in offered
            assert services.service_type(graph, each["service"]) == each["type"]
    return len(wanted["topics"]) + len(wanted["services"])


@pytest.mark.parametrize(
    ("file", "network", "count"),
    [("gazebo_network_api.yaml", True, 40), ("no_gazebo_network_api.yaml", False, 6)],
)
def test_everything_that_gazebos_own_checker_looks_for_is_there(file, network, count, corpus):
    wanted = yaml.safe_load((corpus / FOLDER / file).read_text(encoding="utf-8"))
    with Master(port=0) as master, gazelle.Simulation("empty") as sim:
        master.api.parameters.set("/gazebo/enable_ros_network", network)
        with serve_ros(sim, master.uri):
            assert check(wanted, master.uri) == count
