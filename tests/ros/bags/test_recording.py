"""Recording and playing, between nodes of this process."""

from __future__ import annotations

import math
import threading
import time

import pytest
from ros.graph import until

from gazelle_ros import Time, WallClock, load_message
from gazelle_ros.bags import Bag, BagError
from gazelle_ros.bags.playing import Player, PlayOptions
from gazelle_ros.bags.recording import BagRecorder, RecordOptions, check, duration_of
from gazelle_ros.errors import RosError


@pytest.fixture
def record(make_node, tmp_path):
    """Yield a recorder in the background.

    The fixture's function stops it and returns the files.
    """
    made = []

    def run(**options):
        stop = threading.Event()
        options.setdefault("name", str(tmp_path / "r"))
        recorder = BagRecorder(make_node("recorder"), RecordOptions(**options), lambda text: None)
        thread = threading.Thread(target=recorder.run, args=(stop,))
        thread.start()
        made.append((stop, thread))

        def end():
            stop.set()
            thread.join(60)
            return list(recorder.files)

        end.recorder, end.thread = recorder, thread
        return end

    yield run
    for stop, thread in made:
        stop.set()
        thread.join(60)


@pytest.fixture
def play(make_node):
    def run(*paths, show=None, stop=None, **options):
        node = make_node("player", clock=WallClock())
        player = Player(node, [str(path) for path in paths], PlayOptions(**options), show)
        try:
            player.play(stop or threading.Event())
        finally:
            player.close()
            node.close()

    return run


def contents(path):
    with Bag(path) as bag:
        return [(t, m.data) for t, m, _ in bag]


# Recording -------------------------------------------------------------------------------


def test_topics_are_recorded_with_where_they_came_from(record, make_node, string):
    talker = make_node("talker")
    publisher = talker.advertise("a", string)
    end = record(topics=["/a"])
    until(lambda: publisher.num_connections)
    for number in range(5):
        publisher.publish(string(data=str(number)))
    until(lambda: end.recorder._counts["/a"] == 5)
    (path,) = end()
    assert contents(path) == [("/a", str(number)) for number in range(5)]
    with Bag(path) as bag:
        (connection,) = bag.index.connections.values()
        assert connection.header["callerid"] == "/talker"
        assert bag.get_end_time() - bag.get_start_time() < 60.0
        assert abs(bag.get_end_time() - time.time()) < 60.0


def test_new_topics_are_found_and_some_left_out(record, make_node, string):
    end = record(all_topics=True, exclude="/b.*")
    talker = make_node("talker")
    publishers = {name: talker.advertise(name, string, latch=True) for name in ("/a", "/b1", "/c")}
    for name, publisher in publishers.items():
        publisher.publish(string(data=name))
    until(lambda: end.recorder._counts["/a"] and end.recorder._counts["/c"])
    (path,) = end()
    assert sorted(contents(path)) == [("/a", "/a"), ("/c", "/c")]


def test_topics_may_be_patterns(record, make_node, string):
    talker = make_node("talker")
    publishers = [talker.advertise(name, string, latch=True) for name in ("/x1", "/x2", "/y")]
    for publisher in publishers:
        publisher.publish(string(data=publisher.name))
    end = record(topics=["/x[0-9]"], regex=True)
    until(lambda: end.recorder._counts["/x1"] and end.recorder._counts["/x2"])
    (path,) = end()
    assert sorted(contents(path)) == [("/x1", "/x1"), ("/x2", "/x2")]


def test_a_limit_of_messages_ends_it(record, make_node, string):
    publisher = make_node("talker").advertise("a", string)
    end = record(topics=["/a"], limit=3)
    until(lambda: publisher.num_connections)
    for number in range(10):
        publisher.publish(string(data=str(number)))
    until(end.recorder.done.is_set)
    (path,) = end()
    assert contents(path) == [("/a", "0"), ("/a", "1"), ("/a", "2")]


def test_files_are_split_by_size(record, make_node, string, tmp_path):
    publisher = make_node("talker").advertise("a", string, queue_size=None)
    end = record(topics=["/a"], split=True, size=20_000, chunk_bytes=1000)
    until(lambda: publisher.num_connections)
    for number in range(60):
        publisher.publish(string(data=f"{number:02}" * 500))
    until(lambda: end.recorder._counts["/a"] == 60)
    paths = end()
    assert [path.name for path in paths] == [f"r_{number}.bag" for number in range(len(paths))]
    assert len(paths) > 2
    assert [t[1][:2] for path in paths for t in contents(path)] == [f"{n:02}" for n in range(60)]
    assert not list(tmp_path.glob("*.active"))


