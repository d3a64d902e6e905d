"""What MuJoCo is told in the middle of a step, by compiled code that it calls.

Three laws need more than MuJoCo's terms can say: bounces that reach e² of the height whatever
part of a step the impact falls in, friction by directions that turn with their surfaces, and
the gyroscopic torque of what tumbles freely. MuJoCo calls one function of the process,
``mjcb_control``, in every step of every model; this one looks for a mark in the model and does
nothing where there is none. It is compiled when a world first needs it.
"""

from gazelle.engines.mujoco.laws.extras import Extras, finish, prepare

__all__ = ["Extras", "finish", "prepare"]
