"""Checks of wheels refuse what another machine could not use."""

from __future__ import annotations

import importlib.util
import subprocess
import zipfile
from pathlib import Path

import pytest

_FILE = Path(__file__).parents[1] / "tools" / "compiling" / "wheel_checks.py"
_SPEC = importlib.util.spec_from_file_location("wheel_checks", _FILE)
assert _SPEC is not None
assert _SPEC.loader is not None
checks = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(checks)

LINUX, ARM = "manylinux_2_17_x86_64", "manylinux_2_17_aarch64"


def module(platform, content=b""):
    """Return first bytes of a compiled module of a platform."""
    machine = checks.ELF_MACHINES.get(platform, 0).to_bytes(2, "little")
    return checks.MAGIC[platform].ljust(18, b"\0") + machine + content


def wheel(folder, platform=LINUX, tags="cp311-abi3", **files):
    made = folder / f"gazelle-1.0-{tags}-{platform}.whl"
    with zipfile.ZipFile(made, "w") as archive:
        for name, content in files.items():
            archive.writestr(f"gazelle/{name.replace('__', '.')}", content)
    return made


@pytest.mark.parametrize("platform", list(checks.MAGIC))
def test_modules_of_the_wheels_own_platform_pass(tmp_path, platform):
    name = "a" + checks.ENDINGS[platform.split("_")[0]].replace(".", "__")
    checks.check_modules(wheel(tmp_path, platform, **{name: module(platform)}), ["/home/me"])


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"a__abi3__so": module(LINUX), "tags": "cp312-cp312"}, "is not for cp311-abi3"),
        ({"readme__txt": b""}, "holds no compiled module"),
        ({"a__abi3__so": module(ARM)}, "of another system"),
        ({"a__abi3__so": module("win_amd64")}, "of another system"),
        ({"a__pyd": module(LINUX)}, "of another system"),
        ({"a__cpython-311__so": module(LINUX)}, "of another system"),
        ({"a__abi3__so": module(LINUX), "a__c": b""}, "left of its building"),
        ({"a__abi3__so": module(LINUX), "a__o": b""}, "left of its building"),
        ({"a__abi3__so": module(LINUX, b"x/home/me/src")}, "names /home/me"),
    ],
)
def test_modules_that_others_cannot_use_are_refused(tmp_path, options, text):
    with pytest.raises(SystemExit, match=text):
        checks.check_modules(wheel(tmp_path, **options), ["/home/me"])


def test_a_large_wheel_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(checks, "LARGEST", 1e-5)
    with pytest.raises(SystemExit, match="at most 0 are allowed"):
        checks.check(wheel(tmp_path, a__abi3__so=module(LINUX)), [])


@pytest.mark.parametrize(
    ("said", "passes"),
    [
        ('platform tag: "manylinux_2_17_x86_64"', True),
        ('platform tag:\n"manylinux_2_5_x86_64"', True),
        ('platform tag: "manylinux_2_28_x86_64"', False),
        ('platform tag: "linux_x86_64"', False),
    ],
)
def test_symbols_of_a_newer_glibc_are_refused(tmp_path, monkeypatch, said, passes):
    done = subprocess.CompletedProcess([], 0, said, "")
    monkeypatch.setattr(checks.subprocess, "run", lambda *_, **__: done)
    made = wheel(tmp_path, a__abi3__so=module(LINUX))
    if passes:
        checks.check_manylinux(made)
    else:
        with pytest.raises(SystemExit, match=r"does not run with glibc 2\.17"):
            checks.check_manylinux(made)