def test_old_files_are_deleted(record, make_node, string):
    publisher = make_node("talker").advertise("a", string, queue_size=None)
    end = record(topics=["/a"], split=True, size=5000, chunk_bytes=500, most_files=2)
    until(lambda: publisher.num_connections)
    for _ in range(40):
        publisher.publish(string(data="x" * 1000))
    until(lambda: end.recorder._counts["/a"] == 40)
    paths = end()
    assert len(paths) == 2
    assert all(path.exists() for path in paths)
    assert not paths[0].with_name("r_0.bag").exists()


def test_the_name_of_each_file_is_published(record, make_node, string):
    names = []
    make_node("watcher").subscribe("/begin_write", string, lambda m: names.append(m.data))
    record(topics=["/a"], publish=True)
    until(lambda: names)
    assert names[0].endswith(".bag")


def test_a_duration_ends_it(record, make_node, string):
    make_node("talker").advertise("a", string)
    end = record(topics=["/a"], duration=0.3)
    end.thread.join(60)
    assert not end.thread.is_alive()
    (path,) = end()
    assert contents(path) == []


@pytest.mark.parametrize(("text", "seconds"), [("30", 30.0), ("1.5m", 90.0), ("2h", 7200.0)])
def test_durations_have_units(text, seconds):
    assert duration_of(text) == seconds


@pytest.mark.parametrize("text", ["", "x", "5d", "-1"])
def test_wrong_durations_are_refused(text):
    with pytest.raises(BagError):
        duration_of(text)


@pytest.mark.parametrize(
    "options", [{}, {"all_topics": True, "split": True}, {"topics": ["/a"], "size": 5}]
)
def test_nothing_to_record_is_refused(options):
    with pytest.raises(BagError):
        check(RecordOptions(**options))


# Playing ---------------------------------------------------------------------------------


@pytest.fixture
def heard(make_node, string):
    """Return the messages on ``/a`` and ``/b``, with their times."""
    found = []
    node = make_node("listener")
    for topic in ("/a", "/b", "/p/a"):
        node.subscribe(
            topic, string, lambda m, t=topic: found.append((t, m.data, time.monotonic()))
        )
    return found


ROWS = [("/a", "1", 10.0), ("/b", "2", 10.2), ("/a", "3", 10.6)]


def said(heard, number):
    """Return the topics and texts that were played, once there are so many."""
    until(lambda: len(heard) >= number)
    return [(topic, text) for topic, text, _ in heard]


@pytest.mark.parametrize(("rate", "tolerance"), [(1.0, 0.08), (4.0, 0.04)])
def test_messages_come_at_the_times_they_were_recorded(play, write_bag, heard, rate, tolerance):
    path, best = write_bag(ROWS), [math.inf] * 3
    # A thread may be late for each of them now and then, but not always.
    for _ in range(50):
        heard.clear()
        begin = time.monotonic()
        play(path, rate=rate)
        assert said(heard, 3) == [row[:2] for row in ROWS]
        best = [min(then, came - begin) for then, (_, _, came) in zip(best, heard, strict=True)]
        after = [(each - best[0]) * rate for each in best]
        if after == pytest.approx([0.0, 0.2, 0.6], abs=tolerance * rate):
            break
    assert after == pytest.approx([0.0, 0.2, 0.6], abs=tolerance * rate)


def test_a_part_can_be_played(play, write_bag, heard):
    play(write_bag(ROWS), start=0.1, duration=0.3)
    assert said(heard, 1) == [("/b", "2")]


def test_topics_can_be_chosen_and_renamed(play, write_bag, heard):
    play(write_bag(ROWS), topics=["/a"], prefix="/p", rate=10.0)
    assert said(heard, 2) == [("/p/a", "1"), ("/p/a", "3")]


