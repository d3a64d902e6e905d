"""Columns of the arrays that kernels work on.

A row of a primitive, of a body or of a piece is as large as a line of a processor's cache.
"""

from __future__ import annotations

from typing import Final

# Primitives, what rays meet: a segment from (X0, Y0) to (X1, Y1), solid on its left if on any
# side, or, where KIND has CIRCLE, a circle about (X0, Y0) of radius X1 [m].
X0: Final = 0
Y0: Final = 1
X1: Final = 2
Y1: Final = 3
LOW: Final = 4  # lowest height [m]
HIGH: Final = 5  # highest height [m]
GLOW: Final = 6  # what a laser gets back; negative: invisible
KIND: Final = 7
PRIMITIVE: Final = 8

SEGMENT: Final = 0
CIRCLE: Final = 1
GHOST: Final = 2  # added to KIND where nothing bumps into it
OPEN: Final = 4  # added to the KIND of lines that enclose nothing: seen from both sides

# Lanes, for worlds with few statics: the same, one row a value and one column a primitive, so
# that many are handled at once. X1 and Y1 of a circle are those of its middle.
L_RADIUS: Final = 4
L_LOW: Final = 5
L_HIGH: Final = 6
L_GLOW: Final = 7
LANES: Final = 8

# Bodies. Heading and its cosine and sine are kept together.
X: Final = 0
Y: Final = 1
YAW: Final = 2
COS: Final = 3
SIN: Final = 4
Z: Final = 5
BODY: Final = 8

# What is remembered of bodies because it is likely to hold in the next step too: what the sine and
# the like of the last turn were, see ``drive_motion.turned``, and how far a body's disc at some place
# is from all that is static [m], see ``collision.room_at``.
TURN: Final = 0
TURN_SIN: Final = 1
TURN_COS: Final = 2
TURN_AHEAD: Final = 3
TURN_ACROSS: Final = 4
ROOM_X: Final = 5
ROOM_Y: Final = 6
ROOM: Final = 7
MEMORY: Final = 8

# Convex pieces, what bodies bump with: polygons counter-clockwise, or circles.
CENTRE_X: Final = 0
CENTRE_Y: Final = 1
BOUND: Final = 2  # radius about the centre that holds it all [m]
PIECE_LOW: Final = 3
PIECE_HIGH: Final = 4
FIRST: Final = 5  # of its corners
COUNT: Final = 6  # 0 for a circle
SLIM: Final = 7  # radius of a disc within it [m]
PIECE: Final = 8

# Drives: kind, wheelbase, then bounds of velocity and acceleration along x, y and about z.
DRIVE_KIND: Final = 0
WHEELBASE: Final = 1
SLOWEST: Final = 2
FASTEST: Final = 5
BRAKE: Final = 8
PUSH: Final = 11
FREE: Final = 14  # 1 where none of these bounds anything
DRIVE: Final = 15

PASSIVE: Final = -1
DIFFERENTIAL: Final = 0
OMNIDIRECTIONAL: Final = 1
CAR: Final = 2

# What a body is, the same in all worlds: its family (members ignore each other), its
# primitives and its pieces, from the first to before the last.
FAMILY: Final = 0
FIRST_VISUAL: Final = 1
LAST_VISUAL: Final = 2
FIRST_PIECE: Final = 3
LAST_PIECE: Final = 4
RADIUS: Final = 5  # of all of it about the body's origin [m]
STRIDE: Final = 6  # farthest that it may go between two looks at what is in its way [m]
KIND_OF_BODY: Final = 7

# A sensor's place in its world: position, cosine and sine of its heading, height.
S_X: Final = 0
S_Y: Final = 1
S_COS: Final = 2
S_SIN: Final = 3
S_Z: Final = 4
SENSOR: Final = 5

# A fan: angle of the first beam [rad], beams a radian, reach [m], one over the distance at which
# beams begin [1/m], and how far angles may be wrong [rad].
START: Final = 0
RATE: Final = 1
REACH: Final = 2
NEAR: Final = 3
SLACK: Final = 4

# What a beam met: 0 for nothing; 1 + index of a static primitive; NAMES * (1 + body) + index
# of its primitive. Negative if met from inside.
NAMES: Final = 67108864

# What becomes of a body in a step.
STILL: Final = 0
MOVING: Final = 1
BLOCKED: Final = 2
UNDECIDED: Final = 3
