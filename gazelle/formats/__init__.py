"""Readers and writers of robot and world files: SDF, URDF, xacro, SRDF, maps and meshes."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.formats.check import Problem, check, check_string
from gazelle.formats.loader import load, load_model, load_model_string, load_string
from gazelle.formats.mesh import load_mesh
from gazelle.formats.occupancy import load_map
from gazelle.formats.occupancy_writing import save_map
from gazelle.formats.octree import Octree
from gazelle.formats.opening import open_world
from gazelle.formats.resolve import Resolver
from gazelle.formats.srdf import load_srdf, load_srdf_string
from gazelle.formats.write import save, to_string, write_text
from gazelle.geometry.mesh_data import MeshData

__all__ = [
    "MeshData",
    "Octree",
    "Problem",
    "Resolver",
    "check",
    "check_string",
    "load",
    "load_map",
    "load_mesh",
    "load_model",
    "load_model_string",
    "load_srdf",
    "load_srdf_string",
    "load_string",
    "open_world",
    "save",
    "save_map",
    "to_string",
    "write_text",
]
