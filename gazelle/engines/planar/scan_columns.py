"""Columns of the tables that scans work on."""

from __future__ import annotations

from typing import Final

# Lanes, beams on their way side by side: where in their table the first one has: where a beam
# starts and how it goes, in the world [m] and in cells, and how far a cell is [m]; how far it is,
# where it ends, where it leaves the grid or has reached its end [m]; one over the distance to what
# it met, and the name of that; its height [m]; the column and row that it is in, and how much is
# clear there [cells]; where in ``clear`` its direction begins. Distances between these are known
# when kernels are compiled, so that many lanes are handled at once.
MOST_LANES: Final = 64
LANE_X: Final = 0 * MOST_LANES
LANE_Y: Final = 1 * MOST_LANES
LANE_DX: Final = 2 * MOST_LANES
LANE_DY: Final = 3 * MOST_LANES
LANE_U: Final = 4 * MOST_LANES
LANE_V: Final = 5 * MOST_LANES
LANE_DU: Final = 6 * MOST_LANES
LANE_DV: Final = 7 * MOST_LANES
LANE_OVER_U: Final = 8 * MOST_LANES
LANE_OVER_V: Final = 9 * MOST_LANES
LANE_AT: Final = 10 * MOST_LANES
LANE_END: Final = 11 * MOST_LANES
LANE_OUT: Final = 12 * MOST_LANES
LANE_BEST: Final = 13 * MOST_LANES
LANE_NAME: Final = 14 * MOST_LANES
LANE_HEIGHT: Final = 15 * MOST_LANES
LANE_AT_U: Final = 16 * MOST_LANES
LANE_AT_V: Final = 17 * MOST_LANES
LANE_FREE: Final = 18 * MOST_LANES
LANE_BASE: Final = 19 * MOST_LANES
LANE_TABLE: Final = 20 * MOST_LANES

# A grid of clear space: corner in a frame that may be turned, sides of a cell [m], columns and
# rows, cosine and sine of how far the frame is turned, the heights between which solid cells are
# solid [m], and the name of what they are of.
CORNER_U: Final = 0
CORNER_V: Final = 1
SIDE_U: Final = 2
SIDE_V: Final = 3
COLUMNS: Final = 4
ROWS: Final = 5
TURN_COS: Final = 6
TURN_SIN: Final = 7
SOLID_LOW: Final = 8
SOLID_HIGH: Final = 9
SOLID_NAME: Final = 10
FINE: Final = 11

# Candidates, primitives and bodies that a sensor may see, in its frame: where in their table the
# first one has: one end of a segment, or the middle of a disc [m]; the other end, or the middle
# once more; radius, 0 for a segment; first angle that it covers, from that of the first beam [rad],
# and how many radians; name as below, or of a body its index; one over twice the area that a
# segment spans with the sensor, or one over the power of the sensor with respect to a circle;
# cosine and sine of the heading of a body.
ROOM: Final = 256
C_X0: Final = 0 * ROOM
C_Y0: Final = 1 * ROOM
C_X1: Final = 2 * ROOM
C_Y1: Final = 3 * ROOM
C_RADIUS: Final = 4 * ROOM
C_FIRST: Final = 5 * ROOM
C_SPAN: Final = 6 * ROOM
C_NAME: Final = 7 * ROOM
C_INVERSE: Final = 8 * ROOM
C_COS: Final = 9 * ROOM
C_SIN: Final = 10 * ROOM

# Sides of a small scene: both ends in their own frame [m], whether it is seen from both sides,
# lowest and highest height [m]; then in the sensor's frame: both ends, ``C_INVERSE`` or 0 where it
# is not seen, and by how many turns it takes an outline around the sensor.
F_AX: Final = 0 * ROOM
F_AY: Final = 1 * ROOM
F_BX: Final = 2 * ROOM
F_BY: Final = 3 * ROOM
F_OPEN: Final = 4 * ROOM
F_LOW: Final = 5 * ROOM
F_HIGH: Final = 6 * ROOM
F_X0: Final = 7 * ROOM
F_Y0: Final = 8 * ROOM
F_X1: Final = 9 * ROOM
F_Y1: Final = 10 * ROOM
F_INVERSE: Final = 11 * ROOM
F_TURNS: Final = 12 * ROOM

# How to scan: all in view is drawn; beams are followed where many statics are in view; beams of
# many sensors are followed side by side; beams have noise on their angle.
ALL: Final = 0
CROWDED: Final = 1
SINGLY: Final = 2
ANGLE_NOISE: Final = 3
