"""Threads that read and write a running simulation, whatever it offers."""

from __future__ import annotations

import copy
import inspect
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import numpy as np
import pytest
from public_handles import CHANGING, Everything, arrays_in, handles, kind_of

import gazelle
from gazelle.errors import Error, SimulationError
from gazelle.simulation import ModelPlugin, Simulation, register

THREADS = 8

# Read without asking: they are replaced as a whole, never changed.
UNCHANGING = {"nworld", "time_step", "world"}

ENGINES = ("mujoco", "planar")


def burger(engine, seed=3):
    sim = Simulation("turtlebot3_world", engine, threads=1, seed=seed)
    sim.spawn("turtlebot3_burger", name="r")
    sim.robots["r"].inputs["cmd_vel"].send(0.2, 0.6)
    return sim


def quiet(reading):
    """Return a reading; None if this engine or model lacks it."""
    try:
        return reading()
    except Error:
        return None


class Guarded:
    """An engine that only the owner of the state may use."""

    def __init__(self, engine, intruders):
        self.__dict__.update(engine=engine, intruders=intruders, lock=None)

    def __getattr__(self, name):
        lock = self.__dict__["lock"]
        owned = lock is None or lock.owner == threading.get_ident()
        if not owned and name not in UNCHANGING:
            self.intruders.append(name)
        return getattr(self.engine, name)


@pytest.fixture
def watched(monkeypatch):
    """Return a maker of a simulation and the list of others' calls on its engine."""
    import gazelle.simulation.simulation as module

    intruders, make = [], module.make_engine
    monkeypatch.setattr(module, "make_engine", lambda *a, **k: Guarded(make(*a, **k), intruders))

    def made(engine):
        sim = burger(engine)
        sim._engine.lock = sim.lock
        return sim, intruders

    return made


@pytest.mark.parametrize("engine", ENGINES)
def test_only_the_owner_touches_the_engine_whatever_is_read(watched, engine):
    sim, intruders = watched(engine)
    with sim:
        intruders.clear()
        for reading in Everything(sim).readings:
            quiet(reading)
            assert not intruders, reading.path


def call_for(name):
    """Return arguments of a method that changes something."""
    known = {
        "set_pose": ((0.1, 0.0, 0.0),),
        "set_twist": ((0.1, 0.0, 0.0), (0.0, 0.0, 0.1)),
        "apply_wrench": ((0.1, 0.0, 0.0),),
        "apply_effort": (0.001,),
        "drive": (0.1,),
        "add_motor": (1.0,),
        "scale_mass": ("r::base_footprint", 1.01),
        "randomize": ("link_mass", "r::base_footprint", 0.5, 0.6),
        "set_configuration": (["wheel_left_joint"], [0.1]),
        "delete": ("ros_symbol",),
        "load_plugin": ("none_such.so",),
        "set_light": ("sun",),
        "use": ("default_physics",),
        "limit_rate": (5.0,),
        "subscribe": (lambda *_: None,),
        "reseed": (1, None),
        "spawn": ("shapes",),
    }
    return known.get(name, ())


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("engine", ENGINES)
def test_only_the_owner_touches_the_engine_whatever_is_written(watched, engine):
    sim, intruders = watched(engine)
    with sim:
        for path, handle in list(handles(sim)):
            kind = kind_of(handle)
            for name in sorted(CHANGING[kind] - {"close", "bind", "back_to", "step", "run"}):
                intruders.clear()
                with suppress(Error, TypeError, KeyError, ValueError):
                    getattr(handle, name)(*call_for(name))
                assert not intruders, f"{path}.{name}"
            for name, member in inspect.getmembers(kind, lambda m: isinstance(m, property)):
                if member.fset is not None:
                    intruders.clear()
                    value = quiet(lambda h=handle, n=name: getattr(h, n))
                    with suppress(Error):
                        setattr(handle, name, 0.1 if value is None else value)
                    assert not intruders, f"{path}.{name} = ..."


@pytest.mark.parametrize("engine", ENGINES)
def test_what_was_read_is_the_readers_own(engine):
    """It does not change with the simulation, nor the simulation with it."""
    with burger(engine) as sim, burger(engine) as other:
        sim.run(0.1)
        other.run(0.1)
        every = Everything(sim)
        kept = []
        for reading in every.readings:
            if reading.name == "peek":
                continue  # says so
            value = quiet(reading)
            kept.append((reading.path, value, copy.deepcopy(list(arrays_in(value)))))
        sim.run(0.1)
        for path, value, before in kept:
            for now, then in zip(arrays_in(value), before, strict=True):
                assert np.array_equal(now, then, equal_nan=now.dtype.kind == "f"), path
        for _, value, _ in kept:
            for array in arrays_in(value):
                if array.flags.writeable and array.dtype.kind == "f":
                    array[...] = 7.0
        for reading in Everything(other).readings:
            quiet(reading)
        other.run(0.1)
        sim.run(0.1)
        other.run(0.1)
        assert sim.state_hash() == other.state_hash()


