"""Files to descriptions: SDF, URDF, xacro, and the meshes they name."""

from gazelle.formats.check import Problem, check
from gazelle.formats.loader import load, load_model, load_model_string, load_string
from gazelle.formats.mesh import MeshData, load_mesh
from gazelle.formats.resolve import Resolver

__all__ = [
    "MeshData",
    "Problem",
    "Resolver",
    "check",
    "load",
    "load_mesh",
    "load_model",
    "load_model_string",
    "load_string",
]
