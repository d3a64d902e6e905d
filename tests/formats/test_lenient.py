"""Faults that the formats forbid and Gazebo tolerates: one warning, an error for a check."""

import math
import warnings

import libsdformat
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from xml_samples import INERTIAL, joint, link, model, robot, sdf, world

from gazelle import FormatError, formats
from gazelle.description import Cylinder, Mesh, Plane
from gazelle.errors import FormatWarning

LINK = "<link name='l'/>"
TWO = "<link name='a'/><link name='b'/>"


def one_warning(read, *args):
    """Return the result, and its single warning."""
    with pytest.warns(FormatWarning) as caught:
        found = read(*args)
    assert len(caught) == 1, [str(each.message) for each in caught]
    return found, str(caught[0].message)


def shape(text):
    return f"<link name='l'><collision name='c'><geometry>{text}</geometry></collision></link>"


def axis(inner, tail=""):
    return (
        f"{TWO}<joint name='j' type='revolute'><parent>a</parent><child>b</child>"
        f"<axis>{inner}</axis>{tail}</joint>"
    )


@pytest.mark.parametrize(
    ("written", "taken"),
    [
        ("1 2 3", (1, 2, 3, 0, 0, 0)),
        ("1 2 3 0.1 0.2", (1, 2, 3, 0, 0, 0)),
        ("1 2 3 0 0 0.5 7 8", (1, 2, 3, 0, 0, 0.5)),
        ("1 2 3 0 0 0.5 7 8 9 10 11 12", (1, 2, 3, 0, 0, 0.5)),
        ("1", (1, 0, 0, 0, 0, 0)),
        ("1, 2, 3, 0, 0, 0.5", (1, 2, 3, 0, 0, 0.5)),
        ("1 2 3 0 0 1.57f", (1, 2, 3, 0, 0, 1.57)),
        ("1 2 3 0 0 pi", (1, 2, 3, 0, 0, 0)),
        ("1 2 3 x 0 0", (1, 2, 3, 0, 0, 0)),
    ],
)
def test_a_pose_keeps_the_numbers_that_it_begins_with(written, taken):
    found, text = one_warning(model, f"<link name='l'>\n<pose>{written}</pose></link>")
    pose = found.links[0].pose
    assert (*pose.position, *pose.rpy) == pytest.approx(taken)
    assert text.startswith("test.sdf:5: <sdf/model[@name='m']/link[@name='l']/pose>:")
    assert "was taken" in text


@given(st.lists(st.floats(-9, 9), min_size=1, max_size=14), st.sampled_from([" ", "\n", ", "]))
@settings(max_examples=80, deadline=None)
def test_a_pose_of_any_length_is_read(numbers, between):
    text = between.join(f"{number:.17g}" for number in numbers)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = model(f"<link name='l'><pose>{text}</pose></link>").links[0].pose
    assert bool(caught) == (len(numbers) != 6 or "," in between)
    assert found.position == tuple((*numbers, 0.0, 0.0)[:3])
    if len(numbers) >= 6:
        assert found.is_close(type(found)(*numbers[:6]))


@pytest.mark.parametrize(
    "body",
    [
        "<link name='l'><pose>one 0 0 0 0 0</pose></link>",
        "<link name='l'><pose>nan 0 0 0 0 0</pose></link>",
        "<link name='l'><inertial><mass>heavy</mass></inertial></link>",
        "<static>maybe</static><link name='l'/>",
    ],
)
def test_what_begins_with_no_number_is_still_an_error(body):
    with pytest.raises(FormatError):
        model(body)


def test_poses_of_states_and_populations_are_mended_too():
    found, _ = one_warning(
        world,
        "<model name='a'><link name='l'/></model>"
        "<state world_name='w'><model name='a'><pose>1 2 3</pose></model></state>",
    )
    assert found.models[0].pose.position == (1, 2, 3)
    found, _ = one_warning(
        world,
        "<population name='p'><model name='a'><link name='l'><pose>1 2 3</pose></link></model>"
        "<pose>5 5 5</pose><model_count>2</model_count><box><size>1 1 1</size></box>"
        "<distribution><type>random</type></distribution></population>",
    )
    assert {m.links[0].pose.position for m in found.models} == {(1, 2, 3)}


