"""Recording, replay, hashes and faults."""

import json

import numpy as np
import pytest
import scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.description import Mesh, Pose
from gazelle.engines import Call, DivergenceError
from gazelle.errors import Error, FormatError, SimulationError, SimulationWarning
from gazelle.simulation import Replay, Simulation
from gazelle.simulation.encoding import decode, encode


def world(*more):
    return scenes.world(scenes.ground(), *scenes.square(), *more)


def busy_run(sim):
    """Run a bit of everything."""
    robot = sim.robots["burger"]
    robot.inputs["cmd_vel"].send(linear=np.linspace(0.1, 0.2, sim.nworld), angular=0.5)
    sim.run(0.2)
    sim.spawn(scenes.box(pose=Pose(1.0, 0.5, 0.3)), name="crate")
    crate = sim.robots["crate"].links["link"]
    crate.apply_wrench((1.0, 0.0, 0.0), start=0.3, duration=0.1)
    sim.run(0.2)
    sim.physics.time_step = 0.002
    sim.parameters.link_mass["crate::link"] = 2.0
    sim.robots["north"].set_pose((0.0, 2.0, 0.0))
    sim.attach(robot.links["base_footprint"], crate)
    sim.run(0.1)
    robot.set_pose((0.3, 0.0, 0.0), yaw=1.0)
    sim.delete("crate")
    sim.reset([0])
    robot.joints["wheel_left_joint"].velocity = 1.0
    sim.step(7)


def test_a_run_replays_to_the_same_bits(tmp_path):
    path = tmp_path / "run.jsonl"
    with Simulation(world(scenes.burger()), nworld=2, seed=5) as sim:
        sim.run(0.1)
        with sim.record(path):
            busy_run(sim)
        end, now = sim.state_hash(), sim.clock.now_ns
        sim.run(0.1)
    with Replay(path) as replay:
        assert replay.run() > 5
        assert replay.done
        assert replay.simulation.state_hash() == end
        assert replay.simulation.clock.now_ns == now
        assert set(replay.simulation.robots) == set(sim.robots)


def test_a_recording_that_was_cut_off_replays_up_to_there(tmp_path):
    path = tmp_path / "run.jsonl"
    with Simulation(world(scenes.burger())) as sim, sim.record(path):
        for _ in range(10):
            sim.step(5)
    steps = path.read_text().count('"call":"step"')
    path.write_bytes(path.read_bytes()[:-20])
    with Replay(path) as replay:
        assert replay.run() == steps - 1


def test_a_different_outcome_is_noticed(tmp_path):
    path = tmp_path / "run.jsonl"
    with Simulation(world(scenes.burger())) as sim, sim.record(path):
        for _ in range(3):
            sim.step(5)
    lines = path.read_text().splitlines()
    last = json.loads(lines[-1])
    last["hash"] = "0" * 16
    path.write_text("\n".join([*lines[:-1], json.dumps(last)]))
    with (
        Replay(path) as replay,
        pytest.raises(SimulationError, match=r"at 0\.015 s .* not the recorded"),
    ):
        replay.run()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "not a recording"),
        ("[]", "not a recording"),
        ('{"format": "other"}', "not a recording"),
        (
            '{"format": "gazelle-recording", "version": 99}',
            "version 99, this Gazelle reads version 3",
        ),
    ],
)
def test_what_is_no_recording_is_refused(tmp_path, text, message):
    path = tmp_path / "run.jsonl"
    path.write_text(text)
    with pytest.raises(SimulationError, match=message):
        Replay(path)


@pytest.mark.parametrize(
    ("line", "key", "value"),
    [
        (0, "state", {"#": "array", "type": "<f8", "shape": [1]}),
        (0, "engine", 5),
        (0, "time", None),
        (0, "history", [5]),
        (-1, "call", "close"),
        (-1, "call", "_run"),
        (-1, "call", None),
        (-1, "arguments", 7),
        (-1, "arguments", ["many"]),
        (-1, "time", "late"),
    ],
)
def test_a_damaged_recording_is_named_with_its_line(balls, tmp_path, line, key, value):
    path = tmp_path / "run.jsonl"
    with Simulation(balls) as sim, sim.record(path):
        sim.step(3)
    lines = path.read_text().splitlines()
    lines[line] = json.dumps({**json.loads(lines[line]), key: value})
    path.write_text("\n".join(lines) + "\n")
    number = 1 if line == 0 else len(lines)
    message = rf"run\.jsonl:{number}: |no engine '5'"
    with pytest.raises(Error, match=message) as caught, Replay(path) as replay:
        replay.run()
    assert "\n" not in str(caught.value)


