"""Legal files that are hard to read right, compared with libsdformat in test_resolved.py."""

from xml_samples import INERTIAL, robot, sdf, urdf_joint, urdf_link

BODY = "<collision name='c'><pose>.1 .2 .3 .4 .5 .6</pose><geometry><sphere><radius>1</radius></sphere></geometry></collision>"

CHAIN = (
    "<model name='m' canonical_link='b'><pose>1 2 3 .1 .2 .3</pose>"
    f"<link name='a'><pose relative_to='f2'>1 0 0 0 0 .5</pose>{BODY}</link>"
    "<link name='b'><pose relative_to='j'>0 1 0 .3 0 0</pose>"
    "<visual name='v'><pose relative_to='f1'>0 0 1 0 .2 0</pose><geometry><sphere><radius>1</radius>"
    "</sphere></geometry></visual>"
    "<sensor name='s' type='imu'><pose relative_to='a'>.1 .2 .3 0 0 1</pose></sensor></link>"
    "<link name='c'><pose>-1 -2 -3 -.1 -.2 -.3</pose></link>"
    "<joint name='j' type='revolute'><pose relative_to='f1'>0 0 .5 0 0 .7</pose>"
    "<parent>f1</parent><child>f3</child><axis><xyz expressed_in='f2'>1 2 2</xyz>"
    "<limit><lower>-1</lower><upper>2</upper><effort>-1</effort></limit></axis></joint>"
    "<frame name='f1' attached_to='c'><pose>0 0 1 .5 0 0</pose></frame>"
    "<frame name='f2' attached_to='f1'><pose relative_to='c'>1 1 1 0 0 .9</pose></frame>"
    "<frame name='f3' attached_to='a'><pose relative_to='__model__'>2 0 0 0 1 0</pose></frame>"
    "</model>"
)

NESTED = (
    "<world name='w'><frame name='wf'><pose>5 0 0 0 0 1</pose></frame>"
    "<frame name='wg' attached_to='outer::inner::tip'><pose>0 0 1 0 0 0</pose></frame>"
    "<model name='outer' placement_frame='inner::tip'>"
    "<pose relative_to='wf'>1 2 3 .1 .2 .3</pose>"
    "<model name='inner' placement_frame='if' canonical_link='tip'>"
    "<pose relative_to='of'>0 0 1 0 .4 0</pose>"
    "<link name='base'><pose>.5 0 0 0 0 .2</pose></link><link name='tip'><pose relative_to='base'>0 "
    ".5 0 .2 0 0</pose></link><frame name='if' attached_to='tip'><pose>.1 0 0 0 0 .3</pose></frame>"
    "<joint name='ij' type='prismatic'><parent>base</parent><child>tip</child>"
    "<axis><xyz expressed_in='__model__'>0 0 2</xyz></axis></joint></model>"
    "<link name='l'><pose relative_to='inner::if'>1 0 0 0 0 0</pose></link>"
    "<frame name='of' attached_to='l'><pose relative_to='__model__'>0 3 0 0 0 .6</pose></frame>"
    "<joint name='oj' type='revolute'><parent>l</parent><child>inner::base</child>"
    "<axis><xyz expressed_in='inner::if'>0 1 1</xyz></axis></joint>"
    "<joint name='ok' type='ball'><parent>world</parent><child>inner</child>"
    "<pose relative_to='oj'>1 0 0 0 0 0</pose></joint></model>"
    "<model name='second'><pose relative_to='outer::inner'>0 0 9 0 0 .1</pose><link name='x'/></model>"
    "<light name='lamp' type='point'><pose relative_to='wf'>1 1 1 0 0 0</pose></light></world>"
)

OLD_AXIS = (
    "<model name='m'><pose>1 0 0 0 0 .3</pose><link name='a'><pose>0 0 1 .3 .2 .1</pose></link>"
    "<link name='b'><pose>0 1 1 .5 .4 -.3</pose></link>"
    "<joint name='j' type='revolute2'><parent>a</parent><child>b</child>"
    "<pose>.1 .2 .3 .7 0 .2</pose><axis><xyz>1 2 3</xyz>{0}<dynamics><damping>.5</damping>"
    "<friction>.2</friction></dynamics></axis><axis2><xyz>0 0 1</xyz>{1}</axis2></joint>"
    "<joint name='k' type='revolute'><parent>world</parent><child>a</child><axis><xyz>0 1 1</xyz>"
    "</axis></joint></model>"
)
PARENT = "<use_parent_model_frame>{}</use_parent_model_frame>"

