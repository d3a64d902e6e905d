"""Compile the kernels of planar tasks, and of the engine, ahead of their first use.

``python -m gazelle.envs.planar``
"""

from __future__ import annotations

import gymnasium

from gazelle.engines.planar.__main__ import compile_ahead as compile_engine


def compile_ahead() -> None:
    """Use every kernel once, so that it is kept for all later runs on this machine."""
    compile_engine()
    name = "gazelle/TurtleBot3Stage4-v0"
    env = gymnasium.make(name, engine="planar")
    env.reset(seed=0)
    env.step(0)
    env.close()
    envs = gymnasium.make_vec(
        name, 2, "vector_entry_point", engine="planar", max_episode_steps=1, respawn=False
    )
    envs.reset(seed=0)
    envs.step([0, 1])
    envs.close()


if __name__ == "__main__":
    compile_ahead()