def test_a_broken_line_in_the_middle_is_no_cut_off_end(balls, tmp_path):
    path = tmp_path / "run.jsonl"
    with Simulation(balls) as sim, sim.record(path):
        for _ in range(3):
            sim.step()
    lines = path.read_text().splitlines()
    lines[2] = lines[2][:20]
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(SimulationError, match=r"run\.jsonl:3: .*damaged"):
        Replay(path)


def test_a_recorder_lets_go_of_the_engine(tmp_path):
    with Simulation(world()) as sim:
        recorder = sim.record(tmp_path / "run.jsonl")
        assert "step" in vars(sim.engine)
        recorder.close()
        recorder.close()
        assert "step" not in vars(sim.engine)


def test_the_hash_of_a_world_does_not_depend_on_the_others():
    def hashes(nworld):
        with Simulation(world(scenes.burger()), nworld=nworld) as sim:
            sim.robots["burger"].inputs["cmd_vel"].send(linear=0.1 * np.arange(1, nworld + 1))
            sim.run(0.3)
            return [sim.state_hash([i]) for i in range(nworld)]

    three = hashes(3)
    assert len(set(three)) == 3
    assert hashes(1)[0] == three[0]


# -- faults ------------------------------------------------------------------------------


def poison(sim, world):
    sim.robots["ball"].links["link"].set_twist((1e12, 0.0, 0.0), (0, 0, 0), np.array([world]))


@pytest.fixture
def balls():
    model = scenes.ball(pose=Pose(z=1.0))
    return scenes.world(scenes.ground(), model, scenes.burger(pose=Pose(2.0)))


def reference(balls, steps):
    """Return the state hash of an undisturbed world."""
    with Simulation(balls) as sim:
        sim.step(steps)
        return sim.state_hash()


def test_a_broken_world_is_named_and_dumped_and_the_others_go_on(balls, tmp_path):
    dump = tmp_path / "fault.jsonl"
    with Simulation(balls, nworld=4, fault_dump=dump) as sim:
        sim.step(30)
        poison(sim, 2)
        with pytest.raises(DivergenceError, match=r"1 of 4 .*world 2.*fault\.jsonl"):
            sim.step(10)
        assert sim.clock.now_ns == 40_000_000  # the other worlds made all steps
        (fault,) = sim.faults
        assert (fault.world, fault.time, fault.dump) == (2, 0.03, dump)
        assert sim.robots["ball"].position[2, 2] == 1.0
        sim.step(10)
        others = {sim.state_hash([i]) for i in (0, 1, 3)}
        assert others == {reference(balls, 50)}
    with Replay(dump) as replay, pytest.raises(DivergenceError):
        replay.run()


def test_a_broken_world_can_be_reset_instead(balls):
    with Simulation(balls, nworld=3, on_fault="reset") as sim:
        sim.step(30)
        poison(sim, 0)
        with pytest.warns(SimulationWarning, match="world 0"):
            sim.step(20)
        assert len(sim.faults) == 1
        sim.faults[0].dump.unlink()
        assert {sim.state_hash([1]), sim.state_hash([2])} == {reference(balls, 50)}
        sim.step(10)
        assert np.isfinite(sim.engine.snapshot()).all()


def test_a_run_that_went_on_after_a_fault_replays(balls, tmp_path):
    path = tmp_path / "run.jsonl"
    with Simulation(balls, nworld=2, on_fault="reset", fault_dump=tmp_path / "f.jsonl") as sim:
        with sim.record(path):
            sim.step(10)
            poison(sim, 1)
            with pytest.warns(SimulationWarning, match="world 1"):
                sim.step(10)
            sim.step(10)
        end = sim.state_hash()
    with Replay(path) as replay:
        replay.run()
        assert replay.simulation.state_hash() == end


