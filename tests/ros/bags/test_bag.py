"""Bags: what is written is read, whole or damaged."""

from __future__ import annotations

import contextlib
import struct

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from rosbags.rosbag1 import Reader

from gazelle_ros import Time, load_message
from gazelle_ros.bags import Bag, BagError, BagFormatError, BagUnindexedError, Compression
from gazelle_ros.bags.info import as_dict, as_yaml, describe, value_of
from gazelle_ros.bags.operations import check, compile_filter, filter_bag, recompress, reindex
from gazelle_ros.base.errors import RosError
from gazelle_ros.cli.main import main

KINDS = ["none", "bz2", "lz4"]
ROWS = [("/a", "one", 1.0), ("/b", "two", 2.5), ("/a", "three", 3.0)]


def texts(path, **options):
    with Bag(path) as bag:
        return [(t, m.data, s.to_sec()) for t, m, s in bag.read_messages(**options)]


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_written_is_read(write_bag, kind):
    assert texts(write_bag(ROWS, compression=kind)) == ROWS


@settings(max_examples=30, deadline=None)
@given(
    rows=st.lists(
        st.tuples(
            st.sampled_from(["/a", "/b", "/c"]),
            st.text(max_size=50),
            st.integers(0, 2**32 - 1),
            st.integers(0, 999_999_999),
        ),
        max_size=40,
    ),
    kind=st.sampled_from(KINDS),
    threshold=st.integers(0, 500),
)
def test_any_messages_come_back_in_the_order_of_time(tmp_path_factory, rows, kind, threshold):
    path = tmp_path_factory.mktemp("bags") / "t.bag"
    string = load_message("std_msgs/String")
    with Bag(path, "w", compression=kind, chunk_threshold=threshold) as bag:
        for topic, text, seconds, nanoseconds in rows:
            bag.write(topic, string(data=text), Time(seconds, nanoseconds))
    wanted = sorted(rows, key=lambda row: row[2:])
    with Bag(path) as bag:
        found = [(t, m.data, s.secs, s.nsecs) for t, m, s in bag]
        assert bag.get_message_count() == len(rows)
    assert found == wanted


@pytest.mark.parametrize("kind", KINDS)
def test_rosbags_reads_the_same(write_bag, kind):
    path = write_bag(ROWS * 50, compression=kind, chunk_threshold=300)
    with Reader(path) as reader:
        theirs = [(c.topic, time, bytes(data)) for c, time, data in reader.messages()]
    with Bag(path) as bag:
        ours = [(t, s.to_nsec(), m[1]) for t, m, s in bag.read_messages(raw=True)]
    assert sorted(theirs) == sorted(ours)
    assert len(ours) == 150


def test_messages_can_be_chosen(write_bag):
    path = write_bag(ROWS)
    assert texts(path, topics="/a") == [ROWS[0], ROWS[2]]
    assert texts(path, topics=["a", "/nope"]) == [ROWS[0], ROWS[2]]
    assert texts(path, topics=[]) == []
    assert texts(path, start_time=Time(2), end_time=Time(2, 500_000_000)) == [ROWS[1]]
    assert texts(path, connection_filter=lambda topic, *_: topic == "/b") == [ROWS[1]]


def test_messages_can_be_read_as_bytes_with_where_they_came_from(write_bag, string):
    with Bag(write_bag(ROWS)) as bag:
        found = next(bag.read_messages(raw=True, return_connection_header=True))
    kind, data, checksum, (chunk, offset), made = found.message
    assert (kind, checksum, made) == ("std_msgs/String", string._md5sum, string)
    assert data == b"\x03\0\0\0one"
    assert chunk > 4000
    assert offset >= 0
    assert found.connection_header["topic"] == "/a"
    assert found.connection_header["message_definition"] == string._full_text


def test_bytes_and_headers_can_be_written(tmp_path, string):
    path = tmp_path / "t.bag"
    header = {"callerid": "/me", "latching": "1"}
    with Bag(path, "w") as bag:
        bag.write(
            "/a", ("std_msgs/String", b"\x01\0\0\0x", string._md5sum, string), Time(1), raw=True
        )
        bag.write("/b", string(data="y"), Time(2), connection_header=header)
    with Bag(path) as bag:
        first, second = bag.read_messages(return_connection_header=True)
    assert (first.message.data, second.message.data) == ("x", "y")
    assert second.connection_header["callerid"] == "/me"
    assert second.connection_header["latching"] == "1"


def test_types_that_are_not_known_here_are_read_with_their_definition(tmp_path):
    path = tmp_path / "t.bag"
    text = "uint8 a\nodd_msgs/Inner[] b\n" + "=" * 80 + "\nMSG: odd_msgs/Inner\nfloat64 x\n"
    raw = ("odd_msgs/Outer", struct.pack("<BId", 7, 1, 2.5), "0" * 32, None)
    with Bag(path, "w") as bag:
        kind = type("Outer", (), {"_full_text": text})
        bag.write("/o", (*raw[:3], kind), Time(1), raw=True)
    with Bag(path) as bag:
        ((_, message, _),) = bag.read_messages()
    assert (message.a, message.b[0].x) == (7, 2.5)