@pytest.mark.parametrize(
    ("written", "taken"),
    [("10 20 30", (10, 20)), ("10", (10, 10)), ("10 20 x", (10, 20)), ("4,5", (4, 5))],
)
def test_the_size_of_a_plane(written, taken):
    text = f"<plane><size>{written}</size></plane>"
    found, _ = one_warning(model, f"<static>1</static>{shape(text)}")
    assert found.links[0].collisions[0].geometry == Plane((0, 0, 1), taken)


@pytest.mark.parametrize(
    ("written", "taken"),
    [("0.001", (0.001,) * 3), ("2 3", (2, 3, 1)), ("1 2 3 4", (1, 2, 3)), ("1 0 1", (1, 0, 1))],
)
def test_the_scale_of_a_mesh(written, taken, tmp_path):
    (tmp_path / "a.stl").write_bytes(bytes(84))
    file = tmp_path / "model.sdf"
    text = shape(f"<mesh><uri>a.stl</uri><scale>{written}</scale></mesh>")
    file.write_text(sdf(f"<model name='m'>{text}</model>"))
    found, _ = one_warning(formats.load_model, file)
    geometry = found.links[0].collisions[0].geometry
    assert isinstance(geometry, Mesh)
    assert geometry.scale == taken


@pytest.mark.parametrize(
    ("written", "taken"),
    [("0.1 0.2", (0.1, 0.2, 0, 1)), ("1", (1, 0, 0, 1)), ("0 0 1 1 9", (0, 0, 1, 1))],
)
def test_colours_of_another_length(written, taken):
    body = (
        "<link name='l'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry>"
        f"<material><ambient>{written}</ambient></material></visual></link>"
    )
    found, _ = one_warning(model, body)
    assert found.links[0].visuals[0].material.ambient == taken


@pytest.mark.parametrize(
    ("inner", "taken"),
    [
        ("<cylinder><radius>1</radius><length>0</length></cylinder>", Cylinder(1, 1e-4)),
        ("<cylinder><radius>1</radius><length>-2</length></cylinder>", Cylinder(1, 2)),
    ],
)
def test_lengths_that_are_not_greater_than_zero(inner, taken):
    found, _ = one_warning(model, shape(inner))
    assert found.links[0].collisions[0].geometry == taken


@pytest.mark.parametrize(
    "inner",
    ["<box size='0 1 1'/>", "<sphere radius='0'/>", "<cylinder radius='1' length='0'/>"],
)
def test_lengths_of_zero_in_a_urdf(inner):
    text = f"<link name='l'>{INERTIAL}<collision><geometry>{inner}</geometry></collision></link>"
    found, said = one_warning(formats.load_model_string, robot(text))
    assert len(found.links[0].collisions) == 1
    assert "0.0001 was taken" in said


@pytest.mark.parametrize("tag", ["collision", "visual", "sensor", "light"])
def test_parts_of_one_name_in_a_link_are_all_there(tag):
    kind = {"sensor": " type='imu'", "light": " type='point'"}.get(tag, "")
    parts = f"<{tag} name='c'{kind}/>" * 3 + f"<{tag} name='c_1'{kind}/>"
    found, text = one_warning(model, f"<link name='l'>{parts}</link>")
    names = [part.name for part in getattr(found.links[0], f"{tag}s")]
    assert names == ["c", "c_2", "c_3", "c_1"]
    assert "and 1 more like this" in text


def test_links_of_one_name_are_all_there_and_joints_mean_the_first():
    found, _ = one_warning(
        model,
        "<link name='a'/><link name='b'/><link name='b'><pose>1 0 0 0 0 0</pose></link>"
        "<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>",
    )
    assert [each.name for each in found.links] == ["a", "b", "b_1"]
    assert joint(found, "j").child == "b"
    assert link(found, "b_1").pose.x == 1


def test_of_joints_of_one_name_the_first_stays():
    one = "<joint name='j' type='{}'><parent>a</parent><child>b</child></joint>"
    found, _ = one_warning(model, TWO + one.format("fixed") + one.format("ball"))
    assert [each.type for each in found.joints] == ["fixed"]


