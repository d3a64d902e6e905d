"""Packages of install and devel spaces, and of workspaces over each other, are found as catkin lays them out."""

import os
import shutil
import subprocess
import sys

import pytest
from whole import needs_gazelle

from gazelle_ros import Master
from gazelle_ros.launch import Packages, load_launch

pytestmark = needs_gazelle

MANIFEST = "<package format='2'><name>{}</name></package>"
ROBOT = (
    "<robot name='{0}' xmlns:xacro='http://ros.org/wiki/xacro'>"
    "<xacro:include filename='$(find arm)/urdf/link.xacro'/><xacro:part/></robot>"
)
LINK = (
    "<robot xmlns:xacro='http://ros.org/wiki/xacro'><xacro:macro name='part'><link name='base'><inertial><mass value='1'/>"
    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><visual>"
    "<geometry><mesh filename='package://arm/meshes/a.stl'/></geometry></visual></link></xacro:macro></robot>"
)
STL = (
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid a"
)
LAUNCH = (
    "<launch><rosparam file='$(find arm)/config/a.yaml'/><include file='$(find arm)/launch/talk.launch'/>"
    "</launch>"
)
TALK = (
    "<launch><node pkg='arm' type='talk.py' name='talk' output='screen' required='true'/></launch>"
)
SCRIPT = "#!/usr/bin/env python3\nfrom arm.tools import PLACE\nimport single\nprint('from', PLACE, single.X)\n"
RELAY = (
    "#!/usr/bin/env python3\nwith open({0!r}) as fh:\n"
    "    context = {{'__builtins__': __builtins__, '__doc__': None, '__file__': {0!r}, '__name__': __name__}}\n"
    "    exec(compile(fh.read(), {0!r}, 'exec'), context)\n"
)
SETUP = (
    "from distutils.core import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\n"
    "setup(**generate_distutils_setup(packages=['arm'], py_modules=['single'], package_dir={'': 'src'}))\n"
)


def write(root, files):
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
        if text.startswith("#!"):
            (root / name).chmod(0o755)


def shared(place):
    """Return the files of a package that sources and an install space have alike."""
    return {
        "package.xml": MANIFEST.format("arm"),
        "urdf/arm.urdf.xacro": ROBOT.format(place),
        "urdf/link.xacro": LINK,
        "meshes/a.stl": STL,
        "config/a.yaml": f"{{place: {place}}}",
        "launch/up.launch": LAUNCH,
        "launch/talk.launch": TALK,
        "msg/Reach.msg": "float64 far\n",
    }


def install_space(root):
    """Write what ``catkin_make install`` makes."""
    write(root / "share/arm", shared("install"))
    modules = {"arm/__init__.py": "", "arm/tools.py": "PLACE = 'install'\n", "single.py": "X = 1\n"}
    write(root / "lib/python3/dist-packages", modules)
    write(root / "lib/arm", {"talk.py": SCRIPT})
    return {"ROS_PACKAGE_PATH": f"{root}/share", "CMAKE_PREFIX_PATH": str(root)}


def devel_space(root):
    """Write a workspace that ``catkin_make`` has built: programs of ``devel`` run those of ``src``."""
    write(root / "src/arm", shared("devel"))
    modules = {"arm/__init__.py": "", "arm/tools.py": "PLACE = 'devel'\n", "single.py": "X = 2\n"}
    write(root / "src/arm/src", modules)
    write(root / "src/arm", {"setup.py": SETUP, "scripts/talk.py": SCRIPT})
    write(root / "devel/lib/arm", {"talk.py": RELAY.format(str(root / "src/arm/scripts/talk.py"))})
    return {"ROS_PACKAGE_PATH": f"{root}/src", "CMAKE_PREFIX_PATH": f"{root}/devel"}


def overlaid(root):
    """Write a workspace over an install space."""
    above, below = devel_space(root / "ws"), install_space(root / "opt")
    return {name: f"{above[name]}{os.pathsep}{below[name]}" for name in above}


def unbuilt(root):
    """Write sources that are not built over an install space."""
    found = overlaid(root)
    shutil.rmtree(root / "ws" / "devel")
    return found


SPACES = {
    "install": install_space,
    "devel": devel_space,
    "overlay": overlaid,
    "unbuilt overlay": unbuilt,
}


@pytest.fixture(params=SPACES)
def space(request, tmp_path, monkeypatch):
    """Yield which space comes first, with the variables of its ``setup.bash`` but PYTHONPATH."""
    for name, value in SPACES[request.param](tmp_path).items():
        monkeypatch.setenv(name, value)
    monkeypatch.delenv("PYTHONPATH", raising=False)
    return "install" if request.param == "install" else "devel"


def told(*words, **more):
    done = subprocess.run(
        [sys.executable, "-m", "gazelle", *words],
        capture_output=True,
        text=True,
        timeout=300,
        env=os.environ | more,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_files_of_a_package_are_found(space):
    from gazelle import formats

    packages = Packages()
    robot = formats.load_model(packages.locate("arm", "/urdf/arm.urdf.xacro"))
    assert robot.name == space
    assert robot.links[0].visuals[0].geometry.path.name == "a.stl"
    assert formats.load_model("package://arm/urdf/arm.urdf.xacro").name == space
    plan = load_launch(packages.locate("arm", "/launch/up.launch"))
    assert {each.name: each.value for each in plan.parameters.values()} == {"/place": space}


@pytest.mark.long
def test_programs_of_a_package_run_with_its_python_code(space):
    number = {"install": 1, "devel": 2}[space]
    for words in (("exec", "arm", "talk.py"), ("exec", "rosrun", "arm", "talk.py")):
        assert f"from {space} {number}" in told(*words)
    assert "float64 far" in told("msg", "show", "arm/Reach")
    with Master(port=0) as master:
        assert f"from {space} {number}" in told(
            "launch", "arm", "up.launch", ROS_MASTER_URI=master.uri
        )