def hammer(sim, threads, least):
    """Step while threads read everything, until each has read so often; returns for how long."""
    readings = Everything(sim).readings
    done, counts = threading.Event(), [0] * threads

    def read(number):
        mine = readings[number::threads] + readings
        while not done.is_set():
            for reading in mine:
                quiet(reading)
                counts[number] += 1
                if done.is_set():
                    return

    with ThreadPoolExecutor(threads) as pool:
        futures = [pool.submit(read, number) for number in range(threads)]
        try:
            while min(counts) < least and not any(future.done() for future in futures):
                sim.run(0.1)
        finally:
            done.set()
        for future in futures:
            future.result(timeout=60.0)
    return sim.time


def hash_of_a_quiet_run(engine, seconds):
    with burger(engine) as sim:
        sim.run(seconds)
        return sim.state_hash()


@pytest.mark.parametrize("engine", ENGINES)
def test_eight_threads_that_read_everything_change_no_bit(engine):
    with burger(engine) as sim:
        seconds = hammer(sim, THREADS, 20)
        assert sim.state_hash() == hash_of_a_quiet_run(engine, seconds)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ENGINES)
def test_eight_threads_that_read_everything_for_long_change_no_bit(engine):
    with burger(engine) as sim:
        seconds = hammer(sim, THREADS, 600)
        assert sim.state_hash() == hash_of_a_quiet_run(engine, seconds)


def writes(engine):
    """Return commands for a burger; each changes the physics."""
    both = [
        lambda sim, k: sim.robots["r"].inputs["cmd_vel"].send(0.01 * k, 0.02 * k),
        lambda sim, k: sim.robots["r"].set_pose((0.002 * k, 0.1, 0.01)),
        lambda sim, k: sim.robots["r"].set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.01 * k)),
        lambda sim, k: setattr(sim.robots["r"].joints["wheel_left_joint"], "position", 0.1 * k),
        lambda sim, k: sim.robots["r"].links["base_footprint"].set_pose((0.003 * k, 0.0, 0.01)),
        lambda sim, k: sim.robots["r"].sensors["lds_lfcd_sensor"].read(),
        lambda sim, k: sim.robots["r"].set_configuration(["wheel_right_joint"], [0.1 * k]),
        lambda sim, k: setattr(sim.physics, "gravity", (0.0, 0.0, -9.0 - 0.01 * k)),
    ]
    if engine == "planar":
        return both
    return [
        lambda sim, k: setattr(sim.robots["r"].joints["wheel_left_joint"], "velocity", 0.1 * k),
        lambda sim, k: setattr(sim.robots["r"].joints["wheel_right_joint"], "effort", 0.001 * k),
        lambda sim, k: (
            sim.robots["r"].links["base_footprint"].apply_wrench((0.1 * k, 0.0, 0.0), duration=0.01)
        ),
        lambda sim, k: sim.parameters.scale_mass("r::base_footprint", 1.0 + 0.01 * k),
        lambda sim, k: sim.parameters.friction.__setitem__(
            "r::wheel_left_link::wheel_left_link_collision", 0.5 + 0.01 * k
        ),
        *both,
    ]


def write_from_threads(engine, least, pause):
    """Return the final hash of a run that threads write into, and the log of writes."""
    log = []
    with burger(engine) as sim:
        todo, done = writes(engine), threading.Event()

        def write(number):
            count = 0
            while not done.is_set():
                count += 1
                with sim.lock:
                    log.append((sim.clock.now_ns, number, count % 10))
                    todo[number](sim, count % 10)
                time.sleep(pause)

        with ThreadPoolExecutor(len(todo)) as pool:
            futures = [pool.submit(write, number) for number in range(len(todo))]
            try:
                while len(log) < least and not any(future.done() for future in futures):
                    sim.run(0.05)
            finally:
                done.set()
            for future in futures:
                future.result(timeout=60.0)
        sim.run(0.05)
        assert len(log) >= least
        return sim.state_hash(), sim.clock.now_ns, log


