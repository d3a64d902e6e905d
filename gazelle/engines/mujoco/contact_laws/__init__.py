"""Laws that MuJoCo lacks, applied in the middle of a step by compiled code that it calls.

These laws need more than MuJoCo's terms can say: motors that hold a velocity, bounces that reach
e² of the height whatever part of a step the impact falls in, friction by directions that turn
with their surfaces, and the forces of what turns about changing axes. MuJoCo calls one function of the process,
``mjcb_control``, in every step of every model; this one looks for a mark in the model and does
nothing where there is none.
"""

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.engines.mujoco.contact_laws.law_data import LawSelection, finish, prepare, spun

__all__ = ["LawSelection", "finish", "prepare", "spun"]
