from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import FormatError
from gazelle.training import portable

leaves = (
    st.none()
    | st.booleans()
    | st.integers(min_value=-(2**140), max_value=2**140)
    | st.floats(allow_nan=False)
    | st.text()
    | st.binary()
)
values = st.recursive(
    leaves,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.lists(inner, max_size=4).map(tuple)
        | st.dictionaries(st.text().filter(lambda key: not key.startswith("__")), inner, max_size=4)
    ),
    max_leaves=12,
)


@given(values)
def test_what_is_packed_comes_back_the_same(value):
    again = portable.unpack(*portable.pack(value))
    assert again == value
    assert type(again) is type(value)


def test_files_hold_arrays_with_their_types(tmp_path):
    state = {"a": np.arange(3, dtype=np.int8), "b": [np.float32(0.1)], "c": np.zeros((2, 0), bool)}
    portable.save(tmp_path / "state", state)
    again = portable.load(tmp_path / "state")
    assert again["a"].dtype == np.int8
    assert again["b"][0] == np.float32(0.1)
    assert again["c"].shape == (2, 0)


def test_generator_states_survive(tmp_path):
    rng = np.random.default_rng(3)
    portable.save(tmp_path / "state", rng.bit_generator.state)
    expected = rng.random(5)
    rng.bit_generator.state = portable.load(tmp_path / "state")
    assert (rng.random(5) == expected).all()


@pytest.mark.parametrize("value", [object(), {1: 2}, np.array([None]), {"a": {3, 4}}])
def test_what_cannot_be_data_is_refused(value):
    with pytest.raises(FormatError, match="cannot store state"):
        portable.pack(value)


def test_python_objects_in_a_file_are_not_run(tmp_path):
    portable.save(tmp_path / "state", {"a": np.zeros(1)})
    np.savez(tmp_path / "state.npz", **{"state.a": np.array([print], dtype=object)})
    with pytest.raises(FormatError, match="not a readable state"):
        portable.load(tmp_path / "state")


@pytest.mark.parametrize("name", ["state.npz", "state.json"])
def test_a_cut_file_is_one_clear_error(tmp_path, name):
    portable.save(tmp_path / "state", {"a": np.zeros(100)})
    file = tmp_path / name
    file.write_bytes(file.read_bytes()[:20])
    with pytest.raises(FormatError, match="not a readable state"):
        portable.load(tmp_path / "state")
