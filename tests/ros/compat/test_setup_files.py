"""The Python code that a catkin package's ``setup.py`` names can be imported, and the file is not run."""

import subprocess
import sys

import pytest

import gazelle_ros as ros
from gazelle_ros.compat.setup_files import python_code

HEAD = (
    "from distutils.core import setup\n"
    "from catkin_pkg.python_setup import generate_distutils_setup\n"
)
CALL = HEAD + "setup(**generate_distutils_setup({}))\n"
LAYOUTS = {
    "src": (CALL.format("packages=['led'], package_dir={'': 'src'}"), "src/led"),
    "python": (CALL.format("packages=['led'], package_dir={'': 'python'}"), "python/led"),
    "own folder": (CALL.format("packages=['led'], package_dir={'led': 'code/main'}"), "code/main"),
    "at the root": (CALL.format("packages=['led']"), "led"),
    "distutils alone": ("from distutils.core import setup\nsetup(packages=['led'])", "led"),
    "kept in a variable": (
        HEAD + "d = generate_distutils_setup(packages=['led'], package_dir={'': 'lib'})\nsetup(**d)",
        "lib/led",
    ),
    "filled later": (
        HEAD + "d = generate_distutils_setup()\nd['packages'] = ['led']\n"
        "d['package_dir'] = {'': 'lib'}\nsetup(**d)",
        "lib/led",
    ),
    "constants": (
        HEAD + "ROOT = 'lib'\nNAMES = ['other'] + ['led']\nNAMES += ['more']\n"
        "setup(**generate_distutils_setup(packages=NAMES, package_dir={'': ROOT}))",
        "lib/led",
    ),
    "constants as keys": (
        HEAD + "N = 'led'\nKEY = 'packages'\nd = generate_distutils_setup(package_dir={N: 'lib'})\n"
        "d[KEY] = [N, N + '.sub']\nsetup(**d)",
        "lib",
    ),
    "formatted": (
        HEAD + "R = 'lib'\nd = generate_distutils_setup(packages=['led'], "
        "package_dir={'led': f'{R}/py'})\nsetup(**d)",
        "lib/py",
    ),
    "updated": (
        HEAD + "d = generate_distutils_setup()\nd.update(packages=['led'])\n"
        "d.update({'package_dir': {'': 'lib'}})\nsetup(**d)",
        "lib/led",
    ),
    "found": (
        ("from setuptools import setup, find_packages\n"
        "setup(packages=find_packages('lib', exclude=['tests*']), package_dir={'': 'lib'})"),
        "lib/led",
    ),
    "guarded": (
        HEAD + "import os\nif os.path.exists('/'):\n    setup(packages=['led'], "
        "package_dir={'': 'src'})\n",
        "src/led",
    ),
    "computed": (CALL.format("packages=open('x').read().split(), package_dir={'': 'lib'}"), "lib/led"),
    "computed folder": (CALL.format("packages=['led'], package_dir={'': f()}"), "src/led"),
    "for Python 2": ("print 'x'\n" + CALL.format("packages=['led']"), "src/led"),
}  # fmt: skip


def make_package(root, name, setup):
    folder = root / name
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
    (folder / "setup.py").write_text("open(__file__ + '.ran', 'w')\n" + setup)
    return folder


def write_module(file, text="VALUE = 7\n"):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    yield tmp_path / "src"
    for name in [each for each in sys.modules if each.split(".")[0] in {"led", "lamp", "lab"}]:
        del sys.modules[name]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_code_is_found_as_each_layout_says(workspace, layout):
    setup, place = LAYOUTS[layout]
    folder = make_package(workspace, "led_driver", setup)
    for name in ("__init__", "blink"):
        write_module(folder / place / f"{name}.py")
    write_module(folder / place / "sub" / "__init__.py")
    with ros.install():
        import led
        import led.blink
        import led.sub

    assert led.VALUE == led.blink.VALUE == led.sub.VALUE == 7
    assert not (folder / "setup.py.ran").exists()