def test_of_models_of_one_name_in_a_world_the_first_stays():
    one = "<model name='m'><pose>{} 0 0 0 0 0</pose><link name='l'/></model>"
    found, text = one_warning(world, one.format(1) + "\n" + one.format(2))
    assert [each.pose.x for each in found.models] == [1]
    assert text.startswith("test.sdf:5:")


def test_nested_models_of_one_name_are_all_there():
    one = "<model name='n'><link name='l'/></model>"
    found, _ = one_warning(model, LINK + one + one)
    assert [each.name for each in found.models] == ["n", "n_1"]


@pytest.mark.parametrize("tag", ["parent", "child"])
def test_a_joint_to_a_link_that_is_not_there_is_left_out(tag):
    ends = {"parent": "a", "child": "b"} | {tag: "zz"}
    found, text = one_warning(
        model,
        f"{TWO}<joint name='k' type='ball'><parent>a</parent><child>b</child></joint>\n"
        f"<joint name='j' type='fixed'><parent>{ends['parent']}</parent>"
        f"<child>{ends['child']}</child></joint>",
    )
    assert [each.name for each in found.joints] == ["k"]
    assert text.startswith(f"test.sdf:5: <sdf/model[@name='m']/joint[@name='j']/{tag}>")


@pytest.mark.parametrize(
    "body",
    [
        "<joint name='j' type='hinge'><parent>a</parent><child>b</child></joint>",
        "<joint name='j' type='ball'><parent>a</parent><child>a</child></joint>",
    ],
)
def test_a_joint_that_cannot_be_made_is_left_out(body):
    found, _ = one_warning(model, TWO + body)
    assert found.joints == ()
    assert len(found.links) == 2


def test_a_joint_of_a_gazebo_element_to_a_link_that_is_not_there_is_left_out():
    found, text = one_warning(
        formats.load_model_string,
        robot(
            f"<link name='l'>{INERTIAL}</link>\n<gazebo><joint name='j' type='fixed'>"
            "<parent>l</parent><child>robot::gone</child></joint></gazebo>"
        ),
    )
    assert found.joints == ()
    assert "'robot::gone' is not a link" in text


def test_a_link_that_is_called_after_its_model():
    found = model(
        "<link name='m::a'><pose>1 0 0 0 0 0</pose></link><link name='b'/>"
        "<joint name='j' type='fixed'><parent>m::a</parent><child>b</child></joint>",
        "1.6",
    )
    assert [each.name for each in found.links] == ["m::a", "b"]
    assert found.links[0].pose.x == 1
    assert joint(found, "j").parent == "m::a"


def test_a_frame_that_is_not_there_is_that_of_the_model():
    found, text = one_warning(
        model,
        "<link name='base'/><link name='x'>\n<pose relative_to='bse'>1 0 0 0 0 0</pose></link>",
    )
    assert link(found, "x").pose.position == (1, 0, 0)
    assert "did you mean 'base'?" in text


def test_an_axis_of_no_length_is_x():
    found, _ = one_warning(model, axis("<xyz>0 0 0</xyz>"))
    assert joint(found, "j").axes[0].xyz == (1, 0, 0)


def test_crossed_limits_are_none_in_sdf_and_swapped_in_urdf():
    limits = "<xyz>0 0 1</xyz><limit><lower>1</lower><upper>-1</upper></limit>"
    found, _ = one_warning(model, axis(limits))
    limited = joint(found, "j").axes[0]
    assert (limited.lower, limited.upper) == (-math.inf, math.inf)
    text = robot(
        f"<link name='a'>{INERTIAL}</link><link name='b'>{INERTIAL}</link>"
        "<joint name='j' type='revolute'><parent link='a'/><child link='b'/>"
        "<limit lower='1' upper='-1' effort='1' velocity='1'/></joint>"
    )
    found, _ = one_warning(formats.load_model_string, text)
    limited = joint(found, "j").axes[0]
    assert (limited.lower, limited.upper) == (-1, 1)


