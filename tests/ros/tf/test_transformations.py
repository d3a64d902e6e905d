"""tf.transformations: laws, scipy's rotations, and the real module's numbers."""

import math

import numpy as np
import peers
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle_ros import transformations as tr
from gazelle_ros.transformations.euler import AXES

angle = st.floats(-3.1, 3.1)
number = st.integers(-10_000, 10_000).map(lambda thousandths: thousandths / 1000)
vector = st.tuples(number, number, number)
direction = vector.filter(lambda v: np.linalg.norm(v) > 0.1)
rotation = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1)
quick = settings(max_examples=40, deadline=None)


def normal(q):
    return np.array(q) / np.linalg.norm(q)


@pytest.fixture(scope="module")
def scipy_rotation():
    return pytest.importorskip("scipy.spatial.transform", reason="scipy is not installed").Rotation


@pytest.mark.parametrize("axes", sorted(AXES))
@quick
@given(angles=st.tuples(angle, angle, angle))
def test_euler_angles_of_every_kind_agree_with_scipy(scipy_rotation, axes, angles):
    # scipy writes turns about still axes in small letters.
    letters = axes[1:] if axes[0] == "s" else axes[1:].upper()
    expected = scipy_rotation.from_euler(letters, angles).as_matrix()
    matrix = tr.euler_matrix(*angles, axes)
    assert matrix[:3, :3] == pytest.approx(expected, abs=1e-12)
    again = tr.euler_matrix(*tr.euler_from_matrix(matrix, axes), AXES[axes])
    assert again == pytest.approx(matrix, abs=1e-9)


def test_arrays_of_one_number_are_angles():
    turned = tr.quaternion_from_euler(0, np.array([0.0]), np.array([0.5], np.float32))
    assert turned == pytest.approx(tr.quaternion_from_euler(0.0, 0.0, 0.5))


@quick
@given(rotation, rotation)
def test_products_of_quaternions_are_products_of_matrices(a, b):
    product = tr.quaternion_matrix(tr.quaternion_multiply(a, b))
    assert product == pytest.approx(tr.quaternion_matrix(a) @ tr.quaternion_matrix(b), abs=1e-12)


@quick
@given(rotation)
def test_quaternion_and_matrix_are_each_others_inverse(q):
    back = tr.quaternion_from_matrix(tr.quaternion_matrix(q))
    assert abs(back @ normal(q)) == pytest.approx(1.0)
    assert tr.quaternion_multiply(q, tr.quaternion_inverse(q)) == pytest.approx([0, 0, 0, 1])


@quick
@given(rotation, rotation, st.floats(0, 1))
def test_slerp_agrees_with_scipy(scipy_rotation, a, b, fraction):
    slerp_class = pytest.importorskip("scipy.spatial.transform").Slerp
    expected = slerp_class([0, 1], scipy_rotation.from_quat([a, b]))(fraction).as_matrix()
    found = tr.quaternion_matrix(tr.quaternion_slerp(a, b, fraction))[:3, :3]
    if abs(normal(a) @ normal(b)) > 1e-3:  # half a turn apart, there are two shortest ways
        assert found == pytest.approx(expected, abs=1e-7)


@quick
@given(angle.filter(lambda a: abs(a) > 0.01), direction, vector)
def test_what_made_a_rotation_is_found_again(turn, axis, point):
    matrix = tr.rotation_matrix(turn, axis, point)
    assert matrix @ [*point, 1] == pytest.approx([*point, 1], abs=1e-9)
    found = tr.rotation_from_matrix(matrix)
    assert tr.is_same_transform(matrix, tr.rotation_matrix(*found))


@quick
@given(vector, direction)
def test_a_reflection_undoes_itself(point, axis):
    matrix = tr.reflection_matrix(point, axis)
    assert matrix @ matrix == pytest.approx(np.identity(4), abs=1e-9)
    assert tr.is_same_transform(matrix, tr.reflection_matrix(*tr.reflection_from_matrix(matrix)))


@quick
@given(st.floats(-5, 5).filter(lambda f: abs(f - 1) > 0.1), vector, direction)
def test_what_made_a_scaling_is_found_again(factor, origin, axis):
    for matrix in (tr.scale_matrix(factor, origin), tr.scale_matrix(factor, origin, axis)):
        assert tr.is_same_transform(matrix, tr.scale_matrix(*tr.scale_from_matrix(matrix)))


@quick
@given(vector, direction, direction)
def test_a_projection_projects_and_is_found_again(point, axis, along):
    unit = normal(axis)
    if abs(unit @ normal(along)) < 0.1:
        return
    matrix = tr.projection_matrix(point, axis, along)
    assert matrix @ matrix == pytest.approx(matrix, abs=1e-6)
    place, across, way, eye, pseudo = tr.projection_from_matrix(matrix)
    again = tr.projection_matrix(place, across, way, eye, pseudo)
    assert again == pytest.approx(matrix, abs=1e-6)