ANGLES = (
    "<model name='m'><pose degrees='true'>1 2 3 30 -45 170</pose>"
    "<link name='a'><pose rotation_format='quat_xyzw'>1 2 3 0.5 -0.5 0.5 0.5</pose>"
    "<inertial><pose degrees='1'>.1 0 0 0 90 0</pose><mass>2</mass><inertia><ixx>3</ixx><iyy>4</iyy>"
    "<izz>5</izz><ixy>.1</ixy><ixz>-.2</ixz><iyz>.3</iyz></inertia></inertial></link>"
    "<link name='b'><pose rotation_format='quat_xyzw' relative_to='a'>0 0 0 0.1 0.2 0.3 0.9"
    "</pose></link><link name='c'><pose relative_to='b'/></link></model>"
)

DEEP = (
    "<model name='m' canonical_link='n::p'><link name='l'/><model name='n'><link name='p'>"
    "<pose>1 0 0 0 0 1</pose></link><frame name='g' attached_to='p'><pose>0 0 1 .5 0 0</pose></frame>"
    "<model name='o'><pose relative_to='p'>0 0 1 0 0 0</pose><link name='q'/><frame name='f' "
    "attached_to='q'><pose>0 1 0 0 0 0</pose></frame></model></model><link name='z'>"
    "<pose relative_to='n::o::f'>1 2 3 0 0 0</pose></link><frame name='h'><pose>1 1 1 0 0 0</pose></frame>"
    "<joint name='j' type='revolute'><pose>0 1 0 0 0 0</pose><parent>l</parent><child>n::g</child><axis>"
    "<xyz expressed_in='l'>1 1 0</xyz></axis></joint></model>"
)
ON_JOINT = (
    "<model name='my model'><link name='a'/><link name='b link'><pose>0 0 1 0 0 1</pose></link>"
    "<joint name='j' type='fixed'><pose>1 0 0 0 0 0</pose><parent>a</parent><child>b link</child></joint>"
    "<frame name='f' attached_to='j'><pose>0 1 0 0 0 0</pose></frame><link name='c'>"
    "<pose relative_to='f'/></link></model>"
)
LIMITS = (
    "<model name='m'><pose frame=''>1 0 0 0 0 0</pose><link name='a'/><link name='b'/><link name='c'/>"
    "<joint name='s' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz><limit>"
    "<lower>-1e16</lower><upper>1e16</upper><effort>-1</effort><velocity>5</velocity></limit></axis>"
    "</joint><joint name='u' type='universal'><parent>b</parent><child>c</child><axis><xyz>0 0 -2</xyz>"
    "</axis><axis2><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>.5</upper></limit></axis2></joint></model>"
)
INCLUDED = (
    "<model name='arm' placement_frame='grip'><pose>9 9 9 0 0 1</pose>"
    "<link name='upper'><pose>1 0 0 0 0 .3</pose></link>"
    "<link name='lower'><pose relative_to='upper'>0 0 1 0 .2 0</pose></link>"
    "<frame name='grip' attached_to='lower'><pose>0 0 .5 0 0 .4</pose></frame>"
    "<joint name='elbow' type='revolute'><parent>upper</parent><child>lower</child>"
    "<axis><xyz expressed_in='__model__'>1 0 0</xyz></axis></joint>"
    "<model name='tool'><pose relative_to='grip'>0 0 3 0 0 0</pose><link name='tip'/></model>"
    "</model>"
)
INCLUDE = (
    "<model name='robot'><pose>1 1 1 .1 0 0</pose><link name='base'><pose>0 1 0 0 0 .2</pose></link>"
    "<include {merge}><uri>model://arm</uri><name>left</name>{inside}</include>"
    "<joint name='s' type='fixed'><parent>base</parent><child>{child}</child></joint></model>"
)

