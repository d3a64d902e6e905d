"""The same questions to our frames and to the real tf2."""

import random

import peers
import pytest

from gazelle_ros.tf import FrameTree, TransformException

pytestmark = pytest.mark.ros

S = 1_000_000_000
PEER = """
import json, sys, rospy, tf2_py
from geometry_msgs.msg import TransformStamped
asked = json.load(sys.stdin)
core = tf2_py.BufferCore(rospy.Duration(10.0))
for parent, child, stamp, t, q, static in asked["placements"]:
    m = TransformStamped()
    m.header.frame_id, m.child_frame_id = parent, child
    m.header.stamp = rospy.Time(stamp // 10**9, stamp % 10**9)
    m.transform.translation.x, m.transform.translation.y, m.transform.translation.z = t
    r = m.transform.rotation
    r.x, r.y, r.z, r.w = q
    (core.set_transform_static if static else core.set_transform)(m, "test")
def time(stamp): return rospy.Time(stamp // 10**9, stamp % 10**9)
def answer(question):
    try:
        if len(question) == 3:
            m = core.lookup_transform_core(question[0], question[1], time(question[2]))
        else:
            a, s, b, u, f = question
            m = core.lookup_transform_full_core(a, time(s), b, time(u), f)
    except tf2_py.TransformException as error:
        return [type(error).__name__, str(error)]
    t, r = m.transform.translation, m.transform.rotation
    return [m.header.stamp.to_nsec(), [t.x, t.y, t.z], [r.x, r.y, r.z, r.w]]
print(json.dumps([answer(q) for q in asked["questions"]]))
"""


def ours(tree, question):
    try:
        found = tree.lookup(*question) if len(question) == 3 else tree.lookup_full(*question)
    except TransformException as error:
        return [type(error).__name__, str(error)]
    return [found.stamp, list(found.translation), list(found.rotation)]


def random_rotation(rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    norm = sum(c * c for c in q) ** 0.5 * (1 + rng.choice([0, 0, 0.002]))
    return [c / norm for c in q]


def scene(rng):
    """Return two trees of moving and static frames, incomplete, one frame with two parents."""
    placements = []
    for index in range(1, 12):
        parent = "u" if index == 11 else f"f{rng.randrange(index)}"
        static = index % 4 == 0
        begin, step = rng.randrange(1, 3 * S), rng.randrange(S // 10, S)
        for tick in range(1 if static or index == 7 else 30):
            if index == 6 and tick == 15:
                parent = "f0"
            translation = [rng.uniform(-9, 9) for _ in range(3)]
            placements.append(
                (
                    parent,
                    f"f{index}",
                    begin + tick * step,
                    translation,
                    random_rotation(rng),
                    static,
                )
            )
    late = placements[:]
    rng.shuffle(late)
    return placements + late[:5]


@pytest.mark.parametrize("seed", range(5))
def test_answers_equal_tf2s(seed):
    peers.need("tf2_py")
    rng = random.Random(seed)
    placements = scene(rng)
    names = [f"f{index}" for index in range(12)] + ["u", "nobody", "", "/f1"]
    stamps = [0, S, 5 * S, *(rng.randrange(4 * S, 12 * S) for _ in range(30))]
    questions = [[rng.choice(names), rng.choice(names), rng.choice(stamps)] for _ in range(600)] + [
        [
            rng.choice(names),
            rng.choice(stamps),
            rng.choice(names),
            rng.choice(stamps),
            rng.choice(names),
        ]
        for _ in range(400)
    ]
    tree = FrameTree()
    for parent, child, stamp, translation, rotation, static in placements:
        tree.place(parent, child, stamp, tuple(translation), tuple(rotation), static=static)
    answers = peers.ask(PEER, {"placements": placements, "questions": questions})
    assert sum(isinstance(answer[0], int) for answer in answers) > 50
    for question, answer in zip(questions, answers, strict=True):
        mine = ours(tree, question)
        if isinstance(answer[0], str):
            assert mine == answer, question
            continue
        assert mine[0] == answer[0], question
        assert mine[1] == pytest.approx(answer[1], abs=1e-12, rel=1e-12), question
        assert mine[2] == pytest.approx(answer[2], abs=1e-12), question
