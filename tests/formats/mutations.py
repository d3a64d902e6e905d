"""Small files of every kind that Gazelle reads, and ways to break them.

``python tests/formats/mutations.py SECONDS [SEED]`` breaks them for so long and prints what
ends in anything but a result or an error of Gazelle's.
"""

import io
import random
import re
import resource
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

from PIL import Image
from xml_samples import INERTIAL, sdf

from gazelle import Error, formats
from gazelle.description import Heightmap, Mesh
from gazelle.description import Image as Walls
from gazelle.formats.lint import lint
from gazelle.formats.terrain import load_boxes, load_heights

SECONDS = 5.0
GIGABYTE = 2**30
LINK = "<link name='l'/>"
NUMBER = re.compile(rb"-?\d+\.?\d*(e-?\d+)?")
EVIL = [b"nan", b"-inf", b"1e308", b"-1e308", b"1e-320", b"0", b"-1", b"9" * 400, b"", b"a"]
EVIL += [
    b"4294967296",
    b"::",
    b"${1/0}",
    b"../../../../etc/passwd",
    b"\x00",
    "\u00e9\u2028".encode(),
]

PICTURE = io.BytesIO()
Image.new("L", (5, 4), 90).save(PICTURE, "PNG")

DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
 version="1.4.1"><asset><unit meter="0.01" name="cm"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh><source id="p"><float_array id="pa" count="9">
