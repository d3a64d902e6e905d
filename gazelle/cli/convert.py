"""Convert a file to SDF, URDF or MJCF. The input is any file that 'gazelle run'
takes, such as SDF, URDF, xacro or a bundled name. Elements that the output
format cannot express give a warning or an error. Meshes are not copied.

  gazelle convert robot.urdf.xacro robot.sdf
  gazelle convert office.world robot.urdf --model robot
  gazelle convert turtlebot3_world world.xml
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast, get_args

from gazelle.errors import Error, FormatError, did_you_mean
from gazelle_ros.base.path_texts import expanded

if TYPE_CHECKING:
    from gazelle.description import Model, World

Format = Literal["sdf", "urdf", "mjcf"]

_FORMATS: tuple[Format, ...] = get_args(Format)
_SUFFIXES: dict[str, Format] = {
    ".sdf": "sdf",
    ".world": "sdf",
    ".urdf": "urdf",
    ".mjcf": "mjcf",
    ".xml": "mjcf",
}
_READ_ONLY = {".xacro": "xacro", ".inc": "Stage"}


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("source", metavar="IN", help="input file, model folder or bundled name")
    parser.add_argument("target", metavar="OUT", help="output file; - for standard output")
    parser.add_argument(
        "--to", choices=_FORMATS, help="output format (default: by the suffix of OUT)"
    )
    parser.add_argument("--model", metavar="NAME", help="write only this model of the world")
    parser.add_argument(
        "--path",
        metavar="DIR",
        action="append",
        default=[],
        help="folder to search for models and packages (repeatable)",
    )
    parser.add_argument(
        "--arg",
        metavar="NAME:=VALUE",
        action="append",
        type=_argument,
        default=[],
        help="argument of a xacro file (repeatable)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle import formats

    kind = cast("Format", args.to) if args.to else _format_of(args.target)
    world = formats.load(args.source, paths=args.path, xacro_args=dict(args.arg))
    content = _chosen(world, args.model, args.target)
    if args.target == "-":
        sys.stdout.write(_text(content, kind, None))
        return 0
    file = expanded(args.target).absolute()
    if _is_input(file, world):
        raise FormatError("this is the file that is read", file=str(file), hint="name another")
    formats.write_text(file, _text(content, kind, file.parent))
    sys.stdout.write(f"wrote {args.target} ({kind.upper()}, {_size(content)})\n")
    return 0


def _argument(text: str) -> tuple[str, str]:
    name, separator, value = text.partition(":=")
    if not separator or not name:
        raise argparse.ArgumentTypeError(f"expected NAME:=VALUE, not '{text}'")
    return name, value


def _format_of(target: str) -> Format:
    """Return the format of a file name.

    Raises:
        FormatError: None that can be written.
    """
    suffix = Path(target).suffix.lower()
    if suffix in _READ_ONLY:
        raise FormatError(f"{_READ_ONLY[suffix]} can be read, but not written", file=target)
    if suffix not in _SUFFIXES:
        raise FormatError(
            f"the suffix '{suffix}' stands for no format that can be written",
            file=target,
            hint=f"there are: {', '.join(_SUFFIXES)}; or say --to {'|'.join(_FORMATS)}",
        )
    return _SUFFIXES[suffix]


def _chosen(world: World, name: str | None, target: str) -> World | Model:
    """Return the requested model; else the one model of a file that is not a world.

    Else the world.
    """
    if name is not None:
        models = {model.name: model for model in world.models}
        if name not in models:
            raise Error(f"there is no model '{name}'", hint=did_you_mean(name, models))
        return models[name]
    element = world.source.element if world.source is not None else None
    is_world = (element or "").rpartition("/")[2].startswith("world") or target.endswith(".world")
    only_model = len(world.models) == 1 and not world.lights
    return world.models[0] if only_model and not is_world else world


def _text(content: World | Model, kind: Format, folder: Path | None) -> str:
    from gazelle import formats
    from gazelle.description import Model, World

    if kind != "mjcf":
        return formats.to_string(content, kind, folder=folder)
    from gazelle.engines.mujoco import to_mjcf

    return to_mjcf(World(models=(content,)) if isinstance(content, Model) else content)


def _is_input(file: Path, world: World) -> bool:
    source = world.source.file if world.source is not None else None
    return source is not None and file.exists() and file.resolve() == Path(source).resolve()


def _size(content: World | Model) -> str:
    models = getattr(content, "models", ())
    return f"{len(models)} models" if len(models) > 1 else "1 model"