SDF = {
    "chain": sdf(CHAIN, "1.8"),
    "nested": sdf(NESTED, "1.9"),
    "angles": sdf(ANGLES, "1.9"),
    "axis 1.4": sdf(OLD_AXIS.format("", ""), "1.4"),
    "axis 1.5": sdf(OLD_AXIS.format(PARENT.format("true"), ""), "1.5"),
    "axis 1.6": sdf(OLD_AXIS.format(PARENT.format("0"), PARENT.format("1")), "1.6"),
    "axis 1.7": sdf(OLD_AXIS.format("", ""), "1.7"),
    "deep names": sdf(DEEP, "1.8"),
    "frame on a joint": sdf(ON_JOINT, "1.8"),
    "limits": sdf(LIMITS, "1.6"),
    "static without links": sdf("<model name='m'><static>1</static></model>"),
    "nested static without links": sdf(
        "<model name='m'><model name='n'><static>true</static></model></model>", "1.8"
    ),
    **{
        f"include {merge} {inside}": sdf(
            INCLUDE.format(
                merge=f"merge='{merge}'" if merge else "",
                inside=inside,
                child="upper" if merge else "left::upper",
            ),
            "1.9",
        )
        for merge in ("", "true")
        for inside in (
            "",
            "<pose>1 2 3 0 0 .5</pose>",
            "<pose relative_to='base'>0 0 2 0 0 1.5</pose>",
            "<placement_frame>lower</placement_frame><pose relative_to='base'>1 0 2 0 1 1</pose>",
            "<static>true</static><pose/><placement_frame>tool::tip</placement_frame>",
        )
    },
}


def inertial(mass, xyz="0 0 0", rpy="0 0 0", moments=(1, 2, 2.5, 0.1, 0.2, -0.1)):
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    values = " ".join(f"{n}='{v}'" for n, v in zip(names, moments, strict=True))
    return (
        f"<inertial><origin xyz='{xyz}' rpy='{rpy}'/><mass value='{mass}'/>"
        f"<inertia {values}/></inertial>"
    )


def shape(kind, xyz, body, name=""):
    label = f" name='{name}'" if name else ""
    return (
        f"<{kind}{label}><origin xyz='{xyz}' rpy='.1 .2 .3'/><geometry>{body}</geometry></{kind}>"
    )


BALL, BRICK = "<sphere radius='.1'/>", "<box size='1 2 3'/>"
MESH = "<mesh filename='none.stl' scale='1 -1 2'/>"
ORIGIN = "<origin xyz='.1 .2 .3' rpy='.4 -.5 .6'/>"
AXIS = "<axis xyz='1 2 -2'/><limit lower='-1' upper='2' effort='3' velocity='4'/>"
LUMPED = (
    urdf_link(
        "a",
        inertial(2, ".1 0 0", ".3 .2 .1")
        + shape("collision", "1 0 0", BALL)
        + shape("visual", "1 0 0", MESH, "own"),
    )
    + urdf_link("b", inertial(3, "0 .1 0", "0 0 1") + shape("collision", "0 1 0", BRICK))
    + urdf_link(
        "c",
        inertial(0.5, "0 0 .4")
        + shape("collision", "0 0 1", BALL)
        + shape("collision", "0 0 2", BRICK)
        + shape("visual", "0 0 2", BALL)
        + shape("visual", "0 0 3", BRICK),
    )
    + urdf_link("d", inertial(1, "0 .2 0", "1 0 0") + shape("visual", "0 0 1", BALL))
    + urdf_link("e", inertial(1) + shape("visual", "0 0 1", BALL))
    + urdf_joint("ab", "a", "b", "fixed", ORIGIN)
    + urdf_joint("bc", "b", "c", "fixed", "<origin xyz='0 0 1' rpy='0 1 0'/>")
    + urdf_joint(
        "cd", "c", "d", "revolute", ORIGIN + AXIS + "<dynamics damping='.1' friction='.2'/>"
    )
    + urdf_joint("de", "d", "e", "{kind}", ORIGIN + "{axis}")
    + "<gazebo reference='c'><sensor name='imu' type='imu'><pose>.1 .2 .3 .3 .2 .1</pose></sensor>"
    "<mu1>.3</mu1><kp>1000</kp><turnGravityOff>true</turnGravityOff></gazebo>{extra}"
)
MIMIC = "<axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' velocity='1'/>"


def lumped(kind="continuous", axis="<axis xyz='0 3 4'/>", extra=""):
    text = LUMPED.replace("{kind}", kind).replace("{axis}", axis).replace("{extra}", extra)
    return robot(text)


def gazebo(reference, body):
    return f"<gazebo reference='{reference}'>{body}</gazebo>"


