"""rosmsg, rosmaster, rosclean, and modules made by .cfg files."""

import importlib
import subprocess
import sys

import pytest
from ros import real

import gazelle_ros as ros
from gazelle_ros.base.errors import FormatError
from gazelle_ros.cli.main import main
from gazelle_ros.messages import search

CFG = """
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
size = gen.enum([gen.const("Small", int_t, 0, "small"), gen.const("Large", int_t, 2, "large")], "s")
gen.add("size", int_t, 1, "how big", 1, 0, 3, edit_method=size)
gen.add("free", double_t, 2, "any number")
gen.add("on", bool_t, 4, "on or off", True)
deep = gen.add_group("More of it", type="collapse", state=False)
deep.add("gain", double_t, 8, "gain", 1, 0, 2)
deep.add_group("Most").add("word", str_t, 0, "a word", "hello")
exit(gen.generate("demo", "demo_node", "Demo"))
"""


@pytest.fixture(autouse=True)
def installed():
    with ros.install():
        yield


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Yield a package on ROS_PACKAGE_PATH."""
    folder = tmp_path / "demo"
    (folder / "cfg").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>demo</name></package>")
    (folder / "cfg" / "Demo.cfg").write_text(CFG)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    search.forget()
    yield folder
    for name in [name for name in sys.modules if name.partition(".")[0] == "demo"]:
        del sys.modules[name]
    search.forget()


def test_a_cfg_file_is_a_module(package):
    module = importlib.import_module("demo.cfg.DemoConfig")
    assert module.defaults == {"size": 1, "free": 0.0, "on": True, "gain": 1.0, "word": "hello"}
    assert (module.min["free"], module.max["gain"], module.min["on"]) == (-float("inf"), 2.0, False)
    assert (module.Demo_Small, module.Demo_Large) == (0, 2)
    assert module.all_level == 15
    (more,) = module.config_description["groups"]
    assert (more["name"], more["state"], more["id"], more["parent"]) == ("More_of_it", False, 1, 0)
    assert more["groups"][0]["class"] == "DEFAULT::MORE_OF_IT::MOST"
    assert importlib.import_module("demo.cfg").DemoConfig is module


@pytest.mark.ros
@real.needs_ros
def test_a_cfg_file_says_what_it_says_to_the_real_generator(package):
    script = (
        "import sys, json; sys.argv = ['x', '', '', '', '']\n"
        "import dynamic_reconfigure.parameter_generator_catkin as p\n"
        "p.ParameterGenerator.generate = lambda self, *a: print(json.dumps(self.group.to_dict()))\n"
        f"file = {str(package / 'cfg' / 'Demo.cfg')!r}\n"
        "exec(compile(open(file).read(), file, 'exec'))"
    )
    done = subprocess.run([real.PYTHON, "-c", script], capture_output=True, text=True, check=True)
    import json

    module = importlib.import_module("demo.cfg.DemoConfig")
    # Where lines are and how C++ writes its limits does not matter to a server.
    left_out = {"srcline", "srcfile", "edit_method", "min", "max", "lower"}

    def kept(value):
        if isinstance(value, dict):
            return {key: kept(each) for key, each in value.items() if key not in left_out}
        return [kept(each) for each in value] if isinstance(value, list) else value

    assert kept(module.config_description) == kept(json.loads(done.stdout))


def test_a_server_takes_the_module_of_a_cfg_file(package, node):
    module = importlib.import_module("demo.cfg.DemoConfig")
    server = importlib.import_module("dynamic_reconfigure.server")
    client = importlib.import_module("dynamic_reconfigure.client")
    made = server.Server(module, lambda config, level: config)
    assert client.Client("probe", timeout=60).update_configuration({"gain": 5.0})["gain"] == 2.0
    assert made.config["groups"]["groups"]["More_of_it"]["state"] is False


def test_a_cfg_file_that_fails_is_named_with_its_line(package):
    (package / "cfg" / "Demo.cfg").write_text(
        "from dynamic_reconfigure.parameter_generator_catkin import *\n"
        'ParameterGenerator().add("x", int_t, 0, "x", "no number")\n'
    )
    with pytest.raises(FormatError, match="has type int") as error:
        importlib.import_module("demo.cfg.DemoConfig")
    assert error.value.line == 2


def test_a_missing_cfg_file_is_a_missing_module(package):
    with pytest.raises(ModuleNotFoundError, match="DemoConfig"):
        importlib.import_module("demo.cfg.OtherConfig")
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("std_msgs.cfg")


def test_definitions_are_shown_with_those_of_their_fields():
    rosmsg = importlib.import_module("rosmsg")
    text = rosmsg.get_msg_text("geometry_msgs/PointStamped")
    assert text.splitlines()[:5] == [
        "std_msgs/Header header",
        "  uint32 seq",
        "  time stamp",
        "  string frame_id",
        "geometry_msgs/Point point",
    ]
    assert (
        rosmsg.get_srv_text("std_srvs/SetBool") == "bool data\n---\nbool success\nstring message\n"
    )
    assert rosmsg.rosmsg_md5(".srv", "std_srvs/SetBool") == "09fb03525b03e7ea1fd3992bafd87e16"
    assert "std_msgs/Header" in list(rosmsg.rosmsg_search(None, ".msg", "Header"))
    assert "std_srvs/Empty" in rosmsg.list_srvs("std_srvs")
    with pytest.raises(rosmsg.ROSMsgException):
        rosmsg.get_msg_text("std_msgs/Nope")


@pytest.mark.long
@pytest.mark.ros
@real.needs_ros
@pytest.mark.parametrize(
    "words",
    [
        ["show", "std_msgs/Header"],
        ["show", "Header"],
        ["show", "geometry_msgs/PoseStamped"],
        ["show", "sensor_msgs/PointField"],
        ["md5", "std_msgs/Header"],
        ["md5", "Header"],
        ["package", "std_msgs"],
        ["package", "-s", "std_msgs"],
    ],
)
def test_messages_are_shown_as_rosmsg_does(words, capsys):
    assert main(["msg", *words]) == 0
    assert capsys.readouterr().out == real.tool("http://127.0.0.1:1", "rosmsg", *words)


def test_an_unknown_type_is_one_line(capsys):
    assert main(["srv", "show", "Nope"]) == 1
    assert capsys.readouterr().err == "gazelle-ros: error: Could not find srv 'Nope'\n"


def test_a_master_is_started_and_stopped_as_an_object():
    rosmaster = importlib.import_module("rosmaster")
    master = rosmaster.Master(port=0)
    assert not master.ok()
    master.start()
    try:
        assert master.ok()
        with ros.Node("n", master_uri=master.uri) as node:
            node.set_param("/x", 1)
            assert node.get_param("/x") == 1
            assert not node.has_param("/run_id")
    finally:
        master.stop()
    assert not master.ok()


def test_room_of_logs_is_measured(tmp_path):
    rosclean = importlib.import_module("rosclean")
    (tmp_path / "x").write_bytes(bytes(1536))
    assert rosclean.get_disk_usage(str(tmp_path)) == 1536
    assert rosclean.get_human_readable_disk_usage(str(tmp_path)) == "1.5K"
    with pytest.raises(rosclean.CleanupException):
        rosclean.get_disk_usage(str(tmp_path / "none"))


def test_results_of_tests_have_their_files(tmp_path):
    rosunit = importlib.import_module("rosunit")
    env = {"ROS_TEST_RESULTS_DIR": str(tmp_path)}
    assert rosunit.xml_results_file("p", "a b/c", env=env) == f"{tmp_path}/p/rosunit-a_b_c.xml"
    assert (tmp_path / "p").is_dir()
    assert rosunit.rostest_name_from_path("/ws/p", "/ws/p/test/x.y.test") == "test_x.y"


@pytest.mark.long
def test_tools_have_their_main_functions(capsys, monkeypatch, master):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    monkeypatch.setattr(sys, "argv", ["rosmsg", "md5", "std_msgs/Header"])
    importlib.import_module("rosmsg").rosmsgmain()
    assert capsys.readouterr().out == "2176decaecbce78abc3b96ef049fabed\n"
    with pytest.raises(SystemExit):
        importlib.import_module("rosbag").rosbagmain(["rosbag", "info", "/nowhere.bag"])
    monkeypatch.setattr(sys, "argv", ["rostest", "/nowhere.test"])
    with pytest.raises(SystemExit):
        importlib.import_module("rostest").rostestmain()
    with pytest.raises(SystemExit):
        importlib.import_module("roslaunch").main(["roslaunch", "/nowhere.launch"])
