"""What pyproject.toml cannot say: the modules that are compiled."""

import sys
from pathlib import Path

from setuptools import setup

sys.path.insert(0, str(Path(__file__).parent / "tools" / "compiling"))

from extensions import BuildModules, BuildSources, extensions

compiling = {"build_ext", "bdist_wheel", "editable_wheel", "build", "install", "develop"}
setup(
    ext_modules=extensions() if compiling & set(sys.argv) else [],
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
    cmdclass={"build_ext": BuildModules, "build_py": BuildSources},
)
