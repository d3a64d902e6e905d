"""Requests to end: one mechanism, without locks in handlers, whatever comes together."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
from ros.graph import until

from gazelle_ros.base.interrupts import (
    Interrupted,
    SignalRelay,
    exit_code,
    holding,
    interruptible,
    stopping,
)

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def send(number, times=1):
    for _ in range(times):
        os.kill(os.getpid(), number)


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_sets_the_event_and_calls_the_action_on_another_thread(number):
    before = [signal.getsignal(each) for each in SIGNALS]
    called = []
    with stopping(lambda: called.append(threading.current_thread())) as stop:
        assert not stop.is_set()
        send(number, times=2)
        assert stop.is_set()
        assert stop.wait(60)
        assert stop.signal == number
    assert len(called) == 1
    assert called[0] is not threading.main_thread()
    assert [signal.getsignal(each) for each in SIGNALS] == before


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_interrupts_what_waits_and_a_second_right_after_it_does_not(number, monkeypatch):
    monkeypatch.setattr("gazelle_ros.base.interrupts._SAME_S", 60.0)  # however slow it is today
    tidied = []

    def wait():
        threading.Timer(0.01, send, [number]).start()
        try:
            threading.Event().wait(60)
        finally:
            send(number)  # as `timeout` sends one to the process and one to its group
            tidied.append(number)

    with pytest.raises(Interrupted) as raised, interruptible():
        wait()
    assert tidied == [number]
    assert exit_code(raised.value) == 128 + number


@pytest.mark.parametrize("number", SIGNALS)
def test_a_timeout_interrupts_unless_the_request_was_heeded(number):
    def wait():
        send(number)
        threading.Event().wait(60)

    with pytest.raises(Interrupted) as raised, stopping(timeout=0.01) as stop:
        wait()
    assert stop.timed_out
    assert exit_code(raised.value) == 128 + number
    with stopping(timeout=0.2) as heeded:
        send(number)
        heeded.over.set()
        time.sleep(0.3)
    assert not heeded.timed_out


def test_a_timeout_lets_what_is_being_written_be_written():
    written = []

    def write():
        with holding():
            send(signal.SIGTERM)
            until(lambda: stop.timed_out)
            time.sleep(0.02)
            written.append(True)
        threading.Event().wait(60)

    with pytest.raises(Interrupted), stopping(timeout=0.01) as stop:
        write()
    assert written


def test_an_event_inside_takes_the_request_and_the_block_around_it_goes_on():
    with interruptible():
        with stopping() as stop:
            send(signal.SIGTERM)
            assert stop.wait(60)
        with stopping() as again:
            assert again.is_set(), "who asked before did not ask in vain"


def test_an_interrupt_that_a_library_makes_another_error_of_is_still_one():
    def load():
        try:
            send(signal.SIGINT)
        except KeyboardInterrupt as error:
            raise ImportError("initialization failed") from error

    with pytest.raises(Interrupted), interruptible():
        load()


@pytest.mark.long
def test_an_interrupt_that_is_swallowed_comes_again():
    swallowed = []

    def swallow():
        try:
            send(signal.SIGTERM)
        except KeyboardInterrupt as error:  # as Python does in a destructor
            swallowed.append(error)
        threading.Event().wait(60)

    with pytest.raises(Interrupted), interruptible():
        swallow()
    assert swallowed


@pytest.mark.long
def test_an_interrupt_in_a_destructor_comes_again_and_is_not_reported(monkeypatch):
    reported = []
    monkeypatch.setattr(sys, "unraisablehook", lambda lost: reported.append(lost.exc_type))

    class Frees:
        def __del__(self):
            send(signal.SIGTERM)

    class Fails:
        def __del__(self):
            raise ValueError

    def free():
        Frees()  # as Python frees a lock of an import
        Fails()
        threading.Event().wait(60)

    with pytest.raises(Interrupted), interruptible():
        free()
    assert reported == [ValueError]
    Fails()
    assert reported == [ValueError, ValueError]


@pytest.mark.long
def test_tidying_up_is_not_interrupted_however_long_it_takes():
    tidied = []

    def tidy():
        try:
            send(signal.SIGINT)
        finally:
            time.sleep(2.0)
            tidied.append(True)

    with pytest.raises(Interrupted), interruptible():
        tidy()
    assert tidied


def test_a_relay_hands_on_in_order_and_ends():
    got = []
    relay = SignalRelay(got.append)
    for number in (1, 2, 3):
        relay.post(number)
    relay.close()
    assert got == [1, 2, 3]


def test_nothing_is_handled_off_the_main_thread():
    before = signal.getsignal(signal.SIGINT)
    seen = []

    def other():
        with interruptible(), stopping() as stop:
            seen.append((signal.getsignal(signal.SIGINT), stop.is_set()))

    thread = threading.Thread(target=other)
    thread.start()
    thread.join()
    assert seen == [(before, False)]


def child(text):
    process = subprocess.Popen(
        [sys.executable, "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "ready\n"
    return process


def test_a_forked_child_has_the_handlers_of_before():
    process = child(
        "import os, signal, time\n"
        "from gazelle_ros.base.interrupts import stopping\n"
        "with stopping() as stop:\n"
        "    begun, say = os.pipe()\n"
        "    pid = os.fork()\n"
        "    if not pid:\n"
        "        os.write(say, b'x')\n"
        "        time.sleep(60)\n"
        "        os._exit(0)\n"
        "    os.read(begun, 1)\n"
        "    os.kill(pid, signal.SIGTERM)\n"
        "    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])\n"
        "    print('ready', flush=True)\n"
        "    print(code, stop.is_set())\n"
    )
    with process:  # `communicate` would lose what came along with the first line
        assert process.stdout.read() == "-15 False\n"


@pytest.mark.parametrize("package", ["gazelle", "gazelle_ros"])
def test_an_import_ends_quietly(package):
    """Ctrl-C comes while the command line is imported."""
    script = f"""if True:
        import os, signal, sys
        class Finder:
            def find_spec(self, name, *_):
                if name == "{package}.cli.main":
                    os.kill(os.getpid(), signal.SIGINT)
        sys.meta_path.insert(0, Finder())
        from {package}.__main__ import main
        main()"""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (-signal.SIGINT, "")


@pytest.mark.long
def test_what_is_inside_a_library_for_long_ends_all_the_same():
    process = child(
        "import hashlib, os, signal, threading\n"
        "from gazelle_ros.base.interrupts import interruptible\n"
        "with interruptible(ends_process=True):\n"
        "    print('ready', flush=True)\n"
        "    threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGTERM]).start()\n"
        "    hashlib.pbkdf2_hmac('sha256', b'', b'', 1_000_000_000)\n"  # minutes
    )
    assert process.wait(60) == 128 + signal.SIGTERM
    assert "interrupted" in process.stderr.read()


@pytest.mark.long
@pytest.mark.parametrize(
    ("first", "second"),
    [
        (signal.SIGINT, signal.SIGINT),
        (signal.SIGTERM, signal.SIGTERM),
        (signal.SIGINT, signal.SIGTERM),
        (signal.SIGTERM, signal.SIGINT),
    ],
)
def test_a_thousand_double_signals_end_a_thousand_waits(first, second):
    """The handlers of a master set the event that the main thread held: 5 of 40 hung.

    Of two different signals the main thread ran no handler at all: 24 of 60 hung.
    """
    process = child(
        "import signal, sys\n"
        "for number in (signal.SIGINT, signal.SIGTERM):\n"
        "    signal.signal(number, signal.SIG_IGN)\n"  # the second of two that come too late
        "from gazelle_ros.base.interrupts import stopping\n"
        "print('ready', flush=True)\n"
        "for _ in range(250):\n"
        "    with stopping() as stop:\n"
        "        print('again', flush=True)\n"
        "        stop.wait()\n"
        "print('done', flush=True)\n"
    )
    with process:
        for line in process.stdout:
            if line == "done\n":
                break
            process.send_signal(first)
            process.send_signal(second)
        else:
            pytest.fail("it ended early")
    assert process.returncode == 0
