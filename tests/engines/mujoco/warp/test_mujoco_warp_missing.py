"""The engine `mujoco-warp` without its packages, or with a MuJoCo over Gazelle's, says what to type."""

import importlib
import subprocess
import sys

import pytest

from gazelle import assets
from gazelle.engines import engine_names, make_engine
from gazelle.engines.mujoco import installation
from gazelle.errors import EngineError
from gazelle.formats import load

COMMANDS = ('pip install "gazelle[warp]"', 'pip install --no-deps "mujoco-warp>=4"')


def without(monkeypatch, *names, error=None):
    """Make imports of these modules fail."""
    really = importlib.import_module

    def fake(name, *rest):
        if name in names:
            raise error or ModuleNotFoundError(f"No module named '{name}'", name=name)
        return really(name, *rest)

    monkeypatch.setattr(installation.importlib, "import_module", fake)


@pytest.mark.parametrize(
    ("module", "package"), [("warp", "warp-lang"), ("mujoco_warp", "mujoco-warp")]
)
def test_a_missing_package_is_named_with_the_commands(monkeypatch, module, package):
    if module == "mujoco_warp":
        monkeypatch.setitem(sys.modules, "warp", Warp())
    without(monkeypatch, module)
    with pytest.raises(EngineError, match=f"'{package}'") as caught:
        installation.check_packages()
    assert all(command in caught.value.hint for command in COMMANDS)


class Warp:
    """As much of Warp as is looked at."""

    LOG_ERROR = 40

    class config:  # a module there
        log_level = 20


def test_a_package_that_cannot_be_loaded_is_named(monkeypatch):
    without(monkeypatch, "warp", error=OSError("libcuda.so: wrong format"))
    with pytest.raises(EngineError, match=r"'warp-lang'.*wrong format"):
        installation.check_packages()


def test_an_old_one_is_refused(monkeypatch):
    monkeypatch.setitem(sys.modules, "warp", Warp())
    monkeypatch.setitem(sys.modules, "mujoco_warp", Warp())
    with pytest.raises(EngineError, match="too old"):
        installation.check_packages()


def test_another_mujoco_over_gazelles_comes_first(monkeypatch):
    def damaged():
        raise EngineError("MuJoCo is damaged", hint="pip uninstall -y mujoco mujoco-core")

    monkeypatch.setattr(installation, "check_installation", damaged)
    with pytest.raises(EngineError, match="pip uninstall -y mujoco mujoco-core"):
        installation.check_packages()


def test_near_misses_find_it():
    world = load(assets.world("empty"))
    assert "mujoco-warp" in engine_names()
    with pytest.raises(EngineError, match="did you mean 'mujoco-warp'"):
        make_engine("mujoco_warp", world)


@pytest.mark.long
def test_other_engines_do_not_touch_it():
    code = (
        "import sys, gazelle; gazelle.Simulation('empty').step(); "
        "print('warp' in sys.modules, 'mujoco_warp' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "False"]
