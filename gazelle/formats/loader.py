"""Loading of worlds and models from files of all readable formats."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle.description import Model, Parameters, World
from gazelle.errors import FormatError, FormatWarning, ResolveError, closest_of
from gazelle.formats import sdf, srdf, urdf, xacro, xml
from gazelle.formats.map_world import map_world
from gazelle.formats.model_config import entry_file
from gazelle.formats.near_names import describe_folder
from gazelle.formats.occupancy import read_map
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver
from gazelle.formats.world_formats import find_world_format
from gazelle_ros.base.path_texts import can_be_path, expanded, shortened

PathLike = str | os.PathLike[str]

_warned: set[tuple[str, Path]] = set()
"""Models of the environment that were reported as not taken."""

_own_worlds: dict[tuple[Path, int], World] = {}
"""Bundled worlds that were read, by the file and its time of writing."""

_WORLD_SUFFIXES = (".world", ".sdf")
_ROBOT_SUFFIXES = (".urdf.xacro", ".urdf")
_EXPANDED = {"robot", "sdf", "gazebo"}
_MAP_SUFFIXES = (".yaml", ".yml")
_SHORT = 60  # characters of a value that a message shows
_BUNDLED_HINT = "'gazelle worlds' and 'gazelle robots' list what is bundled"


def load(
    path: PathLike,
    *,
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
    strict: bool = False,
) -> World:
    """Return the world in a file: SDF, URDF, xacro, Stage, a map, or the folder of a model.

    A file of a robot or model gives a world that holds just that (``open_world`` adds ground and
    sun); a map of ``map_server`` (``.yaml``) one with a wall on each occupied cell. What kind any other file is is decided by
    its content.

    Args:
        path: File, model folder, URI (``model://``, ``package://``, ``file://``), or the
            name of a world, model or robot that comes with Gazelle.
        paths: Folders to search for models and packages before all others.
        xacro_args: Values of ``<xacro:arg>``, as ``name:=value`` would give them.
        strict: Raise when a file that this one refers to is not found; else a warning
            names all that is missing, and stand-ins are used.

    Raises:
        FormatError: The file cannot be read, or its content is invalid.
        ResolveError: There is no such file; or, if ``strict``, one it refers to.
    """
    reading = _reading(paths, xacro_args)
    world = _read_once(find_file(path, reading), reading)
    reading.report(strict=strict)
    return world


def load_model(
    path: PathLike,
    *,
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
    strict: bool = False,
) -> Model:
    """Load the one model in a file; arguments and errors are those of ``load``.

    Raises:
        FormatError: The file holds no model, or several.
    """
    reading = _reading(paths, xacro_args)
    world = _read_once(find_file(path, reading, model=True), reading)
    reading.report(strict=strict)
    return _only_model(world, str(path))


def load_string(
    text: str | bytes,
    *,
    name: str = "string",
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
    strict: bool = False,
) -> World:
    """Load the world in SDF, URDF, xacro or Stage text; ``name`` stands for the file in errors.

    Relative names start nowhere: files are found through ``paths`` and URIs.

    Raises:
        FormatError: The text cannot be read, or its content is invalid.
        ResolveError: A file is not found, and ``strict`` is set.
    """
    if not isinstance(text, str | bytes):
        raise FormatError(
            f"text must be a string or bytes, not {text!r}", hint="load() reads files"
        )
    reading = _reading(paths, xacro_args)
    world = read_text(text, name, reading)
    reading.report(strict=strict)
    return world


def read_text(text: str | bytes, name: str, reading: Reading) -> World:
    """Return the world in SDF, URDF, xacro or Stage text; ``name`` stands for the file in errors.

    Raises:
        FormatError: The text cannot be read, or its content is invalid.
    """
    data = text.encode(errors="surrogatepass") if isinstance(text, str) else text
    own = find_world_format(data)
    if own is not None:
        return own.read(data, name, reading)
    root = xml.parse(text, name=name, report=reading.misread)
    if root.tag in _EXPANDED and xacro.is_xacro(root):
        root = xacro.expand_text(text, name, reading)
    return read_root(root, reading)


def load_model_string(
    text: str | bytes,
    *,
    name: str = "string",
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
    strict: bool = False,
) -> Model:
    """Load the one model in SDF, URDF or xacro text; see ``load_string``.

    Raises:
        FormatError: The text holds no model, or several.
    """
    world = load_string(text, name=name, paths=paths, xacro_args=xacro_args, strict=strict)
    return _only_model(world, name)


def _reading(paths: Sequence[PathLike], xacro_args: Mapping[str, str] | None) -> Reading:
    folders = (paths,) if isinstance(paths, (str, os.PathLike)) else paths
    return Reading(Resolver(folders), xacro_args=dict(xacro_args or {}))


def _only_model(world: World, name: str) -> Model:
    if len(world.models) != 1:
        raise FormatError(
            f"expected one model, found {len(world.models)}",
            file=name,
            hint="use load() for a world" if world.models else None,
        )
    return world.models[0]


def path_text(path: object) -> str:
    """Return a path, URI or bundled name as text.

    Raises:
        ResolveError: It is none of them.
    """
    hint = 'such as "robot.urdf", "model://ground_plane" or "turtlebot3_world"'
    if not isinstance(path, str | os.PathLike):
        shown = text if len(text := repr(path)) <= _SHORT else f"a {type(path).__name__}"
    else:
        text = str(os.fspath(path))
        if text.lstrip().startswith("<"):
            shown, hint = "its text", "load_string() and load_model_string() read text"
        elif "\x00" in text:
            raise ResolveError("no file can have this name", file=shortened(text), hint=hint)
        elif not can_be_path(text):
            shown = f"{len(text):,} characters"
        else:
            return text
    raise ResolveError(f"a file is found by its path, URI or name, not by {shown}", hint=hint)


def find_file(path: PathLike, reading: Reading, *, model: bool = False) -> Path:
    """Return the file of a path, URI or bundled name.

    Args:
        path: The requested file.
        reading: Resolves it.
        model: Of a bundled model and a bundled world of one name, take the model.

    Raises:
        ResolveError: There is none.
    """
    text = path_text(path)
    if "://" not in text:
        plain = expanded(text)
        # A folder named like a bundled world hides it only if it holds a model.
        hidden = _is_other_folder(plain) and _bundled(text, reading.resolver, model=model)
        if plain.exists() and not hidden:
            return entry_file(plain.absolute())
    found = reading.resolver.find(text, Path.cwd()) if "://" in text else None
    found = found or _bundled(text, reading.resolver, model=model)
    if found is None:
        looked = reading.resolver.looked_in(text)
        names = bundled_names(reading.resolver.assets)
        close = closest_of(text, names)
        hint = f"{looked}" if "://" in text or "/" in text else close or _BUNDLED_HINT
        if text.startswith(("/", "~", ".")):
            hint = describe_folder(expanded(text))
        raise ResolveError("there is no such file, URI or bundled name", file=text, hint=hint)
    reading.resolver.look_around(found)
    return entry_file(found)


def _is_other_folder(path: Path) -> bool:
    return path.is_dir() and not (path / "model.config").exists()


def _bundled(name: str, resolver: Resolver, *, model: bool) -> Path | None:
    """Return the file or model's folder of a bare name.

    What comes with Gazelle is not hidden by what the environment has of that name: a task or a
    tutorial that names it counts on it. What else there is, is reported once.
    """
    if "://" in name:
        return None
    files = _bundled_files(resolver.assets)
    file = files.get(name) or {file.name: file for file in files.values()}.get(name)
    given, own = resolver.given_model(name), resolver.bundled_model(name)
    bundled = own or file if model else file or given or own
    if model and given is not None:
        return given
    if bundled is None:
        return resolver.model(name)
    if bundled != given:
        _warn_of_other(name, resolver)
    return bundled


def _warn_of_other(name: str, resolver: Resolver) -> None:
    other = resolver.environment_model(name)
    if other is not None and (name, other) not in _warned:
        _warned.add((name, other))
        warnings.warn(
            f"'{name}' is the one that comes with Gazelle; another is in {other}: give its path, "
            f"or model://{name}, to take that one",
            FormatWarning,
            stacklevel=5,
        )


def bundled_names(assets: Path) -> list[str]:
    """Return names of all worlds, models and robots that come with Gazelle."""
    patterns = ("models/*", "*/models/*", "*/models/*/*")
    files = [file for each in patterns for file in assets.glob(f"{each}/model.config")]
    models = [file.parent.name for file in files]
    return sorted({*models, *_bundled_files(assets)})


def _bundled_files(assets: Path) -> dict[str, Path]:
    files: dict[str, Path] = {}
    for suffix in _WORLD_SUFFIXES:
        places = assets.glob(f"worlds/*{suffix}"), assets.glob(f"*/worlds/*{suffix}")
        for file in (each for found in places for each in sorted(found)):
            files.setdefault(file.name.removesuffix(suffix), file)
    for pattern in ("robots/*", "*/urdf/*"):
        for suffix in _ROBOT_SUFFIXES:
            for file in sorted(assets.glob(pattern + suffix)):
                files.setdefault(file.name.removesuffix(suffix), file)
    return files


def _read_once(file: Path, reading: Reading) -> World:
    """Return the world in a file; a bundled one without a remark is read once in a process.

    What such a file names is Gazelle's own, too, and descriptions do not change.
    """
    if not file.is_relative_to(reading.resolver.assets) or not reading.is_plain:
        return read_path(file, reading)
    key = file, file.stat().st_mtime_ns
    world = _own_worlds.get(key)
    if world is None:
        world = read_path(file, reading)
        if not reading.notes and not reading.misses:
            _own_worlds[key] = world
    return world


def read_path(file: Path, reading: Reading) -> World:
    """Read the world in a file.

    Raises:
        FormatError: It cannot be read, or its content is invalid.
    """
    with reading.inside(file):
        if file.suffix.lower() in _MAP_SUFFIXES:
            return map_world(read_map(file, reading))
        data = xml.read_bytes(file)
        own = find_world_format(data, file.suffix)
        if own is not None:
            return own.read(data, str(file), reading)
        root = xml.parse(data, name=str(file), report=reading.misread)
        if root.tag in _EXPANDED and xacro.is_xacro(root):
            root = xacro.expand(file, reading)
        return read_root(root, reading)


def read_root(root: Parameters, reading: Reading) -> World:
    """Read the world of a root element, whatever its format.

    Raises:
        FormatError: It is of no known format.
    """
    if root.tag == "robot" and srdf.is_srdf(root):
        raise FormatError(
            "this is an SRDF, which describes no robot by itself",
            source=root.source,
            hint="gazelle.formats.load_srdf() reads it; load the URDF it is for",
        )
    if root.tag == "robot":
        return World(models=(urdf.read_robot(root, reading),), bare=True, source=root.source)
    if root.tag in {"sdf", "gazebo"}:
        return sdf.read_sdf(root, reading)
    if root.tag == "gazebo:world":
        raise FormatError("worlds of Gazebo before 1.0 cannot be read", source=root.source)
    if root.tag == "launch":
        raise FormatError(
            "this is a launch file, which describes no world",
            source=root.source,
            hint="'gazelle launch FILE' runs it",
        )
    kind = urdf.NoLinksError if xacro.is_xacro(root) else FormatError  # macros under another name
    raise kind(
        f"expected <sdf> or <robot>, found <{root.tag}>",
        source=root.source,
        hint="readable are SDF, URDF, xacro and Stage files, maps (.yaml), and folders with a "
        "model.config",
    )
