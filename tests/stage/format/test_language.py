"""Stage's language: tokens, properties, bodies, macros, includes."""

import math

import pytest
from stage_samples import read, write

from gazelle import FormatError, ResolveError
from gazelle.errors import FormatWarning
from gazelle.stage.format import load_stage
from gazelle.stage.format.lexer import Script, TokenKind, tokenize


def kinds(text):
    return [TokenKind(token.kind).name for token in tokenize(Script("t", text))][:-1]


def refused(folder, text):
    with pytest.raises(FormatError) as caught:
        read(folder, text)
    return caught.value


def test_words_numbers_strings_tuples_and_parentheses_are_tokens():
    assert kinds('point[0] -.5 "a b" [1 2] ( )') == [
        "WORD",
        "NUMBER",
        "STRING",
        "TUPLE",
        "OPEN",
        "CLOSE",
    ]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_may_end_as_on_any_system(tmp_path, end):
    text = f"# a comment{end}resolution 0.5{end}model ( name {end} ) "
    error = refused(tmp_path, text)
    assert error.line == 4
    assert "')'" in error.message


def test_comments_reach_to_the_end_of_the_line(tmp_path):
    world = read(tmp_path, 'name "one" # name "two"\n#model ( )\n')
    assert (world.name, world.models) == ("one", ())


def test_parts_need_no_white_space_between_them(tmp_path):
    (model,) = read(tmp_path, 'model(name"a"pose[1 2 3 90]size[1 1 1])').models
    assert model.name == "a"
    assert model.pose == pytest.approx((1.0, 2.0, 3.0, math.pi / 2))


def test_numbers_may_have_a_sign_a_point_and_an_exponent(tmp_path):
    (model,) = read(tmp_path, "model ( pose [ -1. +.5 1e-3 2.5E2 ] )").models
    assert model.pose == pytest.approx((-1.0, 0.5, 0.001, math.radians(250.0)))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("resolution 1.2.3", "'1.2.3' is not a number"),
        ('name "open', "a string must end"),
        ("model ( pose [ 1 2\n3 4 ] )", "a tuple must end with ']'"),
        ("model ( pose [ 1 # 2 ] )", "a tuple must end with ']'"),
        ("model ( pose [ a b c d ] )", "a tuple may hold numbers and strings"),
        ("model ( } )", "'}' has no meaning"),
        ("model (", "the ')' that ends this is missing"),
        (") model", "expected a word, found ')'"),
        ("model ( [1 2 3] )", "expected a word or ')', found '[1 2 3]'"),
        ("model", "the file ends too early: expected a value or '(' after 'model'"),
        ("resolution paused", "expected a value or '(' after 'resolution', found 'paused'"),
        ("define", "the file ends too early: expected a name in 'define NAME TYPE ( ... )'"),
        ("define a", "the file ends too early: expected a type in 'define NAME TYPE ( ... )'"),
        ("include", "the file ends too early: expected a file in quotes"),
        ("define a ( )", "expected a type in 'define NAME TYPE ( ... )'"),
        ("define a model size", "expected '(' in 'define NAME TYPE ( ... )'"),
        ("model ( define a model ( ) )", "'define' is only allowed outside"),
        ('model ( include "a.inc" )', "'include' is only allowed outside"),
        ("include here", "expected a file in quotes"),
        ("resolution [1 2]", "expected a number in 'resolution', found [1 2]"),
        ("name 3", "'name' must be a string in quotes, found 3"),
        ("model ( pose 3 )", "'pose' must be a tuple in brackets, found 3"),
        ("model ( size [1 2] )", "'size' must have 3 numbers, found [1 2]"),
        ('model ( size [1 "2" 3] )', "expected a number in 'size'"),
        ("resolution 1e300", "'resolution' is out of range"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path, text, said):
    error = refused(tmp_path, "\n\n" + text)
    assert error.message.startswith(said), error.message
    assert error.file == str(tmp_path / "test.world")
    assert error.line >= 3


