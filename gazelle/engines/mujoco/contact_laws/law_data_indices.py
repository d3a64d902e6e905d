"""Custom numbers of a MuJoCo model that say which laws hold for it, and for its geoms."""

# What the first number of a model says that the laws hold for.
MARK = 7.0131e57

# Numbers before those of the tumbling bodies: the mark, whether Jacobians are sparse, how many
# bodies tumble, how many motors there are, whether something rubs by direction, there are
# wheels, something slides, how many velocities of joints to look at, the address of the flag
# of spins that are too fast, that of ``Hooks`` (0 for none), and the number of the world. Each body that tumbles
# has its index and the first of its six velocities.
HEAD = 11
WORLD = 10

# Numbers after those, where velocities of joints are looked at: of MuJoCo's functions the
# addresses, and how many velocities there are, and how many of them are of hinges, which come
# first. The velocities follow.
COM_VEL, RNE, SOLVE_M, COUNT, HINGES = 0, 1, 2, 3, 4
BIAS_HEAD = 5

# Numbers of a geom: whether it has a direction, which, and how much it rubs along it; as a
# wheel's tread, one more than its joint, and how far its middle is off along the axle [m]; the
# velocity at which it leaves an overlap [m/s]; and whether all of a body that it moves with, and
# that has no joints, rubs alike, or does not move.
GEOM_NUMBERS = 9
NO_DIRECTION, ITS_OWN, BY_THE_NORMAL = 0.0, 1.0, 2.0
TREAD, MIDDLE, EXIT, ALIKE = 5, 6, 7, 8
