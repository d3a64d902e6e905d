"""Rows of links, joints and models in MuJoCo's arrays."""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])