@pytest.mark.parametrize("kind", KINDS)
def test_bags_are_continued(write_bag, string, kind):
    path = write_bag(ROWS, compression=kind)
    with Bag(path, "a") as bag:
        assert bag.get_message_count() == 3
        bag.write("/c", string(data="four"), Time(2))
        bag.write("/a", string(data="five"), Time(9))
    assert texts(path) == [ROWS[0], ("/c", "four", 2.0), *ROWS[1:], ("/a", "five", 9.0)]


def test_a_new_bag_can_be_continued(tmp_path, string):
    with Bag(tmp_path / "n.bag", "a") as bag:
        bag.write("/c", string(data="x"), Time(2))
    assert texts(tmp_path / "n.bag") == [("/c", "x", 2.0)]


def test_what_was_written_so_far_can_be_read(tmp_path, string):
    with Bag(tmp_path / "t.bag", "w") as bag:
        for number in range(3):
            bag.write("/a", string(data=str(number)), Time(number + 1))
            assert len(list(bag.read_messages())) == number + 1


def test_what_a_bag_holds_is_told(write_bag):
    path = write_bag(ROWS, compression="bz2")
    with Bag(path) as bag:
        assert (bag.get_start_time(), bag.get_end_time()) == (1.0, 3.0)
        assert bag.get_message_count("/a") == 2
        types, topics = bag.get_type_and_topic_info()
        assert list(types) == ["std_msgs/String"]
        assert topics["/a"] == ("std_msgs/String", 2, 1, 0.5)
        assert topics["/b"].frequency is None
        assert bag.get_type_and_topic_info(["/b"]).topics.keys() == {"/b"}
        assert bag.get_compression_info().compression == "bz2"
        assert (bag.version, bag.mode, bag.size) == (200, "r", path.stat().st_size)
        assert bag.topics() == ["/a", "/b"]


def test_an_empty_bag_is_a_bag(tmp_path):
    Bag(tmp_path / "e.bag", "w").close()
    with Bag(tmp_path / "e.bag") as bag:
        assert list(bag) == []
        with pytest.raises(BagError, match="no message"):
            bag.get_start_time()
        assert "size:" in str(bag)


def test_wrong_use_is_refused(write_bag, tmp_path, string):
    path = write_bag(ROWS)
    bag = Bag(path)
    with pytest.raises(BagError, match="reading only"):
        bag.write("/a", string())
    bag.close()
    with pytest.raises(ValueError, match="closed"):
        bag.write("/a", string())
    with pytest.raises(ValueError, match="closed"):
        list(bag.read_messages())
    for options in ({"mode": "x"}, {"compression": "zip"}, {"chunk_threshold": -1}):
        with pytest.raises(ValueError):  # noqa: PT011  # as rosbag
            Bag(path, **options)
    with pytest.raises(FileNotFoundError):
        Bag(tmp_path / "nope.bag")


@pytest.mark.parametrize(
    "data", [b"", b"hello", b"#ROSBAG V1.2\n", b"#ROSBAG V2.0\n", b"#ROSBAG V2.0\n\xff\xff\xff\xff"]
)
def test_what_is_no_bag_is_refused(tmp_path, data):
    path = tmp_path / "x.bag"
    path.write_bytes(data)
    with pytest.raises(BagFormatError) as caught:
        Bag(path)
    assert caught.value.file == str(path)


def test_a_bag_without_index_says_what_to_do(write_bag, unindex):
    path = write_bag(ROWS)
    unindex(path)
    with pytest.raises(BagUnindexedError, match="bag reindex"):
        Bag(path)
    with Bag(path, allow_unindexed=True) as bag:
        assert [m.data for _, m, _ in bag] == ["one", "two", "three"]


@pytest.mark.long
@settings(max_examples=150, deadline=None)
@given(place=st.integers(0, 6000), value=st.integers(0, 255), cut=st.integers(0, 6000))
@example(place=5366, value=0, cut=1)  # a NUL in the name of the type
def test_damage_raises_nothing_but_our_errors(tmp_path_factory, place, value, cut):
    folder = tmp_path_factory.mktemp("bags")
    string = load_message("std_msgs/String")
    path = folder / "t.bag"
    with Bag(path, "w", chunk_threshold=60) as bag:
        for number in range(8):
            bag.write("/a", string(data="x" * number), Time(number + 1))
    data = bytearray(path.read_bytes())
    data[place % len(data)] = value
    if cut % 3 == 0:
        del data[cut % len(data) :]
    path.write_bytes(bytes(data))
    with contextlib.suppress(BagError):
        bag = Bag(path, allow_unindexed=True)
        with contextlib.suppress(RosError):
            for _ in bag.read_messages(raw=False):
                pass
        bag.close()


# Operations ------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_reindexing_brings_all_back(write_bag, unindex, kind):
    path = write_bag(ROWS * 20, compression=kind, chunk_threshold=200)
    before = sorted(texts(path))
    unindex(path)
    old, found = reindex(str(path))
    assert old.name == "t.orig.bag"
    assert not found.damage
    assert sorted(texts(path)) == before