def test_immediately_means_without_waiting(play, write_bag, heard):
    begin = time.monotonic()
    play(write_bag([("/a", str(n), 10.0 * n + 1) for n in range(200)]), immediate=True)
    assert time.monotonic() - begin < 60.0, "the bag lasts half an hour"
    until(lambda: len(heard) == 200)
    assert [text for _, text, _ in heard] == [str(n) for n in range(200)]


def test_several_bags_are_merged(play, write_bag, heard):
    one = write_bag([("/a", "1", 10.0), ("/a", "3", 10.2)], "one.bag")
    two = write_bag([("/b", "2", 10.1)], "two.bag")
    play(one, two)
    assert [text for _, text in said(heard, 3)] == ["1", "2", "3"]


def test_gaps_are_skipped(play, write_bag, heard):
    begin = time.monotonic()
    play(write_bag([("/a", "1", 10.0), ("/a", "2", 10.1), ("/a", "3", 500.0)]), skip_empty=1.0)
    assert time.monotonic() - begin < 60.0, "the bag lasts eight minutes"
    assert len(said(heard, 3)) == 3


def test_loops_until_it_is_stopped(play, write_bag, heard):
    stop = threading.Event()
    thread = threading.Thread(
        target=play, args=(write_bag(ROWS),), kwargs={"stop": stop, "loop": True, "rate": 20.0}
    )
    thread.start()
    until(lambda: len(heard) >= 7)
    stop.set()
    thread.join(60)
    assert said(heard, 7)[:6] == [row[:2] for row in ROWS] * 2


def test_the_clock_runs_with_the_bag(play, write_bag, make_node):
    times = []
    make_node("watch").subscribe(
        "/clock", load_message("rosgraph_msgs/Clock"), lambda m: times.append(m.clock.to_sec())
    )
    path = write_bag(ROWS)

    good = set()
    for _ in range(50):  # a thread may be late now and then, but not always
        times.clear()
        play(path, clock=True, clock_hertz=50.0, rate=2.0)
        assert times == sorted(times)
        assert len(times) <= 20
        good |= {"first"} if times[0] == pytest.approx(10.0, abs=0.05) else set()
        good |= {"last"} if times[-1] == pytest.approx(10.6, abs=0.05) else set()
        good |= {"number"} if len(times) >= 8 else set()
        if len(good) == 3:
            break
    assert good == {"first", "last", "number"}


@pytest.mark.long
def test_it_begins_paused_steps_and_goes_on(write_bag, make_node, heard):
    node = make_node("player", clock=WallClock())
    player = Player(node, [str(write_bag(ROWS))], PlayOptions(paused=True))
    stop = threading.Event()
    thread = threading.Thread(target=player.play, args=(stop,))
    thread.start()
    time.sleep(0.5)
    assert heard == []
    player.step()
    until(lambda: len(heard) == 1)
    player.step()
    until(lambda: len(heard) == 2)
    time.sleep(0.5)
    assert len(heard) == 2
    player.toggle()
    until(lambda: len(heard) == 3)
    thread.join(60)
    player.close()
    assert said(heard, 3) == [row[:2] for row in ROWS]


def test_latched_topics_are_latched_again(play, tmp_path, string, make_node):
    path = tmp_path / "l.bag"
    with Bag(path, "w") as bag:
        bag.write("/a", string(data="kept"), Time(5), connection_header={"latching": "1"})
    stop, got = threading.Event(), []
    thread = threading.Thread(target=play, args=(path,), kwargs={"stop": stop, "keep_alive": True})
    thread.start()
    time.sleep(0.6)
    make_node("late").subscribe("/a", string, lambda m: got.append(m.data))
    until(lambda: got == ["kept"])
    stop.set()
    thread.join(60)


def test_an_empty_bag_plays_nothing(play, tmp_path):
    Bag(tmp_path / "e.bag", "w").close()
    play(tmp_path / "e.bag")


@pytest.mark.parametrize(
    "options", [{"topics": ["a:b"]}, {"topics": ["/a", "1x"]}, {"node": "a b"}]
)
def test_wrong_names_leave_no_bag(make_node, tmp_path, options):
    chosen = RecordOptions(name=str(tmp_path / "r"), **options)
    with pytest.raises(RosError, match="names hold letters"):
        BagRecorder(make_node("recorder"), chosen, lambda text: None).run(threading.Event())
    assert not list(tmp_path.iterdir())
