"""Launch files of the corpus come up, with the topics and frames that a table says."""

from __future__ import annotations

import pytest
from launch_table import HUSKY, HUSKY_INCLUDES, QUICK, REFUSED, SLOW
from launching import Launched, stub_packages
from ros.graph import until

from gazelle_ros import Master

pytestmark = pytest.mark.corpus


def check(expected, corpus, folder):
    topics, frames = set(expected.topics.split()), set(expected.frames.split())
    with (
        Master(port=0) as master,
        Launched(master.uri, corpus, folder, expected.file) as launched,
    ):
        launched.wait_for(expected.models.split(), topics, frames)
        found, said = launched.look(), launched.said
        assert found.topics == topics
        assert found.frames == frames
        for words in expected.missing:
            assert words in said, said
        assert said.count("ERROR: a node is left out") == expected.left_out
        assert "Traceback" not in said
        assert "process has died" not in said
        assert launched.close() == 0


@pytest.mark.long
@pytest.mark.parametrize("expected", QUICK, ids=lambda each: each.file)
def test_a_launch_file_comes_up_with_its_topics_and_frames(expected, corpus, tmp_path):
    check(expected, corpus, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("expected", SLOW, ids=lambda each: each.file)
def test_this_one_too(expected, corpus, tmp_path):
    check(expected, corpus, tmp_path)


@pytest.mark.slow
def test_the_husky_comes_up_where_the_packages_it_includes_are(corpus, tmp_path):
    packages = stub_packages(tmp_path, HUSKY_INCLUDES)
    check(HUSKY, f"{packages}:{corpus}", tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("file", REFUSED)
def test_what_is_not_in_the_corpus_is_named(file, corpus, tmp_path):
    with Master(port=0) as master, Launched(master.uri, corpus, tmp_path, file) as launched:
        until(lambda: all(words in launched.said for words in REFUSED[file]))
        assert "Traceback" not in launched.said