0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#pa" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">
<node id="n" name="n"><matrix>1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1</matrix><scale>1 2 3</scale>
<instance_geometry url="#g"/><node><rotate>0 0 1 90</rotate><instance_geometry url="#g"/></node>
</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""
STL = """solid a
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid a"""
OBJ = "mtllib m.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvn 0 0 1\nf 1//1 2//1 3//1\ng b\nf -1 2 3 4\n"
MAP = (
    "image: p.png\nresolution: 0.05\norigin: [-1.0, 2.0, 0.5]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: scale\n"
)
SRDF = (
    "<robot name='r'><group name='arm'><chain base_link='a' tip_link='b'/><joint name='j'/></group>"
    "<group name='hand'><link name='c'/><group name='arm'/></group>"
    "<group_state name='home' group='arm'><joint name='j' value='0.5 1'/></group_state>"
    "<end_effector name='e' parent_link='b' group='hand' parent_group='arm'/>"
    "<virtual_joint name='v' type='planar' parent_frame='o' child_link='a'/>"
    "<passive_joint name='w'/><disable_collisions link1='a' link2='b' reason='Adjacent'/>"
    "<link_sphere_approximation link='a'><sphere center='0 0 1' radius='.5'/>"
    "</link_sphere_approximation></robot>"
)
ACTOR = (
    "<world name='w'><actor name='a'><pose>1 0 0 0 0 0</pose><skin><filename>m.dae</filename>"
    "<scale>2</scale></skin><animation name='t'><filename>m.dae</filename></animation><script>"
    "<loop>true</loop><delay_start>1</delay_start><auto_start>true</auto_start>"
    "<trajectory id='0' type='t'><waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>"
    "<waypoint><time>2</time><pose>1 2 3 .1 .2 .3</pose></waypoint></trajectory></script></actor></world>"
)
POPULATION = (
    "<world name='w'><population name='p'><model name='c'><link name='l'/></model>"
    "<pose>1 2 3 0 0 1</pose><{0}</{1}><model_count>5</model_count>"
    "<distribution><type>{2}</type><rows>2</rows><cols>3</cols><step>1 2 0</step></distribution>"
    "</population></world>"
)
GROUND = (
    "<world name='w'><model name='m'><static>1</static><link name='l'><collision name='c'><geometry>"
    "<heightmap><uri>p.png</uri><size>9 9 2</size><pos>1 2 3</pos></heightmap></geometry></collision>"
    "<collision name='d'><geometry><image><uri>p.png</uri><scale>.1</scale><threshold>200</threshold>"
    "<height>1</height><granularity>2</granularity></image></geometry></collision>"
    "<collision name='e'><geometry><polyline><point>0 0</point><point>1 0</point><point>1 1</point>"
    "<height>2</height></polyline></geometry></collision><collision name='f'><geometry><mesh>"
    "<uri>m.stl</uri><scale>1 -1 1</scale><submesh><name>a</name><center>1</center></submesh></mesh>"
    "</geometry></collision></link></model></world>"
)
INNER = sdf(
    "<model name='arm' placement_frame='f'><link name='u'/><link name='v'><pose relative_to='u'>"
    "1 0 0 0 0 1</pose></link><frame name='f' attached_to='v'><pose>0 1 0 0 0 0</pose></frame>"
    "<joint name='j' type='universal'><parent>u</parent><child>f</child><axis>"
    "<xyz expressed_in='__model__'>1 0 1</xyz></axis></joint><model name='n'><link name='l'/></model>"
    "<gripper name='g'><gripper_link>u</gripper_link></gripper></model>",
    "1.9",
)
MERGE = (
    "<model name='m'><link name='b'/><include merge='true'><uri>arm.sdf</uri><name>x</name>"
    "<pose relative_to='b'>1 2 3 0 0 1</pose><placement_frame>f</placement_frame></include>"
    "<joint name='k' type='fixed'><parent>b</parent><child>u</child></joint></model>"
)
STATE = (
    "<world name='w'><model name='m'><link name='l'/></model><state world_name='w'>"
    "<insertions><model name='k'><link name='l'/></model></insertions><deletions><name>z</name>"
    "</deletions><model name='m'><pose>1 2 3 0 0 0</pose><link name='l'><pose>1 2 3 0 0 1</pose>"
    "</link></model></state></world>"
)
OLD = (
    "<gazebo version='1.0'><world name='w'><physics type='ode' update_rate='7'><ode><solver dt='.1' "
    "iters='5'/></ode></physics><scene><fog rgba='1 1 1 1'/><background rgba='0 0 0 1'><sky "
    "material='x'/></background></scene><model name='m'><origin pose='0 0 1 0 0 0'/><link name='l'>"
    "<inertial mass='2'><damping linear='1'/><inertia ixx='1'/></inertial><collision name='c'>"
    "<geometry><box size='1 2 3'/></geometry></collision></link></model></world></gazebo>"
)
AUTO = (
    "<model name='m'><link name='l'><inertial auto='true'><density>3</density></inertial>"
    "<collision name='c'><geometry><capsule><radius>1</radius><length>2</length></capsule>"
    "</geometry></collision><collision name='d'><density>2</density><geometry><mesh><uri>m.stl</uri>"
    "</mesh></geometry></collision></link></model>"
)
XACRO = (
    "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:arg name='n' default='2'/>"
    "<xacro:property name='p' value='${2*pi}'/><xacro:property name='d' value=\"${dict(a=[1,2],b='x')}\"/>"
    "<xacro:macro name='m' params='i:=1 *b **c'><link name='l${i}'>"
    + INERTIAL
    + "<xacro:insert_block "
    "name='b'/><xacro:if value='${i &lt; 3}'><visual><geometry><box size='${i} 1 ${d[\"a\"][0]}'/>"
    "</geometry></visual></xacro:if></link><xacro:insert_block name='c'/></xacro:macro>"
    "<xacro:m i='$(arg n)'><collision><geometry><sphere radius='${p}'/></geometry></collision><x/></xacro:m>"
    "<xacro:include filename='inc.xacro'/><xacro:unless value='0'><joint name='k' type='fixed'><parent link='l2'/><child link='k'/></joint><link name='k'/></xacro:unless></robot>"
)
EXTENDED = (
    "<robot name='r'><link name='a'>" + INERTIAL + "</link><link name='b'>" + INERTIAL + "</link>"
    "<joint name='j' type='fixed'><origin xyz='1 2 3' rpy='0 1 0' quat_xyzw='0 0 0 1'/>"
    "<parent link='a'/><child link='b'/><mimic joint='k' multiplier='2'/></joint>"
    "<gazebo reference='b'><sensor name='s' type='ray'><pose>1 2 3 0 0 0</pose><ray><scan>"
    "<horizontal><samples>9</samples></horizontal></scan><range><min>0</min><max>5</max></range></ray>"
    "</sensor><mu1>1</mu1><kp>1e6</kp></gazebo><gazebo reference='j'><preserveFixedJoint>1"
    "</preserveFixedJoint></gazebo><gazebo><static>1</static><plugin name='p' filename='f'/></gazebo>"
    "<transmission name='t'><type>x</type><joint name='j'/><actuator name='m'/></transmission></robot>"
)


def description(path):
    lint(formats.load(path))


def mesh(path):
    formats.load_mesh(Mesh(path.name, path, scale=(1.0, -2.0, 1.0)))


def picture(path):
    load_heights(Heightmap(path.name, path, size=(1.0, 1.0, 2.0)))
    load_boxes(Walls(path.name, path))


