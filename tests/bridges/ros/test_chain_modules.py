"""PyKDL's chains, kdl_parser_py and trac_ik_python, as scripts of arms use them."""

import math

import numpy as np
import pytest

import gazelle
import gazelle_ros as ros
from gazelle import assets, formats
from gazelle_ros.builtin import xacro

ARMS = {
    "ur5": ("base_link", "tool0", [0.3, -1.0, 1.2, -0.5, 0.7, 0.1]),
    "abb_irb120": ("base_link", None, [0.3, 0.4, -0.2, 0.5, 0.7, 0.1]),
}


@pytest.fixture(scope="module", params=ARMS)
def arm(request):
    """Return modules, the URDF, base, tip and positions of an arm."""
    file = assets.robot(request.param)
    text = xacro.expand(file, {})
    base, tip, positions = ARMS[request.param]
    tip = tip or formats.load_model(file).links[-1].name
    with ros.install():
        import kdl_parser_py.urdf
        import PyKDL
        from trac_ik_python.trac_ik import IK

    return PyKDL, kdl_parser_py.urdf, IK, text, base, tip, positions


@pytest.fixture
def chain(arm):
    _, parser, _, text, base, tip, _ = arm
    found, tree = parser.treeFromString(text)
    assert found
    return tree.getChain(base, tip)


def array(kdl, values):
    made = kdl.JntArray(len(values))
    for place, value in enumerate(values):
        made[place] = value
    return made


def place(kdl, chain, positions):
    frame = kdl.Frame()
    assert kdl.ChainFkSolverPos_recursive(chain).JntToCart(positions, frame) == 0
    return frame


@pytest.mark.long
def test_places_are_those_of_the_simulation(arm, chain):
    kdl, parser, _, text, base, _, positions = arm
    moving = [each for each in chain.segments if each.moves()]
    tip = moving[-1].getName()
    world = formats.load("empty")
    with gazelle.Simulation(world) as sim:
        robot = sim.spawn(formats.load_model_string(text), namespace="/")
        for segment, value in zip(moving, positions, strict=True):
            robot.joints[segment.getJoint().getName()].set_position(value)
        hand, origin = robot.links[tip].pose, robot.links[base].pose
    to_hand = parser.treeFromString(text)[1].getChain(base, tip)
    frame = frame_of(kdl, origin) * place(kdl, to_hand, array(kdl, positions))
    assert np.allclose(list(kdl.diff(frame, frame_of(kdl, hand))), 0.0, atol=1e-6)


def frame_of(kdl, pose):
    position, quaternion = np.ravel(pose.position), np.ravel(pose.quaternion)
    return kdl.Frame(kdl.Rotation.Quaternion(*quaternion), kdl.Vector(*position))


def test_the_jacobian_is_the_derivative(arm, chain):
    kdl, *_, positions = arm
    q = array(kdl, positions)
    jacobian = kdl.Jacobian(len(q))
    assert kdl.ChainJntToJacSolver(chain).JntToJac(q, jacobian) == 0
    before = place(kdl, chain, q)
    for column in range(len(q)):
        moved = kdl.JntArray(q)
        moved[column] += 1e-6
        slope = np.array(list(kdl.diff(before, place(kdl, chain, moved), 1e-6)))
        assert slope == pytest.approx(list(jacobian.getColumn(column)), abs=1e-4)


def test_every_solver_returns_to_the_place(arm, chain):
    kdl, *_, positions = arm
    goal = place(kdl, chain, array(kdl, positions))
    begin = array(kdl, [value + 0.1 for value in positions])
    fk, speed = kdl.ChainFkSolverPos_recursive(chain), kdl.ChainIkSolverVel_pinv(chain)
    low, high = array(kdl, [-math.pi] * len(begin)), array(kdl, [math.pi] * len(begin))
    for solver in (
        kdl.ChainIkSolverPos_NR(chain, fk, speed),
        kdl.ChainIkSolverPos_NR_JL(chain, low, high, fk, speed, 100, 1e-6),
        kdl.ChainIkSolverPos_LMA(chain),
    ):
        found = kdl.JntArray(len(begin))
        assert solver.CartToJnt(begin, goal, found) == 0
        assert np.allclose(list(kdl.diff(goal, place(kdl, chain, found))), 0.0, atol=1e-5)


def test_a_place_out_of_reach_is_an_error(arm, chain):
    kdl, *_, positions = arm
    found = kdl.JntArray(len(positions))
    far = kdl.Frame(kdl.Vector(50, 0, 0))
    assert (
        kdl.ChainIkSolverPos_LMA(chain, 1e-5, 30).CartToJnt(array(kdl, positions), far, found) < 0
    )


def test_speeds_move_the_end_as_wanted(arm, chain):
    kdl, *_, positions = arm
    q, speeds = array(kdl, positions), kdl.JntArray(len(positions))
    wanted = kdl.Twist(kdl.Vector(0.1, 0, 0.05), kdl.Vector(0, 0.2, 0))
    assert kdl.ChainIkSolverVel_pinv(chain).CartToJnt(q, wanted, speeds) == 0
    jacobian = kdl.Jacobian(len(q))
    kdl.ChainJntToJacSolver(chain).JntToJac(q, jacobian)
    assert jacobian.data @ speeds.data == pytest.approx(list(wanted), abs=1e-9)


@pytest.mark.long
def test_trac_ik_finds_positions_between_the_limits(arm, chain):
    kdl, _, solver, text, base, tip, positions = arm
    ik = solver(base, tip, urdf_string=text)
    goal = place(kdl, chain, array(kdl, positions))
    found = ik.get_ik([0.0] * ik.number_of_joints, *goal.p, *goal.M.GetQuaternion())
    assert found is not None
    lower, upper = ik.get_joint_limits()
    assert all(a - 1e-9 <= q <= b + 1e-9 for a, q, b in zip(lower, found, upper, strict=True))
    assert np.allclose(list(kdl.diff(goal, place(kdl, chain, array(kdl, found)))), 0.0, atol=1e-4)
    assert ik.get_ik([0.0] * ik.number_of_joints, 9, 9, 9, 0, 0, 0, 1) is None


def test_a_chain_made_by_hand(arm):
    kdl = arm[0]
    chain = kdl.Chain()
    chain.addSegment(kdl.Segment(kdl.Joint(kdl.Joint.RotZ), kdl.Frame(kdl.Vector(1, 0, 0))))
    chain.addSegment(
        kdl.Segment("hand", kdl.Joint("slide", kdl.Joint.TransX), kdl.Frame(kdl.Vector(1, 0, 0)))
    )
    assert (chain.getNrOfJoints(), chain.getNrOfSegments()) == (2, 2)
    frame = place(kdl, chain, array(kdl, [math.pi / 2, 0.5]))
    assert list(frame.p) == pytest.approx([0.0, 2.5, 0.0])
    wrong = kdl.ChainFkSolverPos_recursive(chain).JntToCart(kdl.JntArray(3), frame)
    assert wrong < 0


@pytest.mark.parametrize("text", ["", "<robot name='r'/>", "<sdf/>", "no xml"])
def test_what_is_no_robot_makes_no_tree(arm, text):
    assert arm[1].treeFromString(text) == (False, None)
