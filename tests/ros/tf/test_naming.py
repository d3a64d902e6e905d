"""Prefixes of frames."""

import pytest

from gazelle_ros import Master, Node
from gazelle_ros.tf.naming import FramePrefixes, resolve_frame


@pytest.mark.parametrize(
    ("prefix", "frame", "full"),
    [
        ("", "odom", "odom"),
        ("r1", "odom", "r1/odom"),
        ("/r1", "odom", "r1/odom"),
        ("r1", "/map", "map"),
        ("", "/world", "world"),
        ("r1", "", ""),
    ],
)
def test_a_frames_full_name_is_the_one_that_tf_makes(prefix, frame, full):
    assert resolve_frame(prefix, frame) == full


def test_the_nearest_parameter_above_a_namespace_counts():
    with Master(port=0, rosout=False) as master, Node("n", master_uri=master.uri) as node:
        assert FramePrefixes(node).of("/r1") == ""
        node.set_param("/tf_prefix", "all")
        node.set_param("/r1/tf_prefix", "first")
        node.set_param("/r1/state/tf_prefix", "private")
        prefixes = FramePrefixes(node)
        for namespace, wanted in (
            ("", "all"),
            ("/r2", "all"),
            ("r1", "first"),
            ("/r1/front", "first"),
            ("/r1/state/", "private"),
            ("/r10", "all"),
        ):
            assert prefixes.of(namespace) == wanted