def test_a_tuple_may_be_longer_than_needed(tmp_path):
    (model,) = read(tmp_path, "model ( size [1 2 3 4 5] )").models
    assert model.size == (1.0, 2.0, 3.0)


def test_the_last_of_two_properties_wins(tmp_path):
    (model,) = read(tmp_path, 'model ( name "a" name "b" )').models
    assert model.name == "b"


def test_lengths_and_angles_are_in_the_units_of_the_file(tmp_path):
    text = """
    model ( pose [ 100 200 0 1 ] )
    unit_length "cm" unit_angle "radians"
    camera ( fov [ 90 45 ] )
    """
    model, camera = read(tmp_path, text).models
    assert model.pose == pytest.approx((1.0, 2.0, 0.0, 1.0))
    assert camera.device.fov == pytest.approx((math.pi / 2, math.pi / 4))


def test_an_unknown_unit_is_an_error_that_names_the_known(tmp_path):
    assert "there are: cm, m, mm" in str(refused(tmp_path, 'unit_length "inch"'))


def test_a_macro_gives_what_an_instance_does_not(tmp_path):
    text = """
    define base position ( size [1 1 1] drive "omni" ranger ( ) )
    define robot base ( size [2 2 2] mass 3 )
    robot ( name "a" )
    robot ( name "b" mass 4 fiducial ( ) )
    """
    first, second = read(tmp_path, text).models
    assert [first.size, second.size] == [(2.0, 2.0, 2.0)] * 2
    assert [first.mass, second.mass] == [3.0, 4.0]
    assert [first.device.drive, second.device.drive] == ["omni", "omni"]
    assert [child.type for child in first.children] == ["ranger"]
    assert [child.type for child in second.children] == ["ranger", "fiducial"]


def test_instances_share_what_they_do_not_change(tmp_path):
    text = 'define r position ( pose [1 2 0 0] ranger ( ) ) r ( ) r ( name "b" pose [3 4 0 0] )'
    first, second = read(tmp_path, text).models
    assert first.children is second.children
    assert (first.name, second.name) == ("position:0", "b")
    assert (first.pose[:2], second.pose[:2]) == ((1.0, 2.0), (3.0, 4.0))


def test_macros_of_sensors_and_blocks_are_no_models(tmp_path):
    text = """
    define sonar sensor ( range [0 3] )
    define corner block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1] )
    position ( corner ( z [0 2] ) ranger ( sonar ( pose [1 0 0 90] ) sonar ( ) ) )
    """
    (robot,) = read(tmp_path, text).models
    (ranger,) = robot.rangers
    assert [sensor.range for sensor in ranger.device.sensors] == [(0.0, 3.0)] * 2
    assert len(robot.blocks[0].points) == 3


def test_a_model_macro_may_be_called_block(tmp_path):
    text = """
    define block model ( size [0.5 0.5 0.5] )
    block ( pose [1 0 0 0] )
    model ( block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 1] ) block ( ) )
    """
    obstacle, model = read(tmp_path, text).models
    assert (obstacle.type, obstacle.size.x) == ("model", 0.5)
    assert (len(model.blocks), len(model.children)) == (1, 1)


def test_a_second_definition_is_not_used_and_said(tmp_path):
    text = "define a model ( mass 1 )\ndefine a model ( mass 2 )\na ( )"
    with pytest.warns(FormatWarning, match=r"test.world:2:.*'a' is defined a second time") as said:
        (model,) = read(tmp_path, text).models
    assert model.mass == 1.0
    assert len(said) == 1


def test_macros_of_a_file_of_macros_are_judged_though_nobody_uses_them(tmp_path):
    text = "define a model ( sise [1 1 1] )\ndefine b model ( size [1 1] )\ndefine s sensor ( )"
    with pytest.warns(FormatWarning) as said:
        assert read(tmp_path, text).models == ()
    first, second = (str(each.message) for each in said)
    assert "test.world:1: <sise>: 'sise' is not a property of a model" in first
    assert "test.world:2: <size>: cannot create 'b': 'size' must have 3" in second