URDF = {
    "lumped": lumped(),
    "prismatic": lumped("prismatic", AXIS),
    "mimic": lumped("revolute", MIMIC + "<mimic joint='cd' multiplier='-2' offset='.1'/>"),
    "all fixed below": lumped("fixed", ""),
    "kept": lumped(extra=gazebo("bc", "<preserveFixedJoint>true</preserveFixedJoint>")),
    "not lumped": lumped(
        extra=gazebo("bc", "<disableFixedJointLumping>true</disableFixedJointLumping>")
    ),
    "both kept": lumped(
        extra=gazebo("ab", "<preserveFixedJoint>1</preserveFixedJoint>")
        + gazebo("bc", "<disableFixedJointLumping>1</disableFixedJointLumping>")
    ),
    "static": lumped(extra="<gazebo><static>true</static></gazebo>"),
    "world": robot(
        "<link name='world'/>"
        + urdf_link("a", inertial(2, ".1 0 0", ".3 .2 .1"))
        + urdf_link("b", inertial(3, "0 .1 0", "0 0 1"))
        + urdf_joint("wa", "world", "a", "fixed", ORIGIN)
        + urdf_joint("ab", "a", "b", "continuous", ORIGIN)
    ),
    "massless root": robot(
        "<link name='base_footprint'/>"
        + urdf_link(
            "base_link", inertial(2, ".1 0 0", ".3 .2 .1") + shape("collision", "1 0 0", BALL)
        )
        + urdf_link("wheel", inertial(1) + shape("collision", "0 0 0", BALL))
        + "<link name='sensor_frame'/><link name='optical'/>"
        + urdf_joint("bf", "base_footprint", "base_link", "fixed", ORIGIN)
        + urdf_joint("w", "base_link", "wheel", "continuous", ORIGIN + "<axis xyz='0 1 0'/>")
        + urdf_joint("sf", "base_link", "sensor_frame", "fixed", ORIGIN)
        + urdf_joint("so", "sensor_frame", "optical", "fixed", "<origin rpy='-1.57 0 -1.57'/>")
        + gazebo("optical", "<sensor name='cam' type='camera'><pose>1 2 3 0 0 0</pose></sensor>")
    ),
    "massless joint": robot(
        urdf_link("a", INERTIAL)
        + "<link name='b'/>"
        + urdf_link("c", INERTIAL)
        + urdf_joint("ab", "a", "b", "continuous", ORIGIN)
        + urdf_joint("bc", "b", "c", "fixed", ORIGIN)
    ),
    "massless leaf": robot(
        urdf_link("a", INERTIAL)
        + "<link name='b'/>"
        + urdf_joint("ab", "a", "b", "continuous", ORIGIN)
    ),
    "branches": robot(
        urdf_link("z", inertial(1, "1 0 0"))
        + urdf_link("y", inertial(2, "0 1 0") + shape("collision", "0 0 1", BALL))
        + urdf_link("x", inertial(3, "0 0 1") + shape("collision", "0 0 1", BALL))
        + urdf_link("u", inertial(1) + shape("collision", "0 0 1", BALL))
        + urdf_joint("zy", "z", "y", "fixed", ORIGIN)
        + urdf_joint("zx", "z", "x", "fixed", "<origin xyz='0 1 0' rpy='0 0 3'/>")
        + urdf_joint("xu", "x", "u", "revolute", ORIGIN + AXIS)
    ),
    "colours and limits of zero": robot(
        "<material name='red'><color rgba='1 0 0 .5'/></material>"
        + urdf_link(
            "a",
            inertial(1) + "<visual><geometry><sphere radius='1'/></geometry>"
            "<material name='red'/></visual>",
        )
        + urdf_link("b", inertial(1))
        + urdf_link("c", inertial(1))
        + urdf_joint("ab", "a", "b", "prismatic", ORIGIN + AXIS)
        + urdf_joint("bc", "b", "c", "revolute", ORIGIN + "<limit effort='0' velocity='0'/>")
    ),
}


def _extended(body):
    """Return two links and one lumped into the second, with extensions."""
    return robot(
        urdf_link(
            "a", inertial(2) + shape("collision", "1 0 0", BALL) + shape("visual", "1 0 0", BRICK)
        )
        + urdf_link(
            "b",
            inertial(3)
            + shape("collision", "0 1 0", BRICK)
            + shape("visual", "1 0 0", BALL)
            + shape("visual", "0 2 0", BALL),
        )
        + urdf_link(
            "c", inertial(1) + shape("collision", "0 1 0", BRICK) + shape("visual", "1 0 0", BALL)
        )
        + urdf_joint(
            "ab",
            "a",
            "b",
            "revolute",
            ORIGIN
            + AXIS
            + "<dynamics damping='.7' friction='.3'/><safety_controller k_velocity='1' "
            "k_position='2' soft_lower_limit='-.5' soft_upper_limit='.5'/>",
        )
        + urdf_joint("bc", "b", "c", "fixed", ORIGIN)
        + body
    )


