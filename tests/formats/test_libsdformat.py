"""Our short way to libsdformat says what the long one says."""

import shutil
import subprocess

import pytest
from libsdformat import ign_sdf, needed

FILES = {
    "good": "<sdf version='1.6'><model name='m'><link name='l'/></model></sdf>",
    "without a link": "<sdf version='1.6'><model name='m'/></sdf>",
    "broken": "<sdf version='1.6'><model",
}


@pytest.mark.long
@pytest.mark.parametrize("option", ["-p", "-k"])
@pytest.mark.parametrize("text", FILES.values(), ids=FILES)
def test_it_is_as_if_typed(tmp_path, text, option):
    needed()
    file = tmp_path / "a.sdf"
    file.write_text(text)
    assert shutil.which("ign") is not None
    typed = subprocess.run(
        ["ign", "sdf", option, str(file)], capture_output=True, text=True, check=False
    )
    found = ign_sdf(option, file)
    assert (found.returncode, found.stdout) == (typed.returncode, typed.stdout)
    assert [line for line in typed.stderr.splitlines() if line not in found.stderr] == [
        line for line in typed.stderr.splitlines() if "Library error" in line
    ]
