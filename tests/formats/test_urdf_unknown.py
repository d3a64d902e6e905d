"""Elements and attributes that URDF does not know are named, with what may have been meant."""

import warnings

import pytest
from xml_samples import INERTIAL, robot

from gazelle import formats
from gazelle.errors import FormatWarning

JOINT = (
    "<link name='a'>{inertial}</link>\n<link name='b'>{inertial}{link}</link>\n"
    "<joint name='j' type='revolute'><parent link='a'/><child link='b'/>\n{joint}</joint>\n{robot}"
)
LIMIT = "<limit lower='0' upper='1' effort='1' velocity='1'/>"


def text(link="", joint=LIMIT, rest=""):
    return robot(JOINT.format(inertial=INERTIAL, link=link, joint=joint, robot=rest))


@pytest.mark.parametrize(
    ("parts", "message", "hint"),
    [
        (
            {"link": "<colision><geometry><sphere radius='1'/></geometry></colision>"},
            "<colision> is not a URDF element of <link>",
            "did you mean 'collision'?",
        ),
        ({"joint": f"<axs xyz='0 0 1'/>{LIMIT}"}, "<axs> is not a URDF", "did you mean 'axis'?"),
        (
            {"joint": LIMIT.replace("upper", "uper")},
            "the attribute 'uper' is not defined for <limit>",
            "did you mean 'upper'?",
        ),
        (
            {
                "link": "<visual><geometry><sphere radius='1'/></geometry>"
                "<material name='gray'/></visual>",
                "rest": "<material name='grey'><color rgba='1 1 1 1'/></material>",
            },
            "there is no material 'gray'",
            "did you mean 'grey'?",
        ),
        (
            {"rest": "<material name='grey'><color rgba='128 128 128 1'/></material>"},
            "a colour has values from 0 to 1, found '128 128 128 1'",
            "divide them by 255",
        ),
        ({"rest": "<jont name='x'/>"}, "<jont> is not a URDF", "did you mean 'joint'?"),
        (
            {"joint": f"<origin xzy='0 0 1'/>{LIMIT}"},
            "the attribute 'xzy' is not defined for <origin>",
            "did you mean 'xyz'?",
        ),
        (
            {"joint": f"{LIMIT}<dynamics dampng='1'/>"},
            "the attribute 'dampng' is not defined for <dynamics>",
            "did you mean 'damping'?",
        ),
        (
            {
                "link": "<visual><geometry><box size='1 1 1'/></geometry>"
                "<materal name='x'/></visual>"
            },
            "<materal> is not a URDF element of <visual>",
            "did you mean 'material'?",
        ),
    ],
)
def test_a_misspelt_name_is_one_warning_with_a_suggestion(parts, message, hint, tmp_path):
    with pytest.warns(FormatWarning) as caught:
        formats.load_model_string(text(**parts), name="test.urdf")
    assert len(caught) == 1
    said = str(caught[0].message)
    assert said.startswith("test.urdf:")
    assert message in said
    assert hint in said
    file = tmp_path / "robot.urdf"
    file.write_text(text(**parts))
    assert any(message in each.message and each.line for each in formats.check(file))


def test_what_other_programs_put_there_is_no_warning():
    rest = (
        "<gazebo><anything/></gazebo><transmission name='t'><x/></transmission>"
        "<ros2_control name='c' type='system'><hardware/></ros2_control>"
        "<drake:thing/><mujoco><compiler/></mujoco>"
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", message=".*in a <gazebo> is not supported")
        formats.load_model_string(text(rest=rest))


def test_a_plugin_of_a_joint_is_the_models_without_a_word_and_one_of_nothing_is_left_out():
    plugins = "".join(
        f"<gazebo reference='{name}'><plugin name='{name}' filename='lib{name}.so'/></gazebo>"
        for name in ("j", "b")
    )
    model = formats.load_string(text(rest=plugins)).models[0]
    assert [plugin.name for plugin in model.plugins] == ["j", "b"]
    nowhere = plugins.replace("reference='j'", "reference='jj'")
    with pytest.warns(FormatWarning, match="'jj', which is not a link or joint, and was ignored"):
        model = formats.load_string(text(rest=nowhere)).models[0]
    assert [plugin.name for plugin in model.plugins] == ["b"]