_BODIES = {
    "surface": gazebo(
        "a",
        "<mu1>.1</mu1><mu2>.2</mu2><kp>1e5</kp><kd>10</kd><maxVel>.3</maxVel><minDepth>.001</minDepth><fdir1>1 0 0</fdir1><maxContacts>7</maxContacts><laserRetro>3</laserRetro><selfCollide>true</selfCollide><dampingFactor>.2</dampingFactor><material>Gazebo/Red</material>",
    ),
    "surface lumped": gazebo(
        "c",
        "<mu1>.1</mu1><mu2>.2</mu2><kp>1e5</kp><maxContacts>7</maxContacts><laserRetro>3</laserRetro><selfCollide>1</selfCollide><dampingFactor>.2</dampingFactor><material>Gazebo/Red</material><turnGravityOff>1</turnGravityOff>",
    ),
    "attr values": gazebo("a", "<mu1 value='.1'/><mu2 value='.2'/><turnGravityOff value='true'/>"),
    "twice": gazebo("a", "<mu1>.1</mu1>") + gazebo("a", "<mu1>.4</mu1><mu2>.3</mu2>"),
    "joint": gazebo(
        "ab",
        "<stopCfm>.1</stopCfm><stopErp>.3</stopErp><fudgeFactor>.5</fudgeFactor><implicitSpringDamper>1</implicitSpringDamper><springReference>.2</springReference><springStiffness>4</springStiffness><provideFeedback>true</provideFeedback>",
    ),
    "joint cfm": gazebo("ab", "<cfmDamping>true</cfmDamping>"),
    "joint sensor": gazebo(
        "ab", "<sensor name='ft' type='force_torque'><update_rate>30</update_rate></sensor>"
    ),
    "model": "<gazebo><static>false</static><self_collide>true</self_collide><allow_auto_disable>false</allow_auto_disable><plugin name='p' filename='f.so'><x>1</x></plugin></gazebo>",
    "sdf words": gazebo(
        "a",
        "<gravity>false</gravity><self_collide>true</self_collide><kinematic>1</kinematic><velocity_decay><linear>.1</linear><angular>.2</angular></velocity_decay><enable_wind>true</enable_wind>",
    ),
    "light": gazebo("b", "<light name='l' type='point'><pose>1 2 3 0 0 0</pose></light>"),
    "visual blob": gazebo(
        "a",
        "<visual><material><ambient>1 0 0 1</ambient><diffuse>0 1 0 1</diffuse></material></visual>",
    ),
    "visual blob lumped": gazebo(
        "c",
        "<visual><material><ambient>1 0 0 1</ambient><diffuse>0 1 0 1</diffuse></material></visual>",
    ),
    "collision blob": gazebo(
        "a",
        "<collision><surface><friction><ode><mu>.77</mu></ode></friction><bounce><restitution_coefficient>.4</restitution_coefficient></bounce></surface></collision>",
    ),
    "no gravity": gazebo("a", "<turnGravityOff>false</turnGravityOff>"),
    "joint in the model": "<gazebo><joint name='fix' type='fixed'><parent>world</parent><child>a</child></joint></gazebo>",
}
_PLUGIN = "<plugin name='p' filename='f.so'>{}</plugin>"
_LUMPS = (
    urdf_link("a", inertial(2) + shape("collision", "1 0 0", BALL, "own"))
    + urdf_link("b", inertial(3) + shape("collision", "0 1 0", BRICK, "a_like"))
    + urdf_link("c", inertial(1) + shape("collision", "0 1 0", BRICK, "other"))
    + urdf_link("d", inertial(0, moments=(1e-3, 1e-3, 1e-3, 0, 0, 0)))
    + urdf_link("e", inertial(1e-7))
    + urdf_joint("ab", "a", "b", "fixed", ORIGIN)
    + urdf_joint("bc", "b", "c", "fixed", "<origin xyz='0 0 1' rpy='0 1.57 0'/>")
    + urdf_joint("cd", "c", "d", "fixed", ORIGIN)
    + urdf_joint("ae", "a", "e", "continuous", ORIGIN)
)
_RED, _BLUE = "<color rgba='1 0 0 1'/>", "<color rgba='.1 .2 .8 .5'/>"


