"""Custom numbers of a MuJoCo model that say which laws hold for it, and for its geoms."""

# What the first number of a model says that the laws hold for.
MARK = 7.0131e57

# Numbers before those of the tumbling bodies: the mark, whether Jacobians are sparse, how many
# bodies tumble, how many motors there are, and whether something rubs by direction, there
# are wheels, something slides. Each that tumbles has its body and the first of its six velocities.
HEAD = 7

# Numbers of a geom: whether it has a direction, which, and how much it rubs along it; as a
# wheel's tread, one more than its joint, and how far its middle is off along the axle [m].
GEOM_NUMBERS = 7
NO_DIRECTION, ITS_OWN, BY_THE_NORMAL = 0.0, 1.0, 2.0
TREAD, MIDDLE = 5, 6
