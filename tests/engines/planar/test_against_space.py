"""The plane against three dimensions: poses within 1 % of the way, scans within 1 cm and resolution.

On worlds of boxes and cylinders that is tested with the engine; here on meshes, a map of
map_server and bundled worlds with furniture.
"""

import math

import numpy as np
import pytest
import scenes
from PIL import Image

import gazelle
from gazelle import Pose, assets
from gazelle.description import Collision, Link, Mesh, Model

SECONDS = 5.0


def column(folder, name, sides, low, high):
    """Return a tapered column with some sides as a mesh in a file."""
    angles = 2 * math.pi * np.arange(sides) / sides
    rows = [
        f"v {r * math.cos(a):.6f} {r * math.sin(a):.6f} {z}"
        for r, z in ((low, 0.0), (high, 1.0))
        for a in angles
    ]
    faces = []
    for i in range(sides):
        j = (i + 1) % sides
        faces += [
            f"f {i + 1} {j + 1} {sides + j + 1}",
            f"f {i + 1} {sides + j + 1} {sides + i + 1}",
        ]
    for i in range(1, sides - 1):
        faces += [f"f 1 {i + 2} {i + 1}", f"f {sides + 1} {sides + i + 1} {sides + i + 2}"]
    path = folder / f"{name}.obj"
    path.write_text("\n".join(rows + faces) + "\n")
    return Mesh(path.name, path)


def mesh_world(folder):
    """Return a ring of tapered columns, all meshes."""
    models = []
    for k in range(7):
        shape = column(folder, f"column_{k}", 3 + k, 0.45, 0.2 + 0.05 * k)
        angle = 2 * math.pi * k / 7 + 0.3
        pose = Pose(1.8 * math.cos(angle), 1.8 * math.sin(angle), -0.1, yaw=0.5 * k)
        link = Link("link", collisions=(Collision("c", shape),))
        models.append(Model(f"column_{k}", pose=pose, static=True, links=(link,)))
    return scenes.world(scenes.ground(1.0), *models)


def map_file(folder):
    """Return a room with a pillar and a niche, drawn with 5 cm a pixel."""
    pixels = np.full((80, 100), 254, np.uint8)
    pixels[[0, 1, -2, -1]] = 0
    pixels[:, [0, 1, -2, -1]] = 0
    pixels[20:32, 60:70] = 0
    pixels[55:80, 20:24] = 0
    Image.fromarray(pixels).save(folder / "room.pgm")
    file = folder / "room.yaml"
    file.write_text(
        "image: room.pgm\nresolution: 0.05\norigin: [-2.5, -2.0, 0.1]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return file


def drive(engine, world, command, pose, start=None):
    sim = gazelle.Simulation(world, engine)
    robot = sim.spawn(assets.robot("turtlebot3_burger"), name="burger", pose=pose)
    sim.run(0.5)
    robot.inputs["cmd_vel"].send(linear=command[0], angular=command[1])
    sim.run(1.0)  # a robot with mass slips while it speeds up
    if start is not None:
        sim.engine.models["burger"].set_placement(start.position, start.quaternion)
    begin = robot.placement()
    sim.run(SECONDS)
    return sim, robot, begin


CASES = {
    "meshes": (mesh_world, Pose(-0.5), (0.18, 0.05)),
    "map": (map_file, Pose(-1.0, -0.6, yaw=-0.3), (0.2, 0.1)),
    "turtlebot3_world": (lambda _: "turtlebot3_world", Pose(-2.0, -0.5), (0.2, 0.1)),
    "furnished_room": (lambda _: "furnished_room", Pose(0.0, 0.0), (0.15, 0.04)),
    "office": (lambda _: "office", Pose(0.5, 0.0), (0.15, 0.04)),
}


@pytest.mark.parametrize("case", CASES)
def test_a_burger_drives_and_sees_as_in_three_dimensions(case, tmp_path):
    make, pose, command = CASES[case]
    world = make(tmp_path)
    deep, there, begin = drive("mujoco", world, command, pose)
    flat, here, _ = drive("planar", world, command, pose, begin)
    with deep, flat:
        gone = command[0] * SECONDS
        moved = np.hypot(*(there.position[0] - begin.position[0])[:2])
        assert moved > 0.5 * gone  # it drove, and ran into nothing
        assert np.hypot(*(there.position - here.position)[0, :2]) < 0.01 * gone
        place = there.placement()
        flat.engine.models["burger"].set_placement(place.position, place.quaternion)
        sensor = next(s for s in there.sensors.values() if s.description.lidar is not None)
        seen = here.sensors[sensor.description.name].measure()[0]
        true = sensor.measure()[0]
        assert np.isfinite(true).mean() > 0.1  # there is something to be seen
        with np.errstate(invalid="ignore"):
            off = np.abs(seen - true)
        agree = (np.isinf(seen) & np.isinf(true)) | (off <= 0.01)
        assert agree.mean() > 0.98  # a ray that grazes an edge may pass it