def write_again(engine, end_ns, log):
    """Return the final hash of a run into which one thread writes the same at the same times."""
    with burger(engine) as sim:
        todo = writes(engine)
        for time_ns, number, count in log:
            sim.step((time_ns - sim.clock.now_ns) // sim.clock.step_ns)
            todo[number](sim, count)
        sim.step((end_ns - sim.clock.now_ns) // sim.clock.step_ns)
        return sim.state_hash()


@pytest.mark.long
@pytest.mark.filterwarnings("ignore::gazelle.errors.EngineWarning")
@pytest.mark.parametrize("engine", ENGINES)
def test_what_threads_write_does_the_same_as_one_thread_that_writes_it_at_those_times(engine):
    found, end_ns, log = write_from_threads(engine, 150, 0.002)
    assert len({number for _, number, _ in log}) == len(writes(engine))
    assert found == write_again(engine, end_ns, log)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::gazelle.errors.EngineWarning")
@pytest.mark.parametrize("engine", ENGINES)
def test_what_threads_write_for_long_does_the_same_as_one_thread(engine):
    found, end_ns, log = write_from_threads(engine, 2000, 0.0005)
    assert found == write_again(engine, end_ns, log)


@pytest.mark.long
@pytest.mark.parametrize("engine", ENGINES)
def test_a_reader_is_answered_soon_while_the_simulation_runs_and_while_it_rests(engine):
    with burger(engine) as sim:
        done, waits = threading.Event(), []

        def read():
            while not done.is_set():
                begin = time.perf_counter()
                sim.robots["r"].pose  # noqa: B018
                waits.append(time.perf_counter() - begin)
                time.sleep(0.001)

        reader = threading.Thread(target=read)
        reader.start()
        sim.run(20.0 if engine == "planar" else 3.0)
        while len(waits) < 10:  # a busy machine may have left the reader waiting
            sim.run(1.0)
        time.sleep(0.05)
        done.set()
        reader.join()
        assert np.quantile(waits, 0.2) < 0.5


def test_a_reader_is_answered_soon_though_nothing_else_is_due_for_long():
    """With no plugin and no sensor the physics would be stepped to the end at once."""
    with Simulation("empty", threads=1) as sim:
        waits = []

        def read():
            while sim.time == 0.0:
                time.sleep(0.001)
            for _ in range(20):
                begin = time.perf_counter()
                sim.robots["ground_plane"].pose  # noqa: B018
                sim.parameters.gravity  # noqa: B018
                waits.append(time.perf_counter() - begin)
            sim.pause()

        reader = threading.Thread(target=read)
        reader.start()
        sim.run(1e5)
        reader.join()
        assert sim.time < 1e5
        assert np.quantile(waits, 0.2) < 0.5


class Waiting(ModelPlugin):
    """Waits, in its update, for another thread to do something."""

    update_rate = 10.0
    wait = staticmethod(lambda: None)

    def on_update(self, time):
        del time
        type(self).wait()


def joined(work):
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()


def answered(work):
    with ThreadPoolExecutor(1) as pool:
        pool.submit(work).result()


def locked(work):
    """Run into a deadlock: both take a lock, and the other has it."""
    lock, held = threading.Lock(), threading.Event()

    def hold():
        with lock:
            held.set()
            work()

    other = threading.Thread(target=hold)
    other.start()
    held.wait()
    with lock:
        pass
    other.join()


@pytest.mark.parametrize("way", [joined, answered, locked])
@pytest.mark.parametrize("wish", ["read", "step"])
def test_a_thread_that_a_callback_waits_for_gets_an_error_and_no_deadlock(way, wish, monkeypatch):
    monkeypatch.setattr("gazelle.simulation.deadlocks._PATIENCE", 0.4)
    register("libwaiting_test.so", Waiting)
    errors = []
    with Simulation("empty", threads=1) as sim:
        robot = sim.spawn(
            gazelle.description.Model(
                "m",
                static=True,
                plugins=(gazelle.description.Plugin("w", "libwaiting_test.so"),),
            )
        )

        def work():
            try:
                robot.pose if wish == "read" else sim.step()
            except SimulationError as error:
                errors.append(str(error))

        Waiting.wait = staticmethod(lambda: way(work) if not errors else None)
        begin = time.monotonic()
        sim.run(0.5)
        assert time.monotonic() - begin < 60.0
        assert sim.time == pytest.approx(0.5)
    assert "waits for another thread at" in errors[0]
    assert "test_threads.py" in errors[0]


def test_closing_ends_all_who_wait_with_one_clear_error():
    sim = burger("mujoco")
    errors, began = [], threading.Event()

    def go_on(work):
        try:
            while True:
                began.set()
                work()
        except SimulationError as error:
            errors.append(error.message)

    read = sim.robots["r"].placement
    works = [lambda: sim.run(100.0), read, read, read, sim.physics.set]
    threads = [threading.Thread(target=go_on, args=(work,)) for work in works]
    for thread in threads:
        thread.start()
    began.wait()
    time.sleep(0.1)
    sim.close()
    for thread in threads:
        thread.join(timeout=60.0)
        assert not thread.is_alive()
    assert errors == ["the simulation is closed"] * len(works)
    with pytest.raises(SimulationError, match="the simulation is closed"):
        sim.robots["r"].pose  # noqa: B018
    sim.close()