@pytest.mark.parametrize("reduction", ["reduction", "${gear}", "1:50"])
def test_a_reduction_of_text(reduction):
    text = robot(
        f"<link name='l'>{INERTIAL}</link><transmission name='t'><type>x</type>"
        "<joint name='j'/><actuator name='a'>"
        f"<mechanicalReduction>{reduction}</mechanicalReduction></actuator></transmission>"
    )
    found, _ = one_warning(formats.load_model_string, text)
    assert found.transmissions[0].actuators == (("a", 1.0),)


def test_a_model_without_links_and_an_include_without_a_uri():
    found, text = one_warning(world, "<model name='m'/>")
    assert (found.models[0].name, found.models[0].links) == ("m", ())
    assert "has no link" in text
    found, text = one_warning(world, "<include><name>x</name></include>")
    assert found.models == ()
    assert "needs a <uri>" in text


def test_xacro_in_an_sdf_file_is_expanded(tmp_path):
    file = tmp_path / "model.sdf"
    file.write_text(
        "<sdf version='1.6' xmlns:xacro='http://ros.org/wiki/xacro'>"
        "<xacro:property name='x' value='2'/><xacro:macro name='part' params='n'>"
        "<link name='l${n}'><pose>${x * n} 0 0 0 0 0</pose></link></xacro:macro>"
        "<model name='m'><xacro:part n='1'/><xacro:part n='2'/></model></sdf>"
    )
    found = formats.load_model(file)
    assert {each.name: each.pose.x for each in found.links} == {"l1": 2, "l2": 4}


INERTIA = (
    "<inertial><mass>{}</mass><inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz></inertia></inertial>"
)


def physical(inertial):
    """Return whether some distribution of mass has this inertial."""
    moments = np.linalg.eigvalsh(inertial.inertia.matrix())
    return (
        inertial.mass > 0 and moments[0] > 0 and moments[0] + moments[1] >= moments[2] * (1 - 1e-9)
    )


@pytest.mark.parametrize(
    ("moments", "expected"),
    [
        # the fingers of the Fetch: second moments of -1, 1 and 1 g m²
        ((0.002, 0.0, 0.0), (0.002, 0.001, 0.001)),
        ((0.0, 1.0, 1.0), (0.0, 1.0, 1.0)),
        ((1.0, 1.0, -1.0), (1.5, 1.5, 0.0)),
    ],
)
def test_an_inertia_that_no_body_has_becomes_one_that_a_body_has(moments, expected):
    body = INERTIA.format(0.1, *moments)
    found, text = one_warning(model, f"<link name='l'>\n{body}</link>")
    inertial = found.links[0].inertial
    assert physical(inertial)
    diagonal = (inertial.inertia.ixx, inertial.inertia.iyy, inertial.inertia.izz)
    ball = 0.4 * 0.1 * (3 * 0.1 / (4 * math.pi * 1000)) ** (2 / 3)
    assert diagonal == pytest.approx(expected, abs=1.01 * ball)
    assert text.startswith("test.sdf:5:")
    assert "was taken" in text


