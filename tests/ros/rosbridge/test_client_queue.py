"""Delivery of messages to a client: content, time and limits."""

from __future__ import annotations

from gazelle_ros.rosbridge.client_queue import ClientQueue, DeliverySettings, TopicQueue


class Sized(str):
    """A message that is as long as its text."""

    __slots__ = ()


def make(most=1000, **settings):
    rung = []
    outbox = ClientQueue(most, lambda: rung.append(1))
    queue = TopicQueue()
    queue.settings = DeliverySettings(**settings)
    return outbox, queue, rung


def drain(outbox, now):
    found = []
    while True:
        parcel, _ = outbox.take(now)
        if parcel is None:
            return found
        found.append(parcel.text if parcel.text is not None else str(parcel.message))


def test_messages_and_answers_keep_their_order():
    outbox, queue, rung = make()
    for text in "abc":
        outbox.offer(queue, Sized(text), 0.0)
    outbox.answer("first")
    assert len(rung) == 4
    assert drain(outbox, 0.0) == ["first", "a", "b", "c"]


def test_a_throttle_without_queue_drops_what_is_early():
    outbox, queue, _ = make(throttle=1.0)
    for step in range(31):
        outbox.offer(queue, Sized(step), step * 0.125)
    assert drain(outbox, 4.0) == ["0", "8", "16", "24"]


def test_a_throttle_with_queue_spreads_the_newest():
    outbox, queue, _ = make(throttle=1.0, queue_length=3)
    for step in range(10):
        outbox.offer(queue, Sized(step), 0.0)
    assert drain(outbox, 0.0) == ["7"]
    assert outbox.take(0.5) == (None, 1.0)
    assert drain(outbox, 1.0) == ["8"]
    assert drain(outbox, 2.5) == ["9"]
    assert outbox.take(9.0) == (None, None)


def test_a_slow_client_gets_the_newest_of_each_topic():
    outbox, fast, _ = make(most=100)
    slow = TopicQueue()
    outbox.offer(slow, Sized("map"), 0.0)
    for step in range(1000):
        outbox.offer(fast, Sized(f"{step:010d}"), 0.0)
    assert outbox.dropped > 900
    found = drain(outbox, 0.0)
    assert found[0] == "map"
    assert found[-1] == f"{999:010d}"
    assert len(found) <= 12


def test_a_topic_that_is_forgotten_is_not_sent():
    outbox, queue, _ = make()
    other = TopicQueue()
    outbox.offer(queue, Sized("a"), 0.0)
    outbox.offer(other, Sized("b"), 0.0)
    outbox.forget(queue)
    assert drain(outbox, 0.0) == ["b"]


def test_who_takes_no_answers_is_stuck():
    outbox, _, _ = make(most=10)
    outbox.answer("x" * 41)
    assert outbox.stuck
    drain(outbox, 0.0)
    assert not outbox.stuck