def test_a_macro_is_known_only_below_its_definition(tmp_path):
    error = refused(tmp_path, "robot ( )\ndefine robot position ( )")
    assert (error.line, error.element) == (1, "robot")


def test_includes_bring_macros_models_and_properties(tmp_path):
    write(tmp_path, 'include "deep.inc"\nresolution 0.3', "sub/robot.inc")
    write(tmp_path, "define robot position ( )\nrobot ( )", "sub/deep.inc")
    world = read(tmp_path, 'include "sub/robot.inc"\nrobot ( )')
    assert [model.name for model in world.models] == ["position:0", "position:1"]
    assert world.resolution == 0.3


def test_an_included_file_names_files_from_the_top_folder_first(tmp_path):
    write(tmp_path, 'include "deep.inc"', "sub/robot.inc")
    write(tmp_path, 'name "sub"', "sub/deep.inc")
    write(tmp_path, 'name "top"', "deep.inc")
    assert read(tmp_path, 'include "sub/robot.inc"').name == "top"


def test_a_missing_include_is_an_error(tmp_path):
    with pytest.raises(ResolveError) as caught:
        read(tmp_path, '# one\ninclude "gone.inc"')
    assert (caught.value.line, caught.value.element) == (2, "include")
    assert "STAGEPATH is not set" in caught.value.hint
    write(tmp_path, "", "sub/Gone.inc")
    for name, close in {"sub/gone.inc": "sub/Gone.inc", "sbu/Gone.inc": "sub"}.items():
        with pytest.raises(ResolveError) as caught:
            read(tmp_path, f'include "{name}"')
        assert caught.value.hint == f"did you mean '{close}'?"


def test_stagepath_holds_includes_by_their_last_name(tmp_path, monkeypatch):
    write(tmp_path, 'name "found"', "lib/a.inc")
    monkeypatch.setenv("STAGEPATH", f"/nowhere:{tmp_path / 'lib'}")
    write(tmp_path, 'include "any/a.inc"', "w/x/y/z/u/v.world")
    assert load_stage(tmp_path / "w/x/y/z/u/v.world").name == "found"


def test_a_file_that_includes_itself_is_refused(tmp_path):
    write(tmp_path, 'include "b.inc"', "a.inc")
    write(tmp_path, 'include "a.inc"', "b.inc")
    assert "includes itself" in refused(tmp_path, 'include "a.inc"').message


@pytest.mark.parametrize("name", ["../" * 30 + "etc/hostname", "/etc/hostname"])
def test_files_far_away_are_not_read(tmp_path, name):
    with pytest.raises(ResolveError):
        read(tmp_path, f'include "{name}"')


def test_text_that_is_no_utf8_is_read(tmp_path):
    file = tmp_path / "test.world"
    file.write_bytes(b'# Gon\xe7alo\nname "a"')
    assert load_stage(file).name == "a"


def test_entities_too_deep_are_refused(tmp_path):
    assert "deep" in refused(tmp_path, "model ( " * 100 + ") " * 100).message


def test_macros_of_macros_cannot_fill_the_machine(tmp_path):
    doubling = ["define m0 model ( )"]
    doubling += [f"define m{i} model ( m{i - 1} ( ) m{i - 1} ( ) )" for i in range(1, 40)]
    assert "entities" in refused(tmp_path, "\n".join([*doubling, "m39 ( )"])).message
    chain = ["define m0 model ( )"] + [f"define m{i} m{i - 1} ( )" for i in range(1, 200)]
    assert "macros" in refused(tmp_path, "\n".join(chain)).message


def test_there_must_be_such_a_file(tmp_path):
    with pytest.raises(ResolveError):
        load_stage(tmp_path / "gone.world")