def test_reindexing_a_cut_bag_saves_what_is_whole(write_bag, unindex):
    path = write_bag([("/a", f"{n:04}" * 10, n + 1.0) for n in range(100)])
    before = texts(path)
    unindex(path, keep=0.6)
    _, found = reindex(str(path))
    after = texts(path)
    assert found.damage
    assert after == before[: len(after)]
    assert 20 < len(after) < 100


def test_a_backup_is_not_overwritten(write_bag):
    path = write_bag(ROWS)
    reindex(str(path))
    with pytest.raises(BagError, match="--force"):
        reindex(str(path))
    reindex(str(path), force=True)
    assert texts(path) == ROWS


def test_compression_can_be_changed(write_bag, tmp_path):
    path = write_bag([("/a", "x" * 1000, n + 1.0) for n in range(100)])
    size = path.stat().st_size
    recompress(str(path), "bz2")
    assert path.stat().st_size < size / 5
    assert len(texts(path)) == 100
    (tmp_path / "o").mkdir()
    recompress(str(path), "none", folder=str(tmp_path / "o"))
    assert len(texts(tmp_path / "o" / "t.bag")) == 100


def test_filters_choose(write_bag, tmp_path):
    path = write_bag(ROWS)
    target = tmp_path / "f.bag"
    keep = compile_filter("topic == '/a' and (m.data != 'one' or t.secs > 5)")
    assert filter_bag(str(path), str(target), keep) == (1, 3)
    assert texts(target) == [ROWS[2]]
    with pytest.raises(BagError, match="itself"):
        filter_bag(str(path), str(path), keep)
    for wrong in ("topic ==", "", "{", "\x00", "(" * 10_000):
        with pytest.raises(BagError, match="not a Python expression"):
            compile_filter(wrong)


@pytest.mark.parametrize("expression", ["m.nope", "no / such", "t + 'a'", "1 / 0", "m[0]"])
def test_a_filter_that_fails_leaves_nothing_behind(write_bag, tmp_path, expression):
    path = write_bag(ROWS)
    with pytest.raises(BagError, match="fails: "):
        filter_bag(str(path), str(tmp_path / "f.bag"), compile_filter(expression))
    assert sorted(each.name for each in tmp_path.iterdir()) == ["t.bag"]


def test_types_are_checked(write_bag, tmp_path, string):
    assert check(str(write_bag(ROWS))) == []
    path = tmp_path / "odd.bag"
    with Bag(path, "w") as bag:
        bag.write("/a", ("std_msgs/String", b"", "0" * 32, string), Time(1), raw=True)
        bag.write("/b", ("odd_msgs/Odd", b"", "1" * 32, string), Time(1), raw=True)
    first, second = check(str(path))
    assert "odd_msgs/Odd" in first
    assert "not known" in first
    assert f"[{string._md5sum}] here" in second


# Information -----------------------------------------------------------------------------


def test_information_is_aligned(write_bag):
    with Bag(write_bag(ROWS)) as bag:
        lines = describe(bag).splitlines()
    assert lines[0].startswith("path:        ")
    assert "duration:    2.0s" in lines
    assert "compression: none [1/1 chunks]" in lines
    assert lines[-2].startswith("topics:      /a   2 msgs @ 0.5 Hz : std_msgs/String")
    assert lines[-1].startswith("             /b   1 msg           : std_msgs/String")


def test_information_is_yaml(write_bag):
    import yaml

    with Bag(write_bag(ROWS)) as bag:
        found = as_dict(bag)
    assert yaml.safe_load(as_yaml(found)) == found
    assert value_of(found, "messages") == "3"
    with pytest.raises(BagError, match="did you mean 'messages'"):
        value_of(found, "mesages")


def test_long_durations_are_in_hours(write_bag):
    with Bag(write_bag([("/a", "", 1.0), ("/a", "", 3724.0)])) as bag:
        assert "duration:    1hr 2:03s (3723s)" in describe(bag)
    with Bag(write_bag([("/a", "", 1.0), ("/a", "", 84.0)])) as bag:
        assert "duration:    1:23s (83s)" in describe(bag)


def test_compression_names_are_rosbags():
    assert tuple(KINDS) == (Compression.NONE, Compression.BZ2, Compression.LZ4)


@pytest.mark.parametrize("command", ["compress", "decompress", "reindex"])
def test_no_bag_is_replaced_if_another_cannot_be(write_bag, tmp_path, command):
    path = write_bag(ROWS)
    before = path.read_bytes()
    assert main(["bag", command, str(path), str(tmp_path / "nowhere.bag")]) == 1
    assert path.read_bytes() == before
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


def test_a_bag_that_is_named_twice_is_compressed_once(write_bag, tmp_path):
    path = write_bag(ROWS)
    assert main(["bag", "compress", str(path), f"{tmp_path}/./{path.name}"]) == 0
    assert sorted(each.name for each in tmp_path.iterdir()) == [path.name, f"{path.stem}.orig.bag"]