@quick
@given(
    st.tuples(*[st.floats(0.2, 4)] * 3),
    vector,
    st.tuples(*[st.floats(-1.4, 1.4)] * 3),
    vector,
)
def test_a_composed_matrix_comes_apart_again(scale, shear, angles, move):
    matrix = tr.compose_matrix(scale, shear, angles, move)
    parts = tr.decompose_matrix(matrix)
    assert tr.compose_matrix(*parts) == pytest.approx(matrix, abs=1e-6, rel=1e-6)
    assert parts[0] == pytest.approx(scale)
    assert parts[2] == pytest.approx(angles, abs=1e-6)
    assert parts[3] == pytest.approx(move)


@quick
@given(rotation, vector, st.booleans(), st.integers(0, 2**32 - 1))
def test_the_transform_between_points_is_found(q, move, usesvd, seed):
    points = np.random.default_rng(seed).normal(size=(3, 12))
    goal = 2.0 * (tr.quaternion_matrix(q)[:3, :3] @ points) + np.array(move)[:, None]
    found = tr.superimposition_matrix(points, goal, True, usesvd)
    assert found[:3, :3] @ points + found[:3, 3:] == pytest.approx(goal, abs=1e-6)


def test_random_rotations_are_rotations():
    matrix = tr.random_rotation_matrix()
    assert matrix @ matrix.T == pytest.approx(np.identity(4), abs=1e-12)
    assert np.linalg.norm(tr.random_quaternion()) == pytest.approx(1.0)
    assert tr.random_vector(10).shape == (10,)


def test_a_dragged_ball_turns_about_the_view():
    ball = tr.Arcball()
    ball.place([320, 320], 320)
    ball.down([320, 320])
    ball.drag([480, 320])
    quarter = ball.matrix()
    assert not tr.is_same_transform(quarter, np.identity(4))
    ball.next()
    assert tr.is_same_transform(ball.matrix(), quarter @ quarter)
    ball.setaxes([1, 0, 0], [0, 1, 0])
    ball.setconstrain(True)
    ball.down([400, 320])
    ball.drag([420, 321])
    assert ball.getconstrain()


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: tr.rotation_from_matrix(2 * np.eye(4)), "eigenvalue 1"),
        (lambda: tr.reflection_from_matrix(np.eye(4)), "eigenvalue -1"),
        (lambda: tr.projection_from_matrix(np.eye(4)), "eigenvalue 0"),
        (lambda: tr.decompose_matrix(np.zeros((4, 4))), "is zero"),
        (lambda: tr.clip_matrix(1, 0, 0, 1, 0, 1), "invalid frustrum"),
        (lambda: tr.shear_matrix(0.3, [1, 0, 0], [0, 0, 0], [1, 0, 0]), "not orthogonal"),
        (lambda: tr.superimposition_matrix(np.eye(3)[:2], np.eye(3)), "wrong shape"),
    ],
)
def test_impossible_arguments_are_refused(call, text):
    with pytest.raises(ValueError, match=text):
        call()


PEER = """
import json, sys, numpy, warnings
warnings.simplefilter("ignore")
import tf.transformations as tr
def plain(value):
    if isinstance(value, numpy.ndarray): return value.tolist()
    if isinstance(value, (list, tuple)): return [plain(each) for each in value]
    if isinstance(value, numpy.generic): return value.item()
    return value
def call(name, args):
    if name.startswith("arcball:"):
        ball = tr.Arcball(args[0]); ball.place(*args[1])
        if args[2]: ball.setaxes(*args[2]); ball.setconstrain(True)
        ball.down(args[3]); ball.drag(args[4]); ball.next(*args[5:]); return ball.matrix()
    return getattr(tr, name)(*args)
def array(name, value): return numpy.array(value) if isinstance(value, list) and name[-1] != ":" else value
print(json.dumps([plain(call(n, [array(n, a) for a in args])) for n, args in json.load(sys.stdin)]))
"""


