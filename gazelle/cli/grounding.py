"""The flag ``--no-ground``: robots and models by themselves, in an empty space."""

from __future__ import annotations

from argparse import ArgumentParser, _ArgumentGroup


def add_ground(parser: ArgumentParser | _ArgumentGroup) -> None:
    """Declare the flag; ``args.ground`` is what ``formats.open_world`` takes."""
    parser.add_argument(
        "--no-ground",
        dest="ground",
        action="store_false",
        help="open a robot or model without the ground and sun that it gets by default",
    )
