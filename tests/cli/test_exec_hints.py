"""Hints of `gazelle exec` at missing scripts and modules."""

import pytest


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            "turtlebot3_gazebo nosuch",
            "gazelle launch turtlebot3_gazebo put_robot_in_world.launch |",
        ),
        ("turtlebot3_gazebo", "'turtlebot3_gazebo' is a package: name one of its programs too"),
        ("map_server", "there are: map_saver, map_server"),
        ("map_server map_servr", "did you mean 'map_server'?"),
        ("actionlib nosuch", "Gazelle brings no programs of it"),
        ("turtlebot3_gazeb nosuch", "did you mean 'turtlebot3_gazebo'?"),
        ("rosrun turtlebot3_gazeb nosuch", "did you mean 'turtlebot3_gazebo'?"),
        ("nosuch.py nosuch", "nosuch.py: cannot read the script"),
        ("some/where nosuch", "some/where: cannot read the script"),
    ],
)
def test_what_is_not_there_is_told_with_what_is(cli, monkeypatch, words, said):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    code, _, err = cli("exec", *words.split())
    assert code == 1
    assert said in " ".join(err.split())
    assert "C++" not in err
