"""Arms that tests plan for: files of ``tests/data`` and one with a bit of everything."""

from functools import cache
from pathlib import Path

from gazelle.formats import load_model, load_model_string, load_srdf, load_srdf_string
from gazelle.kinematics import RobotModel

DATA = Path(__file__).parent / "data"
ARMS = ("fetch", "panda", "iiwa", "ur5")

ODD = """<robot name="odd">
  <link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"
    ixy="0" ixz="0" iyz="0"/></inertial></link>
  {links}
  <joint name="slide" type="prismatic"><parent link="base"/><child link="a"/>
    <origin xyz="0.1 -0.2 0.3" rpy="0.3 -0.4 0.5"/><axis xyz="1 2 -1"/>
    <limit lower="-0.5" upper="0.4" velocity="0.7" effort="1"/></joint>
  <joint name="turn" type="continuous"><parent link="a"/><child link="b"/>
    <origin xyz="0 0.2 0.1" rpy="-1 0.2 2"/><axis xyz="0.2 -0.3 1"/></joint>
  <joint name="follow" type="revolute"><parent link="b"/><child link="c"/>
    <origin xyz="0.2 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-9" upper="9" velocity="1" effort="1"/>
    <mimic joint="turn" multiplier="-0.5" offset="0.25"/></joint>
  <joint name="wrist" type="revolute"><parent link="c"/><child link="d"/>
    <origin xyz="0.15 0 0.05" rpy="0 1 0"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="1" velocity="1" effort="1"/>
    <safety_controller k_velocity="1" soft_lower_limit="-1.5" soft_upper_limit="0.9"/></joint>
  <joint name="other" type="revolute"><parent link="a"/><child link="e"/>
    <origin xyz="-0.2 0 0.1"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="flange" type="fixed"><parent link="d"/><child link="tool"/>
    <origin xyz="0.05 0.02 0.1" rpy="0.1 0.2 0.3"/></joint>
</robot>""".format(
    links="".join(
        f'<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" '
        f'ixy="0" ixz="0" iyz="0"/></inertial></link>'
        for name in "abcde"
    )
    + '<link name="tool"/>'
)


@cache
def arm(name):
    """Return a robot of ``tests/data``."""
    srdf = DATA / f"{name}_arm.srdf"
    semantics = load_srdf(srdf) if srdf.exists() else None
    return RobotModel(load_model(DATA / f"{name}_arm.urdf"), semantics)


def arm_group(name):
    """Return the robot and the group of its arm."""
    robot = arm(name)
    if name == "fetch":
        return robot, robot.group("arm")
    return robot, robot.chain(f"{name}_link0", f"{name}_tool", "arm")


def odd(srdf=""):
    """Return a robot with a slide, a continuous joint, a mimic, a branch and soft limits."""
    semantics = load_srdf_string(f'<robot name="odd">{srdf}</robot>')
    return RobotModel(load_model_string(ODD), semantics)


NESTED = """<sdf version="1.9"><model name="nested"><pose>1 2 3 0.1 0.2 0.3</pose>
  <link name="base">{inertial}</link>
  <link name="upper"><pose>0.1 0.2 0.3 0.4 -0.5 0.6</pose>{inertial}</link>
  <link name="bar"><pose>-0.4 0.2 0.1 0 0 0</pose>{inertial}</link>
  <joint name="lift" type="prismatic"><parent>base</parent><child>upper</child>
    <pose>0.1 0 -0.2 0.3 0 0.2</pose><axis><xyz>0.6 0 0.8</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint>
  <joint name="swing" type="revolute"><parent>base</parent><child>bar</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="closing" type="revolute"><parent>upper</parent><child>bar</child>
    <axis><xyz>0 1 0</xyz></axis></joint>
  <model name="hand"><pose>0.5 0 0.2 0 0.7 0</pose>
    <link name="palm">{inertial}</link>
    <link name="finger"><pose>0.1 0 0.05 0 0 0</pose>{inertial}</link>
    <joint name="grip" type="revolute"><parent>palm</parent><child>finger</child>
      <pose>0 0.05 0 0 0 0.3</pose><axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis></joint>
    <frame name="tip" attached_to="finger"><pose>0.1 0 0 0 0.2 0</pose></frame>
  </model>
  <joint name="wrist" type="revolute"><parent>upper</parent><child>hand::palm</child>
    <pose>0.05 0.1 0 1 0 0</pose><axis><xyz>1 0 0</xyz></axis></joint>
</model></sdf>""".format(
    inertial="<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz>"
    "</inertia></inertial>"
)


def nested(srdf=""):
    """Return a robot of SDF whose hand is a model of its own, with a joint that closes a loop."""
    semantics = load_srdf_string(f'<robot name="nested">{srdf}</robot>')
    return RobotModel(load_model_string(NESTED), semantics)
