"""Random numbers, names, poses and elements, of which descriptions are made."""

from types import MappingProxyType

from hypothesis import strategies as st

from gazelle.description import Noise, Parameters, Plugin, Pose

flags = st.booleans()
reals = st.floats(-1e6, 1e6) | st.sampled_from([0.0, 0.1, 1 / 3, 1e-300, 1e15])
positive = st.floats(1e-6, 1e6)
masses = st.floats(2e-6, 1e6)  # libsdformat takes 1 mg of a URDF's link for nothing
not_negative = st.floats(0, 1e6)
counts = st.integers(0, 10_000)
names = st.text("abcxyz_-. é<&\"'", min_size=1, max_size=6).filter(lambda s: s == s.strip())
texts = st.text(st.characters(min_codepoint=32, max_codepoint=0x2FFF), max_size=8).filter(
    lambda s: s == s.strip() and not any(0x7F <= ord(c) <= 0x9F for c in s)
)
tags = st.sampled_from(["alpha", "beta", "gamma", "ns:delta"])


def vectors(part=reals, size=3):
    return st.tuples(*[part] * size)


colors = vectors(st.floats(0, 1), 4)


@st.composite
def units(draw):
    x, y, z = draw(vectors(st.floats(-1, 1)).filter(lambda v: sum(c * c for c in v) > 0.01))
    length = (x * x + y * y + z * z) ** 0.5
    return (x / length, y / length, z / length)


@st.composite
def poses(draw):
    kind = draw(st.integers(0, 3))
    if kind == 0:
        return Pose()
    if kind == 1:
        return Pose(*draw(vectors()), *draw(vectors(st.sampled_from([0.0, 1.5708, -0.3, 0.1]))))
    if kind == 2:
        return Pose(*draw(vectors(st.floats(-10, 10))), *draw(vectors(st.floats(-7, 7))))
    numbers = draw(vectors(st.floats(-1, 1), 4).filter(lambda q: sum(c * c for c in q) > 0.01))
    return Pose.from_quaternion(draw(vectors()), numbers)


def elements(tag=tags):
    return st.recursive(
        element(tag, st.just(())),
        lambda inner: element(tags, st.lists(inner, max_size=3).map(tuple)),
        max_leaves=5,
    )


def element(tag, children):
    attributes = st.dictionaries(st.sampled_from(["a", "b"]), texts, max_size=2)
    return st.builds(Parameters, tag, texts, attributes.map(MappingProxyType), children)


def named_elements(tag):
    attributes = MappingProxyType({"name": "some"})
    children = st.lists(elements(), max_size=2).map(tuple)
    return st.builds(Parameters, st.just(tag), texts, st.just(attributes), children)


plugins = st.builds(
    Plugin, names, names, element(st.just("plugin"), st.lists(elements(), max_size=2).map(tuple))
)
noises = st.builds(
    Noise,
    st.sampled_from(["none", "gaussian", "gaussian_quantized"]),
    *([reals, not_negative] * 2),
    *([not_negative] * 3),
)
