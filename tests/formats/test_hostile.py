"""Files made to do harm: an end within 5 s and 1 GB, in a result or in one of our errors.

Each file is loaded in a process of its own, whose memory and time are limited.
"""

import resource
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from test_robustness import SDF, URDF, XACRO, survives
from xml_samples import INERTIAL, robot, sdf, urdf_joint, urdf_link

import gazelle
from gazelle import FormatError, formats
from gazelle.errors import FormatWarning
from gazelle.formats import load_mesh

GIGABYTE = 2**30
CHILD = """
import resource, sys, time, warnings
warnings.simplefilter("ignore")
from gazelle import Error, formats
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
start = time.process_time()
try:
    formats.load(sys.argv[1])
    said = "result"
except Error as error:
    said = "error"
seconds = time.process_time() - start
grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024
print(said, seconds, grown)
"""


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (4 * GIGABYTE, 4 * GIGABYTE))


def fate(file):
    """Return (result or error, seconds, bytes) of a load in a process of its own."""
    run = subprocess.run(
        [sys.executable, "-c", CHILD, str(file)],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        cwd=Path(gazelle.__file__).parents[1],
        preexec_fn=limit_memory,
    )
    assert run.returncode == 0, run.stderr[-500:]
    said, seconds, grown = run.stdout.split()
    return said, float(seconds), float(grown)


def deep(tag, attributes="", levels=10_000):
    """Return elements nested in each other."""
    return "".join(f"<{tag} {attributes}>" for _ in range(levels)) + f"</{tag}>" * levels


def laughs(kind):
    lines = ['<!ENTITY l0 "ha">']
    lines += [f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 10)]
    return f"<?xml version='1.0'?><!DOCTYPE x [{''.join(lines)}]>{kind.format('&l9;')}"


BODY = "<sdf version='1.7'><model name='{}'><link name='l'/></model></sdf>"
MACRO = "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>{}</robot>"
BOMBS = {
    "deep.sdf": sdf(deep("model", "name='m'")),
    "deep.urdf": robot(deep("link", "name='l'")),
    "deep.xacro": MACRO.format(deep("group")),
    "deep_plugin.sdf": sdf(
        f"<model name='m'><plugin name='p' filename='f'>{deep('a')}</plugin></model>"
    ),
    "laughs.sdf": laughs(BODY),
    "laughs.urdf": laughs("<robot name='{}'><link name='l'/></robot>"),
    "laughs.xacro": laughs(MACRO),
    "quadratic.sdf": (
        f"<!DOCTYPE x [<!ENTITY a '{'a' * 100_000}'>]>" + BODY.format("&a;" * 10_000)
    ),
    "external.sdf": ("<!DOCTYPE x [<!ENTITY e SYSTEM 'file:///etc/passwd'>]>" + BODY.format("&e;")),
    "parameter.sdf": (
        "<!DOCTYPE x [<!ENTITY % e SYSTEM 'file:///etc/passwd'> %e;]>" + BODY.format("m")
    ),
    "doctype.sdf": "<!DOCTYPE x SYSTEM 'http://192.0.2.1/x.dtd'>" + BODY.format("m"),
    "macro_bomb.xacro": MACRO.format(
        "<xacro:macro name='m0' params=''><link name='l'/></xacro:macro>"
        + "".join(
            f"<xacro:macro name='m{i}' params=''>{f'<xacro:m{i - 1}/>' * 10}</xacro:macro>"
            for i in range(1, 9)
        )
        + "<xacro:m8/>"
    ),
    "power.xacro": MACRO.format("<link name='${9**9**9}'/>"),
    "string.xacro": MACRO.format("<link name='${&quot;a&quot; * 10**10}'/>"),
    "range.xacro": MACRO.format("<link name='${[i for i in range(10**10)]}'/>"),
    "spaces.sdf": BODY.format("m") + " " * 5_000_000,
    "long_name.sdf": BODY.format("m" * 5_000_000),
    "many.sdf": sdf("<model name='m'>" + "<link name='l'/>" * 50_000 + "</model>"),
    "many_models.sdf": sdf(
        "<model name='m'><link name='l'/>"
        + "<model name='m'><link name='l'/></model>" * 20_000
        + "</model>"
    ),
    "attributes.sdf": "<sdf version='1.7' "
    + " ".join(f"a{i}='x'" for i in range(50_000))
    + "><model name='m'><link name='l'/></model></sdf>",
    "population.sdf": sdf(
        "<world name='w'><population name='p'><model name='m'><link name='l'/></model>"
        "<model_count>999999999</model_count></population></world>"
    ),
    "wide.urdf": robot(
        "".join(urdf_link(f"l{i}") for i in range(5000))
        + "".join(urdf_joint(f"j{i}", "l0", f"l{i}") for i in range(1, 5000))
    ),
}
QUICK = [
    "deep.sdf",
    "laughs.sdf",
    "many.sdf",
    "laughs.xacro",
    "external.sdf",
    "macro_bomb.xacro",
    "power.xacro",
]


