"""Rollouts by workers: control steps a second of one and of two, and what an iteration costs.

Workers are processes of this machine, and with --ray actors of a local Ray cluster. Printed is what
docs/explanation/benchmarks.md computes with: a rollout's bytes, what they cost to carry, and weights and states.
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import pickle
import time

import numpy as np
from stable_baselines3.common.logger import Logger

from gazelle.training import make_task, recipe_for
from gazelle.training.actor import Actor
from gazelle.training.learners import build_learner
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter
from gazelle.training.workers import ShardSpec, WorkerGroup, divided
from gazelle.training.workers.clusters import connect, start_actors
from gazelle.training.workers.processes import start_processes

STEPS = 32
TASKS = {
    "planar": ("gazelle/TurtleBot3Stage4-v0", 2048),
    "mujoco": ("gazelle/TurtleBot3Stage1-v0", 64),
}
GOALS = {"planar": 1_000_000, "mujoco": None}


def policy(inputs: int, actions: int) -> Actor:
    """Return two layers of 64, as recipes have them."""
    rng = np.random.default_rng(0)
    sizes = (inputs, 64, 64, actions)
    weights = tuple(
        rng.normal(0.0, 0.1, pair).astype(np.float32) for pair in itertools.pairwise(sizes)
    )
    return Actor(
        weights, tuple(np.zeros(size, np.float32) for size in sizes[1:]), "relu", "categorical"
    )


def measured(
    team: WorkerGroup, copies: int, windows: int
) -> tuple[float, dict[int, object], Actor]:
    """Control steps a second at best, the last rollouts, the policy."""
    spaces = team.spaces()
    actor = policy(int(np.prod(spaces.observation.shape)), int(spaces.action.n))
    team.call("reset", 0)
    found: dict[int, object] = team.call("collect", actor, STEPS)
    best = 0.0
    for _ in range(windows):
        start = time.perf_counter()
        found = team.call("collect", actor, STEPS)
        best = max(best, STEPS * copies / (time.perf_counter() - start))
    return best, found, actor


def updated(task: str, copies: int) -> float:
    """Return the seconds of one iteration's rollouts, with the task's own recipe."""
    recipe = dataclasses.replace(recipe_for(task), num_envs=copies)
    env = VectorEnvAdapter(make_task(task, copies, **recipe.training_options))
    learner = build_learner(recipe, env, 0)
    learner.overlap = False  # the whole update is timed, and nothing is played beside it
    learner.set_logger(Logger(None, []))
    _, callback = learner._setup_learn(10**9, None)  # noqa: SLF001  # as `learn` begins
    learner.collect_rollouts(env, callback, learner.rollout_buffer, learner.n_steps)
    start = time.perf_counter()
    learner.train()
    seconds = time.perf_counter() - start
    env.close()
    return seconds * STEPS / learner.n_steps


def machine_room(rate: float, megabytes: float, packing: float, update: float) -> None:
    """Control steps a second of more machines like this one, computed.

    Each has as many worlds as this one; rollouts come over 10 Gbit/s to one learner, which unpacks
    them one after another and learns from all.
    """
    steps = STEPS * TASKS["planar"][1]
    print("computed for more such machines, each with as many worlds, 10 Gbit/s to the learner:")
    print("  machines  rollouts alone      all in  share of time: rollouts  carrying  learning")
    for machines in (1, 8, 64):
        play = steps / rate
        carry = machines * (packing + 8e6 * megabytes / 10e9)
        learn = machines * update
        total = play + carry + learn
        print(
            f"  {machines:>8}  {machines * steps / (play + carry):>14,.0f}  "
            f"{machines * steps / total:>10,.0f}  {play / total:>23.0%}  {carry / total:>8.0%}  "
            f"{learn / total:>8.0%}"
        )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="gazelle bench workers", description=__doc__)
    parser.add_argument("--ray", action="store_true", help="actors of Ray's, beside processes")
    parser.add_argument("--windows", type=int, default=10, help="rollouts timed, the best counts")
    args = parser.parse_args()
    limit_threads(1)
    costs = {engine: compared(engine, ray=args.ray, windows=args.windows) for engine in TASKS}
    rate, megabytes, packing = costs["planar"]
    update = updated(*TASKS["planar"])
    print(f"one update of the learner from such a rollout: {1e3 * update:.0f} ms")
    machine_room(rate, megabytes, packing, update)


def compared(engine: str, *, ray: bool, windows: int) -> tuple[float, float, float]:
    """Compare one worker and two: steps a second, megabytes, seconds to pack and unpack."""
    task, copies = TASKS[engine]
    blueprint = ShardSpec(task=task, sizes=divided(copies), options={"engine": engine})
    print(f"{task}, {engine}, {copies} worlds, rollouts of {STEPS} steps, best of {windows}")
    rates = {}
    for workers in (1, 2):
        ways = {"process": start_processes(blueprint, 2)}  # of one processor each, of two
        if ray:
            connect("local")
            ways["Ray actor"] = start_actors(blueprint)
        for way, start in ways.items():
            team = WorkerGroup(start, len(blueprint.sizes), workers)
            try:
                rates[way, workers], found, actor = measured(team, copies, windows)
                states = team.states
            finally:
                team.close()
            ratio = rates[way, workers] / rates[way, 1]
            more = f"  {ratio:.2f} times one (goal 1.5)" if workers > 1 else ""
            print(f"  {workers} {way:<10} {rates[way, workers]:>12,.0f} control steps/s{more}")
    if GOALS[engine]:
        reached = "yes" if rates["process", 2] >= GOALS[engine] else "no"
        print(f"  goal with two: {GOALS[engine]:,}: {reached}")
    megabytes, packing = 0.0, 0.0
    for name, value in (("rollouts", found), ("states", states), ("weights", actor)):
        size, seconds = carried(value)
        megabytes, packing = megabytes + size, packing + seconds
        print(f"  {name} of an iteration: {size:.2f} MB, {1e3 * seconds:.1f} ms to pack and unpack")
    return rates["process", 2], megabytes, packing


def carried(value: object) -> tuple[float, float]:
    """Return megabytes, and seconds to pack and to unpack."""
    start = time.process_time()
    data = pickle.dumps(value, protocol=pickle.HIGHEST_PROTOCOL)
    pickle.loads(data)
    return len(data) / 1e6, time.process_time() - start


if __name__ == "__main__":
    main()