SEEDS = {
    "actor.world": (sdf(ACTOR), description),
    "ball.obj": (OBJ, mesh),
    "ball.stl": (STL, mesh),
    "box.world": (sdf(POPULATION.format("box><size>4 2 1</size>", "box", "uniform")), description),
    "extended.urdf": (EXTENDED, description),
    "grid.world": (sdf(POPULATION.format("box>", "box", "grid")), description),
    "ground.world": (sdf(GROUND), description),
    "inertia.sdf": (sdf(AUTO, "1.11"), description),
    "macros.urdf.xacro": (XACRO, description),
    "map.yaml": (MAP, formats.load_map),
    "merge.sdf": (sdf(MERGE, "1.9"), description),
    "old.world": (OLD, description),
    "p2.png": (PICTURE.getvalue(), picture),
    "robot.srdf": (SRDF, formats.load_srdf),
    "scene.dae": (DAE, mesh),
    "state.world": (sdf(STATE), description),
    "tube.world": (
        sdf(POPULATION.format("cylinder><radius>1</radius>", "cylinder", "random")),
        description,
    ),
}
BESIDE = {
    "arm.sdf": INNER,
    "inc.xacro": "<robot xmlns:xacro='x'><xacro:property name='q' value='1'/></robot>",
    "m.dae": DAE,
    "m.stl": STL,
    "p.png": PICTURE.getvalue(),
}


def as_bytes(content):
    return content if isinstance(content, bytes) else content.encode()


def prepare(folder):
    """Write the files that the others name."""
    for name, content in BESIDE.items():
        (folder / name).write_bytes(as_bytes(content))


def mutated(data, chance):
    """Return the content with one to four faults."""
    for _ in range(chance.randint(1, 4)):
        data = chance.choice(WAYS)(data, chance)
    return data


def _span(data, chance):
    start = chance.randrange(len(data) + 1)
    return start, min(len(data), start + chance.choice([1, 4, 20, 100]))


def _flip(data, chance):
    changed = bytearray(data)
    for _ in range(chance.randint(1, 6) if data else 0):
        changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed)


def _cut(data, chance):
    start, end = _span(data, chance)
    return data[:start] + data[end:]


def _double(data, chance):
    start, end = _span(data, chance)
    return data[:end] + data[start:end] * chance.choice([1, 3, 300]) + data[end:]


def _move(data, chance):
    start, end = _span(data, chance)
    rest = data[:start] + data[end:]
    at = chance.randrange(len(rest) + 1)
    return rest[:at] + data[start:end] + rest[at:]


def _number(data, chance):
    places = list(NUMBER.finditer(data))
    if not places:
        return data
    place = chance.choice(places)
    return data[: place.start()] + chance.choice(EVIL) + data[place.end() :]


def _element(data, chance):
    """Replace or remove one element."""
    places = list(re.finditer(rb"<(\w+)[^<>]*?(/>|>[^<>]*</\1>)", data))
    if not places:
        return data
    one, other = chance.choice(places), chance.choice(places)
    return data[: one.start()] + chance.choice([other.group(), b""]) + data[one.end() :]


def _value(data, chance):
    places = list(re.finditer(rb"(?<=>)[^<>]+(?=<)|(?<=')[^'<>]*(?=')", data))
    if not places:
        return data
    place = chance.choice(places)
    other = chance.choice([*EVIL, chance.choice(places).group()])
    return data[: place.start()] + other + data[place.end() :]


def _end(data, chance):
    return data[: chance.randrange(len(data) + 1)]


WAYS = [_flip, _cut, _double, _move, _number, _number, _element, _element, _value, _value, _end]


def fate(folder, name, data):
    """Return None, or the fault of a broken file's outcome."""
    path = folder / name
    path.write_bytes(data)
    start = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            SEEDS[name][1](path)
    except Error:
        pass
    except Exception:  # noqa: BLE001  # that is what is looked for
        return traceback.format_exc()
    seconds = time.process_time() - start
    return f"it took {seconds:.1f} s" if seconds > SECONDS else None


def main(seconds, seed):
    chance, end, count = random.Random(seed), time.monotonic() + seconds, 0
    with tempfile.TemporaryDirectory() as folder:
        prepare(Path(folder))
        while time.monotonic() < end:
            name = chance.choice(list(SEEDS))
            data = mutated(as_bytes(SEEDS[name][0]), chance)
            wrong = fate(Path(folder), name, data)
            count += 1
            if wrong:
                sys.stdout.write(f"{name}: {wrong}\n{data[:3000]!r}\n\n")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    sys.stdout.write(f"{count} files, at most {memory:.2f} GB\n")


if __name__ == "__main__":
    main(float(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