@pytest.mark.long
@pytest.mark.parametrize("name", QUICK)
def test_bombs_end_soon(tmp_path, name):
    meets_its_end(tmp_path, name)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in BOMBS if name not in QUICK])
def test_more_bombs_end_soon(tmp_path, name):
    meets_its_end(tmp_path, name)


def meets_its_end(folder, name):
    file = folder / name
    file.write_text(BOMBS[name])
    _, seconds, grown = fate(file)
    assert seconds < 5.0
    assert grown < GIGABYTE


@pytest.mark.parametrize("uri", ["file:///etc/passwd", "/etc/passwd", "../" * 12 + "etc/passwd"])
def test_files_elsewhere_are_as_good_as_missing(tmp_path, uri):
    (tmp_path / "deep/er").mkdir(parents=True)
    for name, text in {
        "r.urdf": robot(
            f"<link name='l'>{INERTIAL}<visual><geometry><mesh filename='{uri}'/></geometry></visual></link>"
        ),
        "w.sdf": sdf(
            "<model name='m'><link name='l'><collision name='c'><geometry>"
            f"<mesh><uri>{uri}</uri></mesh></geometry></collision></link></model>"
        ),
    }.items():
        file = tmp_path / "deep/er" / name
        file.write_text(text)
        with pytest.warns(FormatWarning, match="not found"):
            model = formats.load_model(file)
        link = model.links[0]
        mesh = (*link.collisions, *link.visuals)[0].geometry
        assert mesh.path is None
        with pytest.raises(FormatError):
            load_mesh(mesh)


@pytest.mark.parametrize("kind", ["mesh", "include", "xacro", "model.config"])
def test_links_out_of_the_tree_are_not_followed(tmp_path, kind):
    secret = tmp_path / "private/secret"
    secret.mkdir(parents=True)
    home = tmp_path / "a/b/c/d/e/project"
    home.mkdir(parents=True)
    (secret / "x.sdf").write_text(sdf("<model name='stolen'><link name='l'/></model>"))
    (secret / "x.stl").write_text("solid")
    (secret / "x.xacro").write_text(MACRO.format("<link name='stolen'/>"))
    (secret / "model.config").write_text("<model><sdf version='1.7'>x.sdf</sdf></model>")
    for name in ("x.sdf", "x.stl", "x.xacro"):
        (home / name).symlink_to(secret / name)
    (home / "thief").symlink_to(secret)
    texts = {
        "mesh": sdf(
            "<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>x.stl</uri>"
            "</mesh></geometry></visual></link></model>"
        ),
        "include": sdf("<world name='w'><include><uri>x.sdf</uri></include></world>"),
        "model.config": sdf("<world name='w'><include><uri>model://thief</uri></include></world>"),
        "xacro": MACRO.format("<xacro:include filename='x.xacro'/>"),
    }
    file = home / ("r.xacro" if kind == "xacro" else "w.sdf")
    file.write_text(texts[kind])
    if kind == "xacro":
        with pytest.raises(FormatError, match="outside of the folders"):
            formats.load(file)
        return
    with pytest.warns(FormatWarning, match="not found"):
        world = formats.load(file)
    assert "stolen" not in [model.name for model in world.models]
    if kind == "mesh":
        assert world.models[0].links[0].visuals[0].geometry.path is None


NUMBERS = [
    "nan",
    "-nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-320",
    "1e999",
    "0",
    "-0",
    "",
    "0x7f",
]


