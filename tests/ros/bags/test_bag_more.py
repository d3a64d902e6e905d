"""Bags: streams, changes while writing, bags that were cut off, fixing."""

from __future__ import annotations

import io
import math
import tracemalloc

import pytest

from gazelle_ros import Duration, Time
from gazelle_ros.bags import Bag, BagFormatError, BagUnindexedError, compression
from gazelle_ros.cli.main import main
from gazelle_ros.messages import class_from_text

ROWS = [("/a", "one", 1.0), ("/b", "two", 2.5), ("/a", "three", 3.0)]


def texts(path):
    with Bag(path) as bag:
        return [(t, m.data, s.to_sec()) for t, m, s in bag.read_messages()]


def test_a_bag_may_be_in_a_stream(string):
    written = io.BytesIO()
    with Bag(written, "w") as bag:
        bag.write("/a", string(data="x"), Time(1))
        assert bag.get_message_count() == 1
    with Bag(io.BytesIO(written.getvalue())) as bag:
        assert [m.data for _, m, _ in bag] == ["x"]
    with pytest.raises(TypeError):
        Bag(3)
    with pytest.raises(ValueError, match="not appended"):
        Bag(io.BytesIO(), "a")


def test_how_it_is_written_can_change_meanwhile(tmp_path, string):
    path = tmp_path / "x.bag"
    with Bag(path, "w") as bag:
        bag.write("/a", string(data="x" * 1000), Time(1))
        bag.compression = "bz2"
        bag.chunk_threshold = 10
        for second in (2, 3):
            bag.write("/a", string(data="x" * 1000), Time(second))
        assert bag.options == {"compression": "bz2", "chunk_threshold": 10}
        for name, value in (("compression", "zip"), ("chunk_threshold", -1)):
            with pytest.raises(ValueError, match=name):
                setattr(bag, name, value)
    with Bag(path) as bag:
        assert bag.get_compression_info().compression == "bz2"
        assert len(list(bag.reindex())) == 3
        assert [m.data for _, m, _ in bag] == ["x" * 1000] * 3


def test_a_bag_that_was_cut_off_can_be_appended_to(write_bag, unindex, string):
    path = write_bag(ROWS)
    unindex(path)
    with pytest.raises(BagUnindexedError):
        Bag(path, "a")
    with Bag(path, "a", allow_unindexed=True) as bag:
        assert list(bag.reindex())
        bag.write("/a", string(data="four"), Time(4))
    assert texts(path) == [*ROWS, ("/a", "four", 4.0)]


def test_a_bag_is_fixed_if_its_types_are_known(write_bag, tmp_path, capsys):
    source, target = str(write_bag(ROWS)), str(tmp_path / "fixed.bag")
    assert main(["bag", "fix", source, target]) == 0
    assert capsys.readouterr().out == "Bag migrated successfully.\n"
    assert texts(target) == ROWS
    assert main(["bag", "fix", source, target, "old.bmr"]) == 2
    assert "rules of migration are not run" in capsys.readouterr().err


def test_a_bag_with_an_old_type_is_not_fixed_without_force(tmp_path, capsys):
    source, target = tmp_path / "old.bag", tmp_path / "new.bag"
    old = class_from_text("std_msgs/String", "int32 other\n")
    with Bag(source, "w") as bag:
        bag.write("/a", old(other=3), Time(1))
    assert main(["bag", "fix", str(source), str(target)]) == 1
    assert "std_msgs/String" in capsys.readouterr().err
    assert not target.exists()
    assert main(["bag", "fix", "--force", str(source), str(target)]) == 0
    with Bag(target) as bag:
        assert [m.other for _, m, _ in bag] == [3]


@pytest.mark.parametrize("stamp", [Time(2**32, 0), Time(10**400, 0), Duration(-1, 0)])
def test_times_that_a_bag_cannot_hold_leave_it_whole(tmp_path, string, stamp):
    with Bag(tmp_path / "a.bag", "w") as bag:
        bag.write("/a", string(data="first"), Time(2**32 - 1, 999_999_999))
        with pytest.raises(ValueError, match="t is invalid"):
            bag.write("/b", string(data="wrong"), stamp)
    with Bag(tmp_path / "a.bag") as bag:
        assert [message.message.data for message in bag.read_messages()] == ["first"]
        assert bag.topics() == ["/a"]


@pytest.mark.parametrize("size", [-1, math.inf, -math.inf, math.nan])
def test_sizes_of_chunks_that_cannot_be(tmp_path, size):
    for options in ({"chunk_threshold": size}, {"options": {"chunk_threshold": size}}):
        with pytest.raises(ValueError, match="greater than or equal to zero"):
            Bag(tmp_path / "a.bag", "w", **options)
    assert not (tmp_path / "a.bag").exists()
    with (
        Bag(tmp_path / "a.bag", "w") as bag,
        pytest.raises(ValueError, match="greater than or equal to zero"),
    ):
        bag.chunk_threshold = size


@pytest.mark.parametrize("kind", ["bz2", "lz4"])
@pytest.mark.parametrize("size", [0, 10, 2**32 - 1])
def test_a_chunk_that_grows_beyond_its_size_or_the_limit_is_refused(kind, size, monkeypatch):
    monkeypatch.setattr(compression, "LARGEST", 100_000)
    packed = compression.compress(kind, bytes(50_000_000))
    tracemalloc.start()
    with pytest.raises(BagFormatError, match="more than"):
        compression.decompress(kind, packed, size)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 10_000_000


@pytest.mark.parametrize("kind", ["bz2", "lz4"])
@pytest.mark.parametrize("data", [b"", b"a", bytes(range(256)) * 1000])
def test_chunks_are_compressed_and_decompressed_whole(kind, data):
    packed = compression.compress(kind, data)
    assert compression.decompress(kind, packed, len(data)) == data
    assert compression.decompress(kind, memoryview(packed), 0) == data
    with pytest.raises(BagFormatError, match="cannot be decompressed"):
        compression.decompress(kind, packed[:-3], len(data))