def test_a_nan_command_of_one_world_breaks_only_that_world(balls, tmp_path):
    with Simulation(balls, nworld=2, fault_dump=tmp_path / "f.jsonl") as sim:
        force = np.array([[np.nan, 0.0, 0.0]])
        sim.engine.links["ball::link"].set_wrench(force, np.zeros(3), np.array([1]))
        with pytest.raises(DivergenceError, match="not finite had been set before"):
            sim.step(5)
        assert sim.state_hash([0]) == reference(balls, 5)
        sim.step(5)


def test_faults_do_not_fill_the_disk(balls, tmp_path):
    with Simulation(balls, nworld=2, fault_dump=tmp_path / "f.jsonl", on_fault="reset") as sim:
        for _ in range(12):
            poison(sim, 1)
            with pytest.warns(SimulationWarning):
                sim.step(2)
        assert len(sim.faults) == 12
        assert len(list(tmp_path.iterdir())) == 10


def test_an_unknown_policy_is_refused(balls):
    with pytest.raises(SimulationError, match="did you mean 'reset'"):
        Simulation(balls, on_fault="resett")


# -- encoding ----------------------------------------------------------------------------

plain = st.recursive(
    st.none() | st.booleans() | st.integers(-1000, 1000) | st.floats(allow_nan=False) | st.text(),
    lambda inner: st.lists(inner) | st.lists(inner).map(tuple) | st.dictionaries(st.text(), inner),
    max_leaves=20,
)


@given(plain)
@settings(max_examples=50)
def test_what_is_encoded_comes_back(value):
    assert decode(json.loads(json.dumps(encode(value)))) == value


def test_descriptions_arrays_and_calls_come_back_to_the_bit():
    from pathlib import Path

    burger = scenes.burger(pose=Pose(0.1, 0.2, 0.3, 0.4, 0.5, 0.6), stddev=0.01)
    mesh = Mesh("package://x/y.stl", Path("/tmp/y.stl"))
    values = np.array([[0.1, np.inf, -0.0]])
    back = decode(json.loads(json.dumps(encode((world(burger), mesh, Call("reset", (values,)))))))
    assert back[0] == world(burger)
    assert back[1] == mesh
    np.testing.assert_array_equal(back[2].arguments[0], values)


@pytest.mark.parametrize("value", [object(), {1, 2}])
def test_what_cannot_be_written_is_refused(value):
    with pytest.raises(SimulationError, match="cannot be recorded"):
        encode(value)


def test_what_nobody_wrote_is_refused():
    with pytest.raises(SimulationError, match=r"no kind of value 'os\.system'"):
        decode({"#": "os.system"})
    with pytest.raises(SimulationError, match="objects"):
        decode({"#": "array", "type": "|O", "shape": [1], "data": ""})
    with pytest.raises(FormatError, match="a pose takes"):
        decode({"#": "pose", "position": ["a", 0.0, 0.0], "quaternion": [0.0, 0.0, 0.0, 1.0]})


def test_a_recording_does_not_tell_where_steps_were_cut_for_the_sake_of_others(tmp_path):
    """How long the physics is stepped at once depends on the machine; a recording does not."""
    texts = []
    for name in ("a", "b"):
        with Simulation("empty") as sim, sim.record(tmp_path / name):
            sim.step(700 if name == "a" else 1)
            sim.reset()
            sim.run(1.0)
            sim.step(3)
        texts.append((tmp_path / name).read_text().splitlines()[3:])
    assert texts[0] == texts[1]
    assert len(texts[0]) == 2


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
def test_a_recording_may_be_closed_after_its_simulation(tmp_path, engine):
    sim = Simulation(world(), engine, threads=1)
    recorder = sim.record(tmp_path / "run.jsonl")
    sim.step(3)
    sim.close()
    recorder.close()
    with Replay(tmp_path / "run.jsonl") as replay:
        assert replay.run() == 1
        assert replay.simulation.clock.now_ns == 3 * replay.simulation.clock.step_ns
