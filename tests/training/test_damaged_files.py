"""Damaged and hostile files of a run are one clear error, whatever was done to them."""

import contextlib
import io
import pickle
import zipfile

import numpy as np
import pytest
import torch

from gazelle.bounded_npz import MAX_BYTES
from gazelle.errors import Error, FormatError, TaskError
from gazelle.training import portable
from gazelle.training.actor import Actor, load_actor
from gazelle.training.checkpoint import _set_torch_state, usable
from gazelle.training.statistics import EpisodeLog
from gazelle.training.user_callbacks import make_callbacks


def policy(tmp_path):
    draws = np.random.default_rng(0)
    shapes = ((3, 8), (8, 2))
    Actor(
        weights=tuple(draws.normal(size=shape).astype(np.float32) for shape in shapes),
        biases=tuple(np.zeros(shape[1], np.float32) for shape in shapes),
        activation="tanh",
        head="gaussian",
        log_std=np.zeros(2, np.float32),
        low=-np.ones(2, np.float32),
        high=np.ones(2, np.float32),
    ).save(tmp_path / "policy.npz")
    return tmp_path / "policy.npz"


def header_of(shape, kind="<f4"):
    file = io.BytesIO()
    about = {"descr": kind, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(file, about)
    return file.getvalue()


def with_member(file, name, data):
    """Replace an array by something else."""
    with zipfile.ZipFile(file) as old:
        members = {each: old.read(each) for each in old.namelist()}
    members[f"{name}.npy"] = data
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
        for each, content in members.items():
            new.writestr(each, content)


@pytest.mark.parametrize("seed", range(200))
def test_a_policy_with_bytes_changed_is_read_or_refused(tmp_path, seed):
    file = policy(tmp_path)
    draws, data = np.random.default_rng(seed), bytearray(file.read_bytes())
    for _ in range(draws.integers(1, 6)):
        where = draws.integers(len(data))
        how = draws.integers(3)
        if how == 0:
            data[where] = draws.integers(256)
        elif how == 1:
            del data[where : where + draws.integers(1, 50)]
        else:
            data = data[: max(1, where)]
    file.write_bytes(data)
    with contextlib.suppress(FormatError):
        load_actor(file)


@pytest.mark.parametrize(
    ("shape", "complaint"),
    [((2**40,), "is cut off"), ((2**31, 2**31), "is cut off"), ((3, 9), "EOF")],
)
def test_an_array_that_says_to_be_larger_than_it_is_takes_no_room(tmp_path, shape, complaint):
    file = policy(tmp_path)
    with_member(file, "weight0", header_of(shape))
    with pytest.raises(FormatError, match=complaint):
        load_actor(file)


@pytest.mark.parametrize("point", [0x110000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF])
@pytest.mark.parametrize("order", "<>")
def test_text_that_is_no_unicode_is_refused(tmp_path, point, order):
    text = np.array('{"format": 1, "layers": 2, "head": "?"}', dtype=f"{order}U39")
    points = text.reshape(1).view(f"{order}u4")
    points[-3] = point
    array = header_of((), text.dtype.str) + text.tobytes()
    file = policy(tmp_path)
    with_member(file, "about", array)
    portable.save(tmp_path / "state", {"names": np.array(["a"])})
    with_member(tmp_path / "state.npz", "names", array)
    for read in (lambda: load_actor(file), lambda: portable.load(tmp_path / "state")):
        with pytest.raises(FormatError, match=r"'\w+.npy' has text that is not Unicode"):
            read()


def test_an_array_with_fields_is_refused(tmp_path):
    file = policy(tmp_path)
    pair = np.zeros(1, [("a", "<U1"), ("b", "<f4")])
    with_member(file, "about", header_of((1,), pair.dtype.descr) + pair.tobytes())
    with pytest.raises(FormatError, match=r"'about.npy' has fields"):
        load_actor(file)


def test_a_policy_that_unpacks_to_gigabytes_is_refused_before(tmp_path):
    file = policy(tmp_path)
    with zipfile.ZipFile(file, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("bias9.npy", header_of((2,)))
        archive.infolist()[-1].file_size = 4 << 30
    with pytest.raises(FormatError, match=rf"more than the limit of {MAX_BYTES:,}"):
        load_actor(file)


@pytest.mark.parametrize("shape", [(4, 8), (3, 7), (3,), (0, 8), (3, 8, 1)])
def test_layers_that_do_not_fit_each_other_are_found_when_they_are_read(tmp_path, shape):
    file = policy(tmp_path)
    with_member(file, "weight1", header_of(shape) + bytes(4 * int(np.prod(shape))))
    with pytest.raises(FormatError, match="not a policy"):
        load_actor(file)


def test_a_policy_that_is_not_there_or_a_folder_is_one_clear_error(tmp_path):
    for file in (tmp_path / "none.npz", tmp_path):
        with pytest.raises(FormatError, match="not a policy"):
            load_actor(file)


class Evil:
    def __reduce__(self):
        return exec, ("raise SystemExit('executed')",)


@pytest.mark.parametrize("how", ["torch", "pickle", "cut", "empty"])
def test_weights_that_hold_more_than_numbers_are_refused_without_bad_advice(tmp_path, how):
    file = tmp_path / "learner.pt"
    if how == "pickle":
        file.write_bytes(pickle.dumps(Evil()))
    else:
        torch.save({"modules": Evil()}, file)
    if how in ("cut", "empty"):
        file.write_bytes(file.read_bytes()[: 0 if how == "empty" else 100])
    with pytest.raises(FormatError, match="cannot use these weights") as caught:
        _set_torch_state(None, file)
    assert "weights_only" not in str(caught.value)


@pytest.mark.parametrize("seed", range(40))
def test_a_state_with_bytes_changed_is_read_or_refused(tmp_path, seed):
    portable.save(tmp_path / "state", {"a": np.arange(5), "b": [1, (2, "x")], "c": b"bytes"})
    draws = np.random.default_rng(seed)
    file = tmp_path / ("state.json" if seed % 2 else "state.npz")
    data = bytearray(file.read_bytes())
    for _ in range(3):
        data[draws.integers(len(data))] = draws.integers(256)
    file.write_bytes(data)
    with contextlib.suppress(Error):
        portable.load(tmp_path / "state")


@pytest.mark.parametrize("rows", [[1.0, 2.0], 3.0, "a", [[1.0]], [[1.0] * 7], None])
def test_an_account_of_another_shape_is_refused(tmp_path, rows):
    with pytest.raises(FormatError, match="cannot use the checkpoint"), usable(tmp_path):
        EpisodeLog().set_state({"rows": rows, "total": 1})
    with pytest.raises(FormatError, match="cannot use the checkpoint"), usable(tmp_path):
        EpisodeLog().set_state({"rows": np.zeros((0, 6)), "total": float("inf")})


@pytest.mark.parametrize(
    "name", ["Counter", ":Counter", ".x:Counter", "no_such_module_at_all:Counter"]
)
def test_callbacks_of_a_run_that_cannot_be_imported(name):
    with pytest.raises(TaskError, match="cannot import the callback"):
        make_callbacks([name])


@pytest.mark.parametrize("name", ["BaseCallback", "EveryNTimesteps", "CallbackList"])
def test_callbacks_of_a_run_that_cannot_be_created(name):
    with pytest.raises(TaskError, match="cannot create the callback"):
        make_callbacks([f"stable_baselines3.common.callbacks:{name}"])
