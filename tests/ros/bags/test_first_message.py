"""Nothing is lost at the beginning of a bag."""

import threading

import pytest
from ros.graph import until

from gazelle_ros import Duration, Time, load_message
from gazelle_ros.bags import Bag
from gazelle_ros.bags.playing import Player, PlayOptions
from gazelle_ros.cli.main import main


@pytest.mark.parametrize("nanoseconds", [123456789, 123456700, 999999999, 1])
def test_the_first_message_is_played_whatever_its_stamp(make_node, tmp_path, nanoseconds):
    text = load_message("std_msgs/String")
    with Bag(tmp_path / "b.bag", "w") as bag:
        for i in range(3):
            bag.write(
                "/chatter", text(str(i)), Time(1763718123, nanoseconds) + Duration(0, i * 1_000_000)
            )
    listener, player = make_node("listener"), make_node("player")
    heard = []
    listener.subscribe("/chatter", text, lambda message: heard.append(message.data))
    options = PlayOptions(wait_for_subscribers=True)
    playing = Player(player, [str(tmp_path / "b.bag")], options)
    playing.play(threading.Event())
    playing.close()
    until(lambda: len(heard) == 3)
    assert heard == ["0", "1", "2"]


def test_remappings_are_understood_on_the_command_line(make_node, master, tmp_path, monkeypatch):
    text = load_message("std_msgs/String")
    with Bag(tmp_path / "b.bag", "w") as bag:
        bag.write("/chatter", text("hello"), Time(1763718123))
    heard = []
    make_node("listener").subscribe("/words", text, lambda message: heard.append(message.data))
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    words = ["--wait-for-subscribers", str(tmp_path / "b.bag"), "/chatter:=/words"]
    assert main(["bag", "play", "-q", *words]) == 0
    until(lambda: heard == ["hello"])