def test_single_modules_are_found(workspace):
    folder = make_package(
        workspace,
        "led_driver",
        CALL.format("py_modules=['led', 'lamp'], package_dir={'': 'src'}"),
    )
    write_module(folder / "src" / "led.py", "import lamp\nVALUE = lamp.VALUE\n")
    write_module(folder / "src" / "lamp.py")
    with ros.install():
        import led
    assert led.VALUE == 7


def test_packages_in_one_name_space_are_joined(workspace):
    for name in ("eyes", "hands"):
        folder = make_package(
            workspace,
            f"lab_{name}",
            CALL.format(f"packages=['lab.{name}'], package_dir={{'': 'src'}}"),
        )
        write_module(folder / "src" / "lab" / name / "__init__.py")
    with ros.install():
        import lab.eyes
        import lab.hands
    assert lab.eyes.VALUE == lab.hands.VALUE == 7


def test_an_inner_package_may_lie_elsewhere(workspace):
    code = "packages=['led', 'led.inner'], package_dir={'led': 'a', 'led.inner': 'b'}"
    folder = make_package(workspace, "led_driver", CALL.format(code))
    write_module(folder / "a" / "__init__.py", "")
    write_module(folder / "b" / "__init__.py")
    with ros.install():
        import led.inner
    assert led.inner.VALUE == 7


def test_code_beside_messages_of_the_same_package(workspace):
    folder = make_package(
        workspace, "led", CALL.format("packages=['led'], package_dir={'': 'lib'}")
    )
    write_module(folder / "lib" / "led" / "__init__.py")
    (folder / "msg").mkdir()
    (folder / "msg" / "State.msg").write_text("bool lit\n")
    with ros.install():
        import led
        from led.msg import State
    assert led.VALUE == 7
    assert State(lit=True).lit


def test_a_package_of_the_workspace_comes_before_one_of_pypi(workspace):
    folder = make_package(workspace, "x", CALL.format("packages=['mpmath'], package_dir={'': 's'}"))
    write_module(folder / "s" / "mpmath" / "__init__.py")
    kept = {name: sys.modules.pop(name) for name in list(sys.modules) if name.startswith("mpmath")}
    try:
        with ros.install():
            import mpmath
        assert mpmath.VALUE == 7
    finally:
        sys.modules.pop("mpmath", None)
        sys.modules.update(kept)


@pytest.mark.parametrize(
    "text", ["", "setup(", "\0", "setup(packages=7, package_dir=8, py_modules='a')", "(" * 5000]
)
def test_damaged_files_name_nothing(tmp_path, text):
    (tmp_path / "setup.py").write_text(text)
    found = python_code(tmp_path)
    assert not found.packages
    assert not found.modules


@pytest.mark.long
@pytest.mark.parametrize("script", ["scripts/say", "bin/say.py"])
def test_a_script_that_it_names_runs_by_package_and_name(workspace, script):
    code = f"packages=['led'], package_dir={{'': 'src'}}, scripts=['{script}']"
    folder = make_package(workspace, "led_driver", CALL.format(code))
    write_module(folder / "src" / "led" / "__init__.py")
    write_module(folder / script, "#!/usr/bin/env python\nimport led\nprint(led.VALUE)\n")
    name = script.rpartition("/")[2]
    done = subprocess.run(
        [sys.executable, "-m", "gazelle_ros", "exec", "led_driver", name],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "7\n", done.stderr


@pytest.mark.parametrize("twice", ["a = a + a", "a += a", "a = [*a, *a]"])
def test_lists_that_grow_without_end_are_unknown(tmp_path, twice):
    folder = make_package(
        tmp_path, "led", f"a = ['led']\n{chr(10).join([twice] * 60)}\nsetup(packages=a)"
    )
    write_module(folder / "led" / "__init__.py")
    assert python_code(folder).packages == {"led": folder / "led"}


def test_texts_that_grow_without_end_are_unknown(tmp_path):
    text = "a = 'led'\n" + "a = f'{a}{a}'\n" * 60 + "setup(packages=[a])"
    assert not python_code(make_package(tmp_path, "led", text)).packages