def questions(rng):
    """Return every function, with random arguments."""

    def v():
        return rng.normal(size=3).tolist()

    def q():
        return normal(rng.normal(size=4)).tolist()

    def a():
        return float(rng.uniform(-3, 3))

    m, n = tr.quaternion_matrix(q()), tr.rotation_matrix(a(), v(), v())
    axis = v()
    side = np.cross(axis, v()).tolist()
    points = rng.normal(size=(3, 8))
    goal = (tr.quaternion_matrix(q())[:3, :3] @ points + 1.0).tolist()
    composed = tr.compose_matrix(
        rng.uniform(0.3, 2, 3), v(), rng.uniform(-1, 1, 3), v(), [0.1, 0.2, 0.1, 1.0]
    )
    asked = [
        ("translation_matrix", [v()]),
        ("translation_from_matrix", [n.tolist()]),
        ("reflection_matrix", [v(), v()]),
        ("rotation_matrix", [a(), v()]),
        ("rotation_matrix", [a(), v(), v()]),
        ("scale_matrix", [a(), v()]),
        ("scale_matrix", [a(), v(), v()]),
        ("projection_matrix", [v(), v()]),
        ("projection_matrix", [v(), v(), v()]),
        ("projection_matrix", [v(), v(), None, v(), True]),
        ("projection_matrix", [v(), v(), None, v()]),
        ("clip_matrix", [-1, 2.5, -3, 4, 1, 6, False]),
        ("clip_matrix", [-1, 2.5, -3, 4, 1, 6, True]),
        ("shear_matrix", [0.7, side, v(), axis]),
        ("decompose_matrix", [composed.tolist()]),
        ("compose_matrix", [v(), v(), v(), v(), [0.1, 0.2, 0.1, 1.0]]),
        ("orthogonalization_matrix", [[10, 11, 12], [80, 95, 100]]),
        ("superimposition_matrix", [points.tolist(), goal, True, True]),
        ("superimposition_matrix", [points.tolist(), goal, False, False]),
        ("quaternion_about_axis", [a(), v()]),
        ("quaternion_matrix", [rng.normal(size=4).tolist()]),
        ("quaternion_from_matrix", [m.tolist()]),
        ("quaternion_multiply", [q(), q()]),
        ("quaternion_conjugate", [q()]),
        ("quaternion_inverse", [rng.normal(size=4).tolist()]),
        ("quaternion_slerp", [q(), q(), 0.3]),
        ("quaternion_slerp", [q(), q(), 0.3, 1, False]),
        ("random_quaternion", [rng.random(3).tolist()]),
        ("random_rotation_matrix", [rng.random(3).tolist()]),
        ("arcball_map_to_sphere", [[3.0, 4.0], [1.0, 2.0], 5.0]),
        ("arcball_map_to_sphere", [[30.0, 4.0], [1.0, 2.0], 5.0]),
        ("arcball_constrain_to_axis", [normal(v()).tolist(), normal(v()).tolist()]),
        ("arcball:", [q(), [[320, 320], 320], None, [350, 300], [200, 410]]),
        ("arcball:", [None, [[320, 320], 320], [v(), v()], [350, 300], [200, 410], 0.5]),
        ("vector_norm", [v()]),
        ("vector_norm", [rng.normal(size=(3, 2)).tolist(), 1]),
        ("unit_vector", [v()]),
        ("unit_vector", [rng.normal(size=(3, 2)).tolist(), 0]),
        ("inverse_matrix", [n.tolist()]),
        ("concatenate_matrices", [n.tolist(), m.tolist()]),
        ("is_same_transform", [n.tolist(), (2 * n).tolist()]),
        ("identity_matrix", []),
    ]
    for axes in AXES:
        asked += [
            ("euler_matrix", [a(), a(), a(), axes]),
            ("quaternion_from_euler", [a(), a(), a(), axes]),
            ("euler_from_matrix", [m.tolist(), axes]),
            ("euler_from_quaternion", [q(), axes]),
            ("euler_from_matrix", [np.eye(4).tolist(), axes]),
        ]
    return asked


def flat(value):
    if value is None or isinstance(value, bool):
        return [float(bool(value))]
    if isinstance(value, (tuple, list)):
        return [number for each in value for number in flat(each)]
    return np.ravel(value).tolist()


def call_ours(name, args):
    if name != "arcball:":
        return getattr(tr, name)(*args)
    ball = tr.Arcball(args[0])
    ball.place(*args[1])
    if args[2]:
        ball.setaxes(*args[2])
        ball.setconstrain(True)
    ball.down(args[3])
    ball.drag(args[4])
    ball.next(*args[5:])
    return ball.matrix()


@pytest.mark.long
@pytest.mark.ros
def test_every_function_gives_the_real_modules_numbers():
    peers.need("tf.transformations")
    asked = [question for seed in range(5) for question in questions(np.random.default_rng(seed))]
    for (name, args), answer in zip(asked, peers.ask(PEER, asked), strict=True):
        mine = call_ours(name, args)
        assert flat(mine) == pytest.approx(flat(answer), abs=1e-9), (name, args)


@pytest.mark.ros
def test_every_public_name_is_there():
    peers.need("tf.transformations")
    listing = (
        "import json, tf.transformations as t; print(json.dumps([n for n in dir(t) "
        "if getattr(getattr(t, n), '__module__', '') == t.__name__ and n[0] != '_']))"
    )
    assert set(peers.ask(listing, None)) <= set(tr.__all__)


def test_the_half_turn_has_a_quaternion():
    matrix = tr.rotation_matrix(math.pi, [1, 0, 0])
    assert tr.quaternion_from_matrix(matrix) == pytest.approx([1, 0, 0, 0], abs=1e-9)
