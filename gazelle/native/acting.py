"""When an engine updates a system, and the columns of a loop's table, for compiled modules, too."""

# Between two steps; in the middle of a step, to change its forces; at the end of the step before,
# for the next one; and in the middle of a step, with joints read and acted on.
BETWEEN, IN_STEP, AHEAD, OF_JOINTS = 0, 1, 2, 3

# Columns of the table that a ``SystemLoop`` shares with an engine: the address of a system, its rows in
# each world, four that are the loop's own, when it is updated, and one more of the loop.
ADDRESS, ROWS, DIVISIBLE, LATE, LEAST, STEADY, ACTS, MERGEABLE, WIDTH = 0, 1, 2, 3, 4, 5, 6, 7, 8
