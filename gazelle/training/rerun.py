"""Episodes of an evaluation played again, one by one, to be looked at."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.errors import TaskError
from gazelle.training.evaluation import Evaluation
from gazelle.training.evaluation_episodes import evaluation_seed
from gazelle.training.records import EpisodeRecord
from gazelle.training.stepper import Stepper
from gazelle.training.tasks import control_period, make_task
from gazelle_ros.base.closing import Closeable


class Rerun(Closeable):
    """Plays episodes of an evaluation again, exactly as they were: all its copies start as then.

    Args:
        evaluation: Result of an evaluation without workers.

    Attributes:
        env: All copies.
        period: Simulated time of a step [s].

    Raises:
        TaskError: Workers played the episodes.
    """

    def __init__(self, evaluation: Evaluation) -> None:
        if evaluation.setup is None:
            raise TaskError("episodes that workers played cannot be played again here")
        self._actor, self._seed = evaluation.setup.actor, evaluation.seed
        self.env = make_task(evaluation.setup.task, evaluation.copies, **evaluation.setup.options)
        self.period = control_period(self.env) or 0.1
        self._stepper = Stepper(self.env)

    def play(self, record: EpisodeRecord, pace: Callable[[int], None]) -> bool:
        """Play an episode.

        Args:
            record: One of the evaluation's.
            pace: Called before each of its steps with the number of steps to its end; earlier
                episodes of this copy are played without. After the last step the world may
                be that of the next episode.

        Returns:
            Whether it took as many steps, and had the same return.

        Raises:
            TaskError: It has no place in the evaluation.
        """
        if record.place is None:
            raise TaskError("episodes that workers played cannot be played again here")
        stepper, copy, turns = self._stepper, record.place.copy, record.place.turn
        obs = stepper.reset(seed=evaluation_seed(self._seed, record.place.reset))
        memory = self._actor.begin(stepper.num_envs)
        steps = 0
        while True:
            if turns == 0 and not stepper.waiting[copy]:
                pace(record.length - steps)
                steps += 1
            step = stepper.step(self._actor.act(obs, memory=memory))
            if memory is not None:
                memory.forget(step.begun)
            obs = step.obs
            if step.ended is None or copy not in step.ended.slots:
                continue
            if turns == 0:
                row = int((step.ended.slots == copy).argmax())
                same = float(step.ended.returns[row]) == record.sum_of_rewards
                return same and steps == record.length
            turns -= 1

    def close(self) -> None:
        """Free the environment."""
        self.env.close()


def worst_first(evaluation: Evaluation) -> list[EpisodeRecord]:
    """Return the episodes of an evaluation, failures first, in their order otherwise."""
    return sorted(evaluation.records, key=lambda record: not record.failed)
