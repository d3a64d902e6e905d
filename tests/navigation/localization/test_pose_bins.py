"""Bins of poses are what numpy's unique finds, and clusters what a search from bin to bin finds."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.navigation.localization.particle_filter import ParticleFilter
from gazelle.navigation.localization.pose_bins import PoseBins

SPREADS = st.floats(1e-3, 1e3)


def places_of(poses):
    return [tuple(place) for place in np.floor(poses / [0.5, 0.5, 0.2]).astype(int).tolist()]


def clusters_by_hand(places):
    label = {}
    for number, seed in enumerate(dict.fromkeys(places)):
        if seed in label:
            continue
        label[seed], front = number, [seed]
        while front:
            here = front.pop()
            for side in itertools.product((-1, 0, 1), repeat=3):
                other = tuple(a + b for a, b in zip(here, side, strict=True))
                if other in set(places) - set(label):
                    label[other] = number
                    front.append(other)
    return [label[place] for place in places]


@given(st.integers(0, 2**32 - 1), st.integers(1, 60), SPREADS, SPREADS)
def test_bins_and_clusters_are_those_of_a_search_by_hand(seed, count, side, turn):
    random = np.random.default_rng(seed)
    poses = random.normal(0.0, 1.0, (count, 3)) * [side, side, turn]
    bins, places = PoseBins(poses, 0.5, 0.2), places_of(poses)
    assert bins.count == len(set(places))
    assert bins.counts().tolist() == [len(set(places[: n + 1])) for n in range(count)]
    found, wanted = bins.clusters().tolist(), clusters_by_hand(places)
    assert len(set(zip(found, wanted, strict=True))) == len(set(found)) == len(set(wanted))


def test_bins_far_from_the_origin_do_not_touch_by_accident():
    far = np.array([[0.1, 0.1, 0.1], [1e6, -1e6, 0.1], [1e6 + 0.5, -1e6, 0.1], [0.6, 0.1, 0.1]])
    assert PoseBins(far, 0.5, 0.2).clusters().tolist() == [0, 1, 1, 0]


def test_as_many_particles_stay_as_their_bins_need():
    filter_ = ParticleFilter(10, 4000, 0.05, 0.99, 0.0, 0.0, np.random.default_rng(0))
    filter_.begin(np.random.default_rng(1).normal(0.0, 0.2, (4000, 3)))
    filter_.resample(np.zeros)
    counts = PoseBins(filter_.poses, 0.5, np.radians(10.0)).counts()
    enough = np.arange(1, len(counts) + 1) > filter_.needed(counts)
    assert 100 < len(counts) < 4000
    assert enough.nonzero()[0].tolist() == [len(counts) - 1]


@pytest.mark.parametrize("split", [1, 7, 100])
def test_the_estimate_is_the_mean_of_the_heaviest_cluster_and_the_spread_of_all(split):
    random = np.random.default_rng(split)
    poses = random.normal(0.0, 0.1, (200, 3))
    poses[:split] += [5.0, 0.0, 3.0]
    filter_ = ParticleFilter(200, 200, 0.05, 0.99, 0.0, 0.0, random)
    filter_.begin(poses)
    weights = random.uniform(0.5, 1.5, 200)
    filter_.weigh(weights)
    weights /= weights.sum()
    found = filter_.estimate()
    own = np.arange(200) < split if weights[:split].sum() > 0.5 else np.arange(200) >= split
    share = weights[own] / weights[own].sum()
    assert found.weight == pytest.approx(weights[own].sum())
    assert found.pose[:2] == pytest.approx(share @ poses[own, :2])
    way = share @ np.exp(1j * poses[own, 2])
    assert np.exp(1j * found.pose[2]) == pytest.approx(way / abs(way))
    assert found.covariance[:2, :2] == pytest.approx(
        np.cov(poses[:, :2].T, ddof=0, aweights=weights)
    )
    assert found.covariance[2, 2] == pytest.approx(
        -2 * np.log(abs(weights @ np.exp(1j * poses[:, 2])))
    )
