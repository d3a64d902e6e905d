"""Files by their addresses."""

import pytest

import gazelle_ros as ros
from gazelle import assets
from gazelle_ros.base.errors import Error


@pytest.fixture
def retriever(monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    with ros.install():
        import resource_retriever

        yield resource_retriever


def test_files_of_packages(retriever, tmp_path):
    url = "package://fetch_description/robots/fetch.urdf"
    file = assets.root() / "fetch_description" / "robots" / "fetch.urdf"
    assert retriever.get(url) == file.read_bytes()
    assert retriever.get_filename(url) == f"file://{file}"
    assert retriever.get_filename(url, use_protocol=False) == str(file)
    own = tmp_path / "a b.txt"
    own.write_text("x")
    assert retriever.get(f"file://{tmp_path}/a%20b.txt") == b"x"


def test_files_that_stand_elsewhere(retriever):
    assert b"<sdf" in retriever.get("package://turtlebot3_gazebo/worlds/empty.world")


@pytest.mark.parametrize(
    "url",
    ["package://no_such_package/a", "package://", "package://amcl", "http://a/b", "a.txt",
     "package://amcl/nothing.txt", "file:///nowhere/at/all"],
)  # fmt: skip
def test_what_is_not_there(retriever, url):
    with pytest.raises(Error):
        retriever.get(url)
