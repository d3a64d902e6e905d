"""A few message classes in genpy's form, written by hand, and helpers to wait."""

from __future__ import annotations

import contextlib
import os
import signal
import struct
import subprocess
import sys
import threading
import time
from typing import ClassVar


class Text:
    """std_msgs/String."""

    _type = "std_msgs/String"
    _md5sum = "992ce8a1687cec8c8bd883ec73ca41d1"
    _full_text = "string data\n"
    _has_header = False
    __slots__ = ("_connection_header", "data")
    _slot_types: ClassVar = ["string"]

    def __init__(self, data=""):
        self.data = data

    def serialize(self, buff):
        data = self.data.encode()
        buff.write(struct.pack(f"<I{len(data)}s", len(data), data))

    def deserialize(self, data):
        (length,) = struct.unpack_from("<I", data)
        self.data = data[4 : 4 + length].decode()
        return self


class Word:
    """std_msgs/Int32."""

    _type = "std_msgs/Int32"
    _md5sum = "da5909fbe378aeaf85e547e830cc1bb7"
    _full_text = "int32 data\n"
    _has_header = False
    __slots__ = ("_connection_header", "data")
    _slot_types: ClassVar = ["int32"]

    def __init__(self, data=0):
        self.data = data

    def serialize(self, buff):
        buff.write(struct.pack("<i", self.data))

    def deserialize(self, data):
        (self.data,) = struct.unpack_from("<i", data)
        return self


class FlagRequest:
    """std_srvs/SetBoolRequest."""

    _type = "std_srvs/SetBoolRequest"
    __slots__ = ("_connection_header", "data")

    def __init__(self, data=False):
        self.data = data

    def serialize(self, buff):
        buff.write(b"\1" if self.data else b"\0")

    def deserialize(self, data):
        self.data = data[0] != 0
        return self


class FlagResponse:
    """std_srvs/SetBoolResponse."""

    _type = "std_srvs/SetBoolResponse"
    __slots__ = ("_connection_header", "message", "success")

    def __init__(self, success=False, message=""):
        self.success = success
        self.message = message

    def serialize(self, buff):
        text = self.message.encode()
        buff.write(struct.pack(f"<BI{len(text)}s", self.success, len(text), text))

    def deserialize(self, data):
        success, length = struct.unpack_from("<BI", data)
        self.success = bool(success)
        self.message = data[5 : 5 + length].decode()
        return self


class Flag:
    """std_srvs/SetBool."""

    _type = "std_srvs/SetBool"
    _md5sum = "09fb03525b03e7ea1fd3992bafd87e16"
    _request_class = FlagRequest
    _response_class = FlagResponse


def until(condition, timeout=60.0):
    """Wait for something to become true."""
    deadline = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < deadline, "it never came true"
        time.sleep(0.002)


class Background:
    """A function in a thread, which ends when its event is set."""

    def __init__(self, function, *arguments, **keywords):
        self.stop = threading.Event()
        self.error = None

        def run():
            try:
                function(*arguments, self.stop, **keywords)
            except Exception as error:  # noqa: BLE001  # it is looked at in the test
                self.error = error

        self.thread = threading.Thread(target=run)
        self.thread.start()

    def end(self, *, stop=True):
        if stop:
            self.stop.set()
        self.thread.join(60)
        assert not self.thread.is_alive()
        if self.error is not None:
            raise self.error


@contextlib.contextmanager
def started(arguments, folder):
    """Yield a function that starts Python with these arguments and more, until the block ends."""
    made = []

    def run(*words, **env):
        command = [sys.executable, *arguments, *map(str, words)]
        process = subprocess.Popen(
            command, env=os.environ | env, cwd=folder, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        made.append(process)
        return process

    yield run
    for process in made:
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=60)
        finally:
            process.kill()
