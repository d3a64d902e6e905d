"""The modules that Cython compiles, and how: one build for any processor, one for AVX2."""

from __future__ import annotations

import hashlib
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import compilers
import windows_python
from Cython.Build import cythonize
from setuptools import Extension
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

ROOT = Path(__file__).parents[2]
SHARED = "gazelle.native.memoryviews"
"""What Cython's typed memory views need, once for all modules."""

PORTABLE = {SHARED, "gazelle.native.fair_lock", "gazelle.native.processor"}
"""Modules with nothing that a faster build would do faster."""

DIRECTIVES = {
    "language_level": 3,
    "boundscheck": False,
    "wraparound": False,
    "initializedcheck": False,
    "cdivision": True,
    "infer_types": True,
}
CHECKED = {"boundscheck": True, "initializedcheck": True}

# No two compilers or processors may round differently: a product and a sum are never made one
# operation, and nothing is reordered. What is left out is only what math.h says about errno and
# about traps, which nobody looks at here.
PRECISE = ["-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math"]
FAST = ["-O3", *PRECISE, "-g0", "-DNDEBUG", "-DCYTHON_WITHOUT_ASSERTIONS"]
QUIET = ["-Wno-unused-function", "-Wno-unreachable-code", "-Wno-unused-variable"]
LIMITED_API = "0x030B0000"
"""Python's stable ABI of 3.11: modules work with that version and all later ones."""

BUILDS = {
    "baseline": FAST,
    "avx2": [*FAST, "-mavx2"],
    "checked": [
        *["-O0", *PRECISE, "-g1", "-fno-omit-frame-pointer"],
        *["-fsanitize=address,undefined", "-fno-sanitize-recover=undefined"],
    ],
}
VISUAL_STUDIO = {"baseline": ["/O2", "/fp:precise"], "avx2": ["/O2", "/fp:precise", "/arch:AVX2"]}