@pytest.mark.long
@settings(max_examples=150, deadline=5000, suppress_health_check=list(HealthCheck))
@given(st.sampled_from([SDF, URDF]), st.sampled_from(NUMBERS), st.integers(0, 10**6))
def test_any_number_may_be_anything(text, value, chosen):
    """Every number of the file in turn is replaced, all at once too."""
    pieces = text.split("'") if text is URDF else text.replace("<", ">").split(">")
    mark = "'" if text is URDF else None
    places = [i for i, piece in enumerate(pieces) if _is_numbers(piece)]
    which = set(places) if chosen % 10 == 0 else {places[chosen % len(places)]}
    changed = [
        " ".join([value] * len(piece.split())) if i in which else piece
        for i, piece in enumerate(pieces)
    ]
    if mark:
        survives(mark.join(changed))
        return
    marks = [c for c in text if c in "<>"]
    survives("".join(a + b for a, b in zip(changed, [*marks, ""], strict=True)))


@pytest.mark.parametrize(
    "text",
    [
        "${[c.__class__ for c in [1]]}",
        "${(lambda: ().__class__)()}",
        "${(x for x in []).gi_frame.f_builtins}",
        "${(lambda: 0).func_globals if 0 else (lambda: 0).__globals__}",
        "${python.vars(python.type)['__subclasses__'](python.type(1).mro()[1])}",
        "${python.type(1).mro()[0].__subclasses__()}",
        "$(eval open('/etc/passwd').read())",
        "$(eval __import__('os').getcwd())",
        "${open('/etc/passwd')}",
        "${2**10**9}",
        "${1 << 10**9}",
        "${'a'.ljust(10**9)}",
        "${[0] * 10**9}",
        "${math.factorial(10**7)}",
        "${sum(python.range(10**10))}",
        "${[i for i in python.range(90000) for j in python.range(90000)]}",
        "${" + "(" * 5000 + "1" + ")" * 5000 + "}",
        "$(eval 9**9**9)",
    ],
)
def test_expressions_lead_nowhere_else(text):
    with pytest.raises(FormatError):
        formats.load_string(
            MACRO.format(f"<xacro:property name='p' value=\"{text}\"/><link name='a${{p}}'/>")
        )


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("${2**3 * 1.5}", "12.0"),
        ("${'ab' * 2}", "abab"),
        ("${[2 * i for i in python.range(3)][2]}", "4"),
        ("${math.sin(0) + radians(0)}", "0.0"),
        ("${'7'.zfill(3)}", "7"),
        ("$(eval 'x' if 1 &lt;&lt; 2 == 4 else 'y')", "x"),
    ],
)
def test_plain_expressions_work(text, value):
    body = f"<xacro:property name='p' value=\"{text}\"/><link name='n${{p}}'>{INERTIAL}</link>"
    assert formats.load_model_string(MACRO.format(body)).links[0].name == f"n{value}"


@pytest.mark.parametrize(
    "name", ["_unknown_", "f_x", "co_x", "tb_side", "gi_a", "_power", "_width"]
)
def test_properties_may_have_almost_any_name(name):
    body = (
        f"<xacro:property name='{name}' value='3'/>"
        f"<link name=\"n${{{name} ** 2}}${{'7'.zfill(2)}}\">{INERTIAL}</link>"
    )
    assert formats.load_model_string(MACRO.format(body)).links[0].name == "n907"


def _is_numbers(text):
    try:
        return bool([float(word) for word in text.split()])
    except ValueError:
        return False


@settings(max_examples=100, deadline=5000, suppress_health_check=list(HealthCheck))
@given(st.sampled_from([SDF, URDF, XACRO]), st.data())
def test_any_end_may_be_missing(text, data):
    survives(text[: data.draw(st.integers(0, len(text)))])


@pytest.mark.slow
@pytest.mark.corpus
def test_files_of_the_corpus_with_bytes_flipped(corpus):
    import random

    chance = random.Random(0)
    files = [f for kind in ("sdf", "world", "urdf") for f in corpus.rglob(f"*.{kind}")]
    for file in chance.sample(sorted(files), 150):
        data = bytearray(file.read_bytes()[:50_000])
        for _ in range(3):
            for _ in range(chance.randrange(1, 6)):
                data[chance.randrange(len(data))] = chance.randrange(256)
            survives(bytes(data))
