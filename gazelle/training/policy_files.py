"""A run's policy as files that go elsewhere: ONNX or numpy arrays, and the contract beside them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from gazelle.argument_checks import checked
from gazelle.envs.contract import PolicyContract
from gazelle.errors import FormatError, TaskError, did_you_mean
from gazelle.training.actor import Actor, load_actor
from gazelle.training.contracts import CONTRACT, load_contract, run_contract
from gazelle.training.importing import load_all
from gazelle.training.recipes import task_name
from gazelle.training.runs import Run
from gazelle_ros.base.writing import replacing, write_bytes, write_text

FORMATS = {"onnx": ".onnx", "numpy": ".npz"}
"""The formats by name, with the ends of their files' names."""
_GONE = {
    "torchscript": "PyTorch has deprecated TorchScript; onnx runs in C++ and Python with ONNX Runtime"
}


@dataclass(frozen=True, slots=True)
class PolicyFiles:
    """Files written by an export."""

    policy: Path
    """The policy."""
    contract: Path
    """Contract of its observations and actions, as JSON; see `PolicyContract`."""


@checked(TaskError)
def export_policy(
    run: str | Path,
    format: str = "onnx",  # noqa: A002  # the word of the command line
    out: str | Path | None = None,
    *,
    best: bool = False,
    imports: Sequence[str] = (),
    trust: bool = False,
) -> PolicyFiles:
    """Write a run's policy for use elsewhere, and its contract beside it.

    Both formats act as Stable-Baselines3's ``predict(observation, deterministic=True)`` does, on
    observations as the task gives them: scaling, features and the bounds of actions are inside.
    `load_actor` reads the numpy file, which needs neither torch nor pickle.

    Args:
        run: The run's folder.
        format: ``onnx`` or ``numpy``.
        out: The policy's file, or a folder for it; by default the folder ``export`` of the run.
            Its name is then the task's. The contract's is the same, ending in ``.json``.
        best: Take the best policy of the evaluations during the training, not the newest.
        imports: Modules or files that register the task, instead of those that the run names.
        trust: Whether to import those.

    Raises:
        TaskError: There is no such format, the files cannot be written, or the run names code
            that is not trusted.
        FormatError: The run is damaged or has no policy yet.
        MissingExtraError: The package ``onnx`` is not installed.
    """
    check_format(format)
    found = Run.open(Path(run))
    contract = run_contract(found, load_all(imports), trust=trust)
    actor = load_actor(found.policy_file(best=best))
    if actor.inputs != contract.size:
        raise TaskError(
            f"the policy takes {actor.inputs} numbers, the contract defines {contract.size}",
            hint="the run's contract.json is of another task; remove it to have it made again",
        )
    policy = _place(found, FORMATS[format], None if out is None else Path(out))
    beside = policy.with_suffix(".json")
    try:
        policy.parent.mkdir(parents=True, exist_ok=True)
        _write(actor, contract, policy)
        write_text(beside, json.dumps(contract.to_dict(), indent=2) + "\n")
    except OSError as error:
        hint = "give another file with --out"
        raise TaskError(f"cannot write the policy: {error}", hint=hint) from error
    return PolicyFiles(policy, beside)


def check_format(name: str) -> None:
    """Raise an error for an unknown format.

    Raises:
        TaskError: There is none of this name.
    """
    if name not in FORMATS:
        hint = _GONE.get(name) or did_you_mean(name, FORMATS)
        raise TaskError(f"there is no format '{name}' for policies", hint=hint)


@checked(TaskError)
def load_policy(
    source: str | Path, *, imports: Sequence[str] = (), trust: bool = False
) -> tuple[Path, PolicyContract]:
    """Return the file of a policy and its contract.

    Args:
        source: Folder of a run, or a file that `export_policy` wrote.
        imports: Modules or files that register the task, instead of those that the run names.
        trust: Whether to import those.

    Raises:
        FormatError: There is none, or the contract is missing or damaged.
        TaskError: The run names code that is not trusted.
    """
    path = Path(source)
    if path.is_dir():
        run = Run.open(path)
        contract = run_contract(run, load_all(imports), trust=trust)
        return run.policy_file(), contract
    if path.name in {"policy.npz", "best.npz"} and (path.parent / CONTRACT).is_file():
        return path, load_contract(path.parent / CONTRACT)
    if not path.exists():
        raise FormatError(
            "there is no such file or folder",
            file=str(path),
            hint="expected the folder of a training run, or a policy that 'gazelle export' wrote",
        )
    return path, load_contract(path.with_suffix(".json"))


def _place(run: Run, suffix: str, out: Path | None) -> Path:
    name = task_name(run.config.task) + suffix
    if out is None:
        return run.folder / "export" / name
    if out.suffix == suffix:
        return out
    if out.suffix in FORMATS.values():
        raise TaskError(f"the file should end in {suffix}, not in {out.suffix}")
    return out / name


def _write(actor: Actor, contract: PolicyContract, file: Path) -> None:
    if file.suffix == ".npz":
        with replacing(file) as draft:
            actor.save(draft)
        return
    from gazelle.training.onnx_graph import onnx_model

    text = json.dumps(contract.to_dict())
    model = onnx_model(actor, metadata={"gazelle_contract": text})
    write_bytes(file, model.SerializeToString())