@given(
    st.floats(1e-6, 1e4),
    st.lists(st.floats(-1e3, 1e3), min_size=6, max_size=6),
)
@settings(max_examples=150, deadline=None)
def test_every_inertia_that_is_taken_can_be_that_of_a_body(mass, numbers):
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    inner = "".join(
        f"<{name}>{number!r}</{name}>" for name, number in zip(names, numbers, strict=True)
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = (
            model(
                f"<link name='l'><inertial><mass>{mass!r}</mass><inertia>{inner}</inertia></inertial>"
                "</link>"
            )
            .links[0]
            .inertial
        )
    given_inertia = found.inertia.matrix()
    if any("was taken" in str(each.message) for each in caught):
        moments = np.linalg.eigvalsh(given_inertia)
        assert moments[0] > 0
        assert moments[0] + moments[1] >= moments[2] * (1 - 1e-9)
    else:
        assert [getattr(found.inertia, name) for name in names] == numbers
        low, middle, high = np.linalg.eigvalsh(given_inertia)
        assert bool(caught) == (low + middle < high * (1 - 1e-3))


@pytest.mark.parametrize("moments", [(0.001, 0.001, 1.0), (0.1, 0.2, 0.31), (5.0, 1.0, 1.0)])
def test_an_inertia_that_breaks_the_triangle_inequality_is_told_and_stays(moments, tmp_path):
    body = INERTIA.format(1, *moments)
    found, text = one_warning(model, f"<link name='l'>\n{body}</link>")
    inertia = found.links[0].inertial.inertia
    assert (inertia.ixx, inertia.iyy, inertia.izz) == moments
    assert text.startswith("test.sdf:5:")
    assert "as in Gazebo" in text
    file = tmp_path / "test.sdf"
    file.write_text(sdf(f"<model name='m'><link name='l'>{body}</link></model>"))
    rules = [problem.rule for problem in formats.check(file)]
    assert rules.count("inertia-triangle") == 1


def test_an_inertia_of_zero_is_that_of_the_shapes():
    box = "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>"
    found, _ = one_warning(model, f"<link name='l'>{INERTIA.format(12, 0, 0, 0)}{box}</link>")
    inertia = found.links[0].inertial.inertia
    assert (inertia.ixx, inertia.iyy, inertia.izz) == pytest.approx((13, 10, 5))


@pytest.mark.parametrize("mass", [0, -1, "-inf"])
def test_a_mass_that_is_not_positive_is_a_gram(mass):
    found, _ = one_warning(model, f"<link name='l'>{INERTIA.format(mass, 1, 1, 1)}</link>")
    assert found.links[0].inertial.mass == 1e-3


def test_a_urdf_with_an_inertia_of_no_body_is_read():
    text = robot(
        f"<link name='base'>{INERTIAL}</link><link name='finger'><inertial><mass value='0.08'/>"
        "<inertia ixx='0.002' iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        "<joint name='j' type='prismatic'><parent link='base'/><child link='finger'/>"
        "<limit lower='0' upper='0.05' effort='60' velocity='0.05'/></joint>"
    )
    found, said = one_warning(formats.load_model_string, text)
    assert physical(link(found, "finger").inertial)
    assert "was taken" in said


def test_a_check_counts_each_fault_as_an_error(tmp_path):
    file = tmp_path / "odd.sdf"
    file.write_text(sdf(f"<model name='m'>\n<link name='l'><pose>1</pose></link>\n{LINK}</model>"))
    problems = [each for each in formats.check(file) if each.rule == "tolerated"]
    assert {(each.severity, each.line) for each in problems} == {("error", 4), ("error", 5)}
    with pytest.warns(FormatWarning):
        assert len(formats.load_model(file).links) == 2


def test_many_faults_of_a_kind_are_one_warning():
    links = "\n".join(f"<link name='l{n}'><pose>{n} 0 0</pose></link>" for n in range(170))
    found, text = one_warning(model, links)
    assert len(found.links) == 170
    assert "and 169 more like this (lines 5, 6, 7," in text
    assert len(text) < 500


LIBSDFORMAT_TAKES = [
    shape("<cylinder><radius>1</radius><length>0</length></cylinder>"),
    shape("<sphere><radius>-1</radius></sphere>"),
    shape("<plane><size>1 2 3</size></plane>"),
    "<link name='m::a'/>",
    "<link name='l'><pose>1, 2, 3, 0, 0, 0</pose></link>",
    f"{LINK}<joint name='j' type='fixed'><parent>l</parent><child>zz</child></joint>",
    f"{TWO}<joint name='j' type='hinge'><parent>a</parent><child>b</child></joint>",
    LINK + LINK,
    "<link name='l'><pose relative_to='gone'>1 0 0 0 0 0</pose></link>",
    axis("<xyz>0 0 0</xyz>"),
    f"<link name='l'>{INERTIA.format(0, 0, 0, 0)}</link>",
    f"<link name='l'>{INERTIA.format('1.5kg', 1, 1, 1)}</link>",
    "<link name='__x__'/>",
    "",
]


@pytest.mark.parametrize("body", LIBSDFORMAT_TAKES)
def test_what_libsdformat_prints_is_read(body, tmp_path):
    file = tmp_path / "model.sdf"
    file.write_text(sdf(f"<model name='m'>{body}</model>", "1.6"))
    assert libsdformat.ign_sdf("-p", file).returncode == 0
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")
        assert formats.load_model(file).name == "m"


RANGE = "<sensor name='s' type='ray'><pose>0 0 1</pose><ray><range><min>{}</min><max>{}</max></range></ray></sensor>"
NOISE = (
    "<sensor name='s' type='imu'><imu><angular_velocity><x><noise type='{}'><mean>1</mean></noise>"
    "</x></angular_velocity></imu></sensor>"
)


@pytest.mark.parametrize(
    ("limits", "taken"), [((3, 1), (1, 3)), ((-1, 5), (0, 5)), ((-3, -5), (0, 0))]
)
def test_the_range_of_a_lidar_grows_from_zero(limits, taken):
    text = RANGE.format(*limits).replace("<pose>0 0 1</pose>", "")
    found, said = one_warning(model, f"<link name='l'>{text}</link>")
    lidar = found.links[0].sensors[0].lidar
    assert (lidar.range_min, lidar.range_max) == taken
    assert "the range must grow" in said


def test_an_unknown_noise_is_none():
    found, said = one_warning(model, f"<link name='l'>{NOISE.format('gausian')}</link>")
    assert found.links[0].sensors[0].imu.angular_velocity[0].type == "none"
    assert "unknown noise 'gausian'" in said


def test_sensors_in_gazebo_elements_are_mended_too():
    text = robot(
        f"<link name='l'>{INERTIAL}</link><gazebo reference='l'>{RANGE.format(3, 1)}</gazebo>"
    )
    with pytest.warns(FormatWarning) as caught:
        found = formats.load_model_string(text)
    assert len(caught) == 2
    sensor = found.links[0].sensors[0]
    assert sensor.pose.position == (0, 0, 1)
    assert (sensor.lidar.range_min, sensor.lidar.range_max) == (1, 3)


MOMENTS = "<inertia ixx='1' iyy='2' izz='2.5' ixy='.1' ixz='.2' iyz='.3'/>"


@pytest.mark.parametrize(
    ("inertial", "moments", "said"),
    [
        ("<mass value='2'/>", None, "needs <inertia>: zero was taken"),
        (
            "<mass value='2'/><inertia ixx='1' iyy='2' izz='2.5'/>",
            (1, 2, 2.5, 0, 0, 0),
            "0 was taken for ixy, ixz, iyz",
        ),
        (
            f"<mass value='2'/>{MOMENTS.replace('.2', 'x', 1)}",
            (1, 2, 2.5, 0.1, 0, 0.3),
            "found 'x': 0 was taken for ixz",
        ),
    ],
)
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_moments_that_a_urdf_lacks_are_zero(inertial, moments, said):
    """libsdformat goes on with zeros; moments that are there are kept."""
    text = robot(f"<link name='a'>\n<inertial>{inertial}</inertial></link>")
    with pytest.warns(FormatWarning, match=said):
        found = formats.load_model_string(text, name="robot.urdf").links[0].inertial
    assert found.mass == 2.0
    assert physical(found)
    if moments is not None:
        inertia = found.inertia
        kept = (inertia.ixx, inertia.iyy, inertia.izz, inertia.ixy, inertia.ixz, inertia.iyz)
        assert kept == moments


@pytest.mark.parametrize("mass", ["", "<mass/>", "<mass value='heavy'/>"])
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_a_link_of_a_urdf_without_a_readable_mass_has_none(tmp_path, mass):
    """So libsdformat leaves it out with all that hangs on it."""
    file = tmp_path / "robot.urdf"
    file.write_text(
        robot(
            f"<link name='base'>{INERTIAL}</link>\n<link name='a'>"
            f"<inertial>{mass}{MOMENTS}</inertial></link>"
            "<joint name='j' type='continuous'><parent link='base'/><child link='a'/></joint>"
        )
    )
    with pytest.warns(FormatWarning, match="the link has no mass"):
        found = formats.load_model(file)
    assert [each.name for each in found.links] == ["base"]
    errors = [each for each in formats.check(file) if each.rule == "tolerated"]
    assert [each.line for each in errors] == [3]
