"""Consent to import the code that a run names, as its configuration may be untrusted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from gazelle.errors import TaskError
from gazelle.training.importing import TaskModule
from gazelle.training.recipe import OffPolicySettings
from gazelle.training.runs import Run, RunConfig

_OWN = "gazelle."


def require_trust(run: Run, modules: Sequence[TaskModule] = (), *, trust: bool = False) -> None:
    """Raise an error for a run with code to import, unless the user trusts it.

    Nothing of the run has been imported yet. Modules that this process has imported already from
    the same place need no consent.

    Args:
        run: Names modules of tasks, callbacks and demonstrators.
        modules: Those that the user names; they replace the run's ``imports``.
        trust: Whether the user trusts the run.

    Raises:
        TaskError: It names a module that the user does not.
    """
    given = {module.name for module in modules}
    named = [*(() if modules else run.config.imports), *_named(run.config)]
    unknown = {
        module.name: module
        for module in reversed(named)
        if module.name not in given and not module.is_loaded()
    }
    if not unknown or trust:
        return
    names = ", ".join(
        f"'{module.name}'" + (f" from the folder '{module.folder}'" if module.folder else "")
        for module in unknown.values()
    )
    raise TaskError(
        f"this run imports code: {names}",
        file=str(run.folder / "config.json"),
        hint="look at it, then add --trust (in Python trust=True), or name it: --import MODULE",
    )


def _named(config: RunConfig) -> Iterator[TaskModule]:
    """Yield the modules that a configuration names elsewhere than in its ``imports``."""
    texts = [config.task, *config.callbacks]
    if isinstance(config.recipe.settings, OffPolicySettings):
        texts.append(config.recipe.settings.demonstrator or "")
    for text in texts:
        module, colon, _ = text.rpartition(":")
        if colon and not module.startswith(_OWN):
            yield TaskModule(module)