def processors() -> int:
    """Return the number of processors that may be used."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def builds() -> list[str]:
    """Return the builds to make: those for users, or those of ``GAZELLE_BUILD``."""
    named = os.environ.get("GAZELLE_BUILD", "").split()
    return named or (["baseline", "avx2"] if compilers.is_x86() else ["baseline"])


def sources() -> list[Path]:
    """Return the files of the package with ``import cython``."""
    says = re.compile(r"^import cython$", re.MULTILINE)
    files = sorted((ROOT / "gazelle").rglob("*.py"))
    return [
        path.relative_to(ROOT) for path in files if says.search(path.read_text(encoding="utf-8"))
    ]


def extensions() -> list[Extension]:
    """Return every module in every build; C files are made where they are outdated."""
    found = []
    for checks in (False, True):
        chosen = [name for name in builds() if (name == "checked") == checks]
        if chosen:
            modules = _translated("checked" if checks else "plain", CHECKED if checks else {})
            found += [
                _built(module, name)
                for name in chosen
                for module in modules
                if name != "avx2" or module.name not in PORTABLE
            ]
    return found


def _translated(kind: str, checks: dict[str, bool]) -> list[Extension]:
    """Translate every module to C, under ``build/cython``."""
    folder = f"build/cython/{kind}"
    names = [".".join(path.with_suffix("").parts) for path in sources()]
    modules = [Extension(name, [str(path)]) for name, path in zip(names, sources(), strict=True)]
    shared = Extension(SHARED, [SHARED.replace(".", "/") + ".c"])
    return cythonize(
        [shared, *modules],
        build_dir=folder,
        compiler_directives=DIRECTIVES | checks,
        shared_utility_qualified_name=SHARED,
        quiet=True,
        # Other ways to start processes would import what runs this, which may have no guard.
        nthreads=processors() if multiprocessing.get_start_method() == "fork" else 0,
    )


def _built(module: Extension, build: str) -> Extension:
    """Return a module in a folder beside its source, under the name of its source."""
    package, _, name = module.name.rpartition(".")
    home = Path(*package.split("."))
    return Extension(
        f"{package}._{build}.{name}",
        sources=list(module.sources),
        depends=[*module.depends, *map(str, (ROOT / home).glob("*.h"))],
        include_dirs=[str(home), "gazelle/native"],
        define_macros=[("Py_LIMITED_API", LIMITED_API)],
        py_limited_api=True,
        extra_compile_args=[build],
    )


class BuildSources(build_py):
    """Copy what is not compiled; what is left of an earlier build and is gone since goes."""

    def run(self) -> None:
        """Keep compiled modules that are still needed: they are not made again if up to date."""
        ext = self.get_finalized_command("build_ext")
        wanted = {Path(ext.get_ext_fullpath(each.name)).resolve() for each in ext.extensions or ()}
        for path in Path(self.build_lib, "gazelle").rglob("*"):
            if path.is_file() and path.resolve() not in wanted:
                path.unlink()
        super().run()


class BuildModules(build_ext):
    """Compile them with whatever compiler there is."""

    def initialize_options(self) -> None:
        """Use all processors."""
        super().initialize_options()
        self.parallel = processors()

    def build_extensions(self) -> None:
        """Choose the compiler and its flags for each build."""
        if not Path(sysconfig.get_path("include"), "Python.h").exists():
            raise SystemExit(
                "Python's header files are missing; install them (Debian, Ubuntu: python3-dev) "
                "or use a wheel that is built: pip install gazelle"
            )
        unix = self.compiler.compiler_type != "msvc"
        self._compiler, self._command, self._version = self.compiler.compiler_type, [], ""
        if unix:
            self._choose_compiler()
        self.force = True  # what is up to date is known by its ingredients, not by its age
        if compilers.is_windows() and unix:
            self._use_windows_python()
        every, folder = self.extensions, self.build_temp
        for build in dict.fromkeys(each.extra_compile_args[0] for each in every):
            chosen = [each for each in every if each.extra_compile_args[0] == build]
            for each in chosen:
                _set_flags(each, build, unix=unix)
            # The same sources make other objects in each build.
            self.extensions, self.build_temp = chosen, str(Path(folder, build))
            super().build_extensions()
        self.extensions, self.build_temp = every, folder

    def build_extension(self, ext: Extension) -> None:
        """Compile a module, or copy what the same text, compiler and flags have made before.

        Installations are built in folders that are thrown away, and wheels in another that does not
        tell which compiler has filled it: each would compile everything again, or nothing at all.
        """
        wanted = Path(self.get_ext_fullpath(ext.name))
        kept = Path("build", "compiled", self._compiler, self.get_ext_filename(ext.name))
        ingredients, now = kept.with_name(f"{kept.name}.sha256"), self._ingredients(ext)
        wanted.parent.mkdir(parents=True, exist_ok=True)
        if kept.exists() and ingredients.exists() and ingredients.read_text() == now:
            shutil.copyfile(kept, wanted)
            return
        super().build_extension(ext)
        wanted.with_suffix(".lib").unlink(missing_ok=True)  # Zig writes it beside, for Windows
        kept.parent.mkdir(parents=True, exist_ok=True)
        ingredients.unlink(missing_ok=True)  # should this end half-way
        shutil.copyfile(wanted, kept)
        ingredients.write_text(now)

    def _ingredients(self, ext: Extension) -> str:
        """Return a digest of everything that determines the compiled code."""
        words = [self._version, sys.version, ext.name, *ext.extra_compile_args]
        words += [*ext.extra_link_args, *self._command, str(ext.define_macros)]
        digest = hashlib.sha256("\0".join(words).encode())
        headers = [path for folder in ext.include_dirs for path in Path(folder).glob("*.h")]
        for path in [*map(Path, ext.sources), *sorted(headers)]:
            digest.update(path.read_bytes())
        return digest.hexdigest()

    def _choose_compiler(self) -> None:
        found = compilers.system_compiler()
        zig = found is None
        command = compilers.zig() if zig else found.split()
        if zig:  # Debian's Python.h includes another header by its path below /usr/include
            command += ["-idirafter", str(Path(sysconfig.get_path("include")).parent)]
        if compilers.is_x86():  # processors from 2009 on; Zig spells it in its own way
            command.append("-march=x86_64_v2" if zig else "-march=x86-64-v2")
        ending = ["-shared"]
        if compilers.is_macos():  # where Zig's linker of 0.17 crashes on bundles
            ending = ["-shared" if zig else "-bundle", "-undefined", "dynamic_lookup"]
        code = ["-fwrapv"] if compilers.is_windows() else ["-fPIC", "-fwrapv"]
        self.compiler.set_executables(compiler_so=[*command, *code], linker_so=[*command, *ending])
        self._compiler = f"zig-{compilers.zig_target()}" if zig else "system"
        self._command = [*command, *ending]
        shown = subprocess.run([*command, "--version"], check=True, capture_output=True, text=True)
        # What follows tells where it is installed: pip has another folder for Zig's each time.
        self._version = shown.stdout.partition("\n")[0]

    def _use_windows_python(self) -> None:
        """Compile for Windows on another system."""
        folder = Path("build", "windows").resolve()
        library, headers = windows_python.import_library(folder), windows_python.headers(folder)
        for each in self.extensions:
            each.include_dirs.insert(0, str(headers))
            each.extra_objects.append(str(library))

    def get_ext_filename(self, fullname: str) -> str:
        """Return a module's file name on the target system."""
        name = super().get_ext_filename(fullname)
        return re.sub(r"(\.abi3)?\.so$", ".pyd", name) if compilers.is_windows() else name

    def copy_extensions_to_source(self) -> None:
        """Copy modules beside their sources, for an editable installation.

        Modules of an earlier build under other names go: Python would prefer some of them.
        """
        for each in self.extensions:
            *packages, name = each.name.split(".")
            home = Path(*packages)
            home.mkdir(exist_ok=True)
            for old in [*home.glob(f"{name}.*so"), *home.glob(f"{name}.*pyd")]:
                old.unlink()
        super().copy_extensions_to_source()


def _set_flags(module: Extension, build: str, *, unix: bool) -> None:
    if not unix:
        module.extra_compile_args = VISUAL_STUDIO[build]
        return
    module.extra_compile_args = [*BUILDS[build], *QUIET]
    module.extra_link_args = [each for each in BUILDS[build] if each.startswith("-fsanitize")]
    if BUILDS[build][0] == FAST[0] and not compilers.is_macos():
        module.extra_link_args.append("-s")  # nobody looks at symbols
