"""Plots of rows of numbers that a topic tells."""

from __future__ import annotations

import pytest
from PIL import Image

from gazelle.errors import FormatError
from gazelle.training.deploy.messages import floats_message
from gazelle.viewer.graph.topic_plot import TopicPlot
from gazelle_ros import Master, Node


@pytest.fixture
def nodes():
    with (
        Master(port=0, rosout=False) as master,
        Node("talker", master_uri=master.uri) as talker,
        Node("plot", master_uri=master.uri) as plot,
    ):
        yield talker, plot


def told(plot, rows):
    """Return the plot's content after messages."""
    for labels, values in rows:
        message = floats_message(labels, values)
        if not labels:
            message.layout.dim = []
        plot._receive(message)
    return plot._names, list(plot._rows)


def make(nodes, file, keep=None):
    return TopicPlot(nodes[1], "result", ("score", "max_q"), "results", keep, file)


def test_it_draws_only_what_is_new(nodes, tmp_path):
    file = tmp_path / "result.png"
    plot = make(nodes, file)
    assert not plot.draw()
    assert not file.exists()
    told(plot, [([], [1.0, 2.0]), ([], [3.0, 4.0])])
    assert plot.draw()
    assert not plot.draw()
    with Image.open(file) as picture:
        assert picture.size[0] > 400


def test_labels_name_the_numbers_and_others_begin_anew(nodes, tmp_path):
    names, rows = told(
        make(nodes, tmp_path / "a.png"),
        [([], [1, 2]), ([], [1, 2, 3]), (["a", "b", "c"], [4, 5, 6])],
    )
    assert names == ("a", "b", "c")
    assert rows == [(4, 5, 6)]


def test_the_latest_rows_are_kept(nodes, tmp_path):
    _, rows = told(make(nodes, tmp_path / "a.png", keep=3), [([], [n, n]) for n in range(9)])
    assert rows == [(6, 6), (7, 7), (8, 8)]


def test_a_file_of_another_kind_is_refused(nodes, tmp_path):
    plot = make(nodes, tmp_path / "result.gif")
    told(plot, [([], [1, 2])])
    with pytest.raises(FormatError, match="a plot is written as"):
        plot.draw()
