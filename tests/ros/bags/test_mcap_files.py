"""Bags as MCAP files: read back by the reader of MCAP's own makers."""

from __future__ import annotations

import pytest
from mcap.reader import make_reader

from gazelle_ros import Time, load_message
from gazelle_ros.bags import Bag, BagError
from gazelle_ros.bags.mcap_files import write_mcap
from gazelle_ros.cli.main import main


@pytest.fixture
def bag(tmp_path):
    path = tmp_path / "drive.bag"
    text, twist = load_message("std_msgs/String"), load_message("geometry_msgs/TwistStamped")
    with Bag(str(path), "w", compression="bz2") as out:
        for k in range(20):
            out.write("/said", text(data=f"word {k}"), Time(100 + k, 5))
            message = twist()
            message.header.seq, message.twist.linear.x = k, 0.5 * k
            out.write("/speed", message, Time(100 + k, 7))
    return path


def test_every_message_is_there_with_its_time_and_type(bag, tmp_path):
    target = tmp_path / "drive.mcap"
    assert write_mcap(str(bag), str(target)) == 40
    with target.open("rb") as file:
        reader = make_reader(file)
        assert reader.get_header().profile == "ros1"
        found = list(reader.iter_messages())
    with Bag(str(bag)) as source:
        wanted = list(source.read_messages(raw=True))
    assert len(found) == len(wanted) == 40
    for (schema, channel, message), (topic, raw, stamp) in zip(found, wanted, strict=True):
        assert (channel.topic, channel.message_encoding) == (topic, "ros1")
        assert (schema.name, schema.encoding) == (raw[0], "ros1msg")
        assert channel.metadata["md5sum"] == raw[2]
        assert message.data == raw[1]
        assert message.log_time == stamp.to_nsec()
    assert {schema.name: schema.data.decode() for schema, *_ in found}[
        "std_msgs/String"
    ].strip() == (load_message("std_msgs/String")._full_text.strip())


def test_the_command_names_the_file_after_the_bag(bag, capsys):
    assert main(["bag", "to-mcap", str(bag)]) == 0
    assert "drive.mcap: 40 messages" in capsys.readouterr().out
    assert bag.with_suffix(".mcap").exists()


def test_nothing_is_overwritten_and_nothing_half_done_stays(bag, tmp_path):
    target = tmp_path / "there.mcap"
    target.write_text("mine")
    with pytest.raises(BagError, match="there is such a file already"):
        write_mcap(str(bag), str(target))
    assert target.read_text() == "mine"
    (tmp_path / "no.bag").write_text("not a bag")
    with pytest.raises(BagError):
        write_mcap(str(tmp_path / "no.bag"), str(tmp_path / "no.mcap"))
    assert not list(tmp_path.glob("no.mcap*"))
