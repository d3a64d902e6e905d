"""The picture in the README: a TurtleBot3 burger in a furnished room, drawn by the processor."""

import sys

import gazelle
from gazelle.viewer import take_picture

with gazelle.Simulation("furnished_room") as sim:
    sim.spawn("turtlebot3_burger", name="burger", pose=gazelle.Pose(x=1.0, y=-1.1, yaw=2.2))
    sim.run(seconds=0.5)
    file = sys.argv[1] if len(sys.argv) > 1 else "room.png"
    take_picture(sim, file, eye=(2.6, -3.3, 2.1), target=(0.15, -0.1, 0.25), size=(960, 480))
    print(f"wrote {file}")