def _painted(material, name=""):
    return shape("visual", "0 0 1", BALL, name).replace(
        "</visual>", f"<material name='m'>{material}</material></visual>"
    )


_LAMP = (
    "<gazebo><model name='lamp'><pose>1 0 0 0 0 .5</pose><link name='body'><pose>0 0 1 0 0 0"
    "</pose></link></model></gazebo>"
)
_ON = (
    "<gazebo><joint name='{}' type='fixed'><parent>a</parent><child>lamp::body</child></joint>"
    "</gazebo>"
)
_WHOLE = {
    "named collisions": _LUMPS
    + "".join(gazebo(link, f"<mu1>.{n}</mu1><kp>{n}e5</kp>") for n, link in enumerate("abc", 1)),
    "plugins of lumped links": _LUMPS
    + "<gazebo>"
    + _PLUGIN.format("<bodyName>c</bodyName>")
    + _PLUGIN.replace("'p'", "'q'").format("<bodyName>c</bodyName><frameName>c</frameName>")
    + _PLUGIN.replace("'p'", "'r'").format(
        "<bodyName>b</bodyName><xyzOffset>1 2 3</xyzOffset><rpyOffset>.1 .2 .3</rpyOffset>"
    )
    + _PLUGIN.replace("'p'", "'s'").format("<bodyName>a</bodyName><frameName>world</frameName>")
    + "</gazebo>",
    "noise of old": _LUMPS
    + gazebo(
        "a",
        "<sensor name='s' type='imu'><imu><noise><type>gaussian</type><rate><stddev>.1</stddev>"
        "</rate><accel><stddev>.2</stddev></accel></noise></imu></sensor>",
    ),
    "nearly upright": _LUMPS
    + urdf_link("f", inertial(1) + shape("visual", "0 1 0", BALL).replace(".1 .2 .3", ".3 1.57 0"))
    + urdf_joint("af", "a", "f", "continuous")
    + gazebo("c", "<sensor name='s' type='imu'><pose>0 0 0 .3 0 .2</pose></sensor>"),
    "projectors of lumped links": _LUMPS
    + "".join(
        gazebo(
            link,
            f"<projector name='p{link}'><pose>.1 .2 .3 .4 .5 .6</pose><texture>t.png</texture>"
            "<fov>.9</fov></projector>",
        )
        for link in "abce"
    )
    + gazebo("d", "<projector name='p'><texture>t.png</texture></projector>"),
    "what refers to nothing": _LUMPS + gazebo("nowhere", _PLUGIN.format("") + "<mu1>1</mu1>"),
    "colours": "<material name='m'>"
    + _RED
    + "</material>"
    + urdf_link("a", inertial(1) + _painted(_BLUE) + _painted("")),
    "colours in passing": urdf_link("a", inertial(1) + _painted(_BLUE) + _painted(_RED)),
    "a colour and a script": urdf_link("a", inertial(1) + _painted(_BLUE))
    + gazebo("a", "<material>Gazebo/Red</material>"),
    "a script in a material": urdf_link("a", inertial(1) + _painted(_BLUE))
    + gazebo(
        "a",
        "<visual><material><ambient>1 0 1 1</ambient></material></visual>"
        "<material>Gazebo/Red</material>",
    ),
    "plugin of a visual": urdf_link("a", inertial(1) + _painted(_BLUE))
    + gazebo("a", f"<visual>{_PLUGIN.format('<x>1</x>')}</visual>"),
    "a model on a link": urdf_link("a", inertial(1)) + _LAMP + _ON.format("on"),
    "fixed to the world": "<link name='world'/>"
    + urdf_link("a", inertial(1) + _painted(_BLUE))
    + urdf_link("b", inertial(1))
    + urdf_joint("j", "world", "a")
    + urdf_joint("k", "a", "b"),
    "a package": urdf_link(
        "a", inertial(1) + shape("visual", "0 0 0", "<mesh filename='package://none/a.stl'/>")
    ),
}
EXTENDED = {
    **{name: _extended(body) for name, body in _BODIES.items()},
    **{name: robot(body) for name, body in _WHOLE.items()},
}
