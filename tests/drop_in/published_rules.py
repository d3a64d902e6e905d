"""openai_ros' rules as its published code reads, one step of one robot at a time: an oracle."""

import math

import numpy as np


def near(x, y, goal, epsilon):
    """Return the result of ``is_in_desired_position``."""
    return all(g - epsilon < here <= g + epsilon for here, g in ((x, goal[0]), (y, goal[1])))


def far(place, goal):
    """Return the result of ``get_distance_from_point``."""
    return np.linalg.norm(np.array(place, float) - np.array(goal, float))


def scan(ranges, mod, low, high, convert, least):
    """Return the result of ``discretize_observation``: the observation, and whether it ends."""
    seen, done = [], False
    for i, item in enumerate(ranges):
        if i % mod == 0:
            if np.isinf(item):
                seen.append(high)
            elif np.isnan(item):
                seen.append(low)
            else:
                seen.append(convert(item))
            done = done or least > item > 0
    return seen, done


def clamped(item, low=0.3, high=6.0):
    """Return a range as Husarion's task observes it."""
    return round(min(max(item, low), high), 1)


def reward_at(done, at_goal, end, step):
    """Return the reward of ``_compute_reward`` of tasks with a goal, in both branches."""
    return (end if at_goal else -end) if done else step


def drive(name, ranges, mod, x, y, action, closer, acceleration):
    """Return a step of a driving task: the scan as observed, whether it is over, the reward."""
    way = 5 if action == 0 else 1
    if name == "maze":
        seen, done = scan(ranges, mod, 0.1, 6.0, lambda item: round(item, 1), 0.5)
        return seen, done, -200 if done else way
    if name == "turtlebot3":
        seen, done = scan(ranges, mod, 0, 6, int, 0.2)
        done = done or acceleration > 50.0
        return seen, done, -200 if done else way
    if name == "wall":
        seen, done = scan(ranges, mod, 0, 6, int, 0.5)
        at_goal = near(x, y, (5.0, 0.0), 0.05)
        done = done or not (-1.0 < x <= 6.0 and -3.0 < y <= 3.0) or at_goal
        return seen, done, reward_at(done, at_goal, 200, way + (5 if closer else 0))
    if name == "summit":
        seen, done = scan(ranges, mod, 0, 6, int, 0.5)
        at_goal = near(x, y, (-2.94, 3.92), 0.05)
        done = done or acceleration > 20.0 or abs(x) > 4.0 or abs(y) > 4.0 or at_goal
        return seen, done, reward_at(done, at_goal, 200, 10 if closer else 1)
    assert name == "husarion"
    seen, _ = scan(ranges, mod, 0.3, 6.0, clamped, 0.0)
    at_goal = near(x, y, (-2.9, 3.9), 0.1)
    done = 0.3 in seen or not (-7.0 < x <= 3.0 and -5.0 < y <= 3.0) or at_goal
    return seen, done, reward_at(done, at_goal, 200, 10 if closer else 0)


def drone(seen, closer):
    """Return whether an episode of the drone is over, and the reward."""
    x, y, z, roll, pitch, _, sonar = seen
    inside = -1.0 < x <= 10.0 and -1.0 < y <= 5.0 and -1.0 < z <= 3.0
    upright = -1.57 < roll <= 1.57 and -1.57 < pitch <= 1.57
    done = not inside or sonar < 0.5 or not upright or near(x, y, (9.0, 4.0), 1.0)
    return done, reward_at(done, near(x, y, (9.0, 4.0), 0.5), 200, 10 if closer else 0)


def wamv(seen, closer):
    """Return whether an episode of the WAM-V is over, and the reward."""
    x, y = seen[:2]
    at_goal = near(x, y, (30.0, 0.0), 0.5)
    done = not (-1.0 < x <= 30.0 and -5.0 < y <= 5.0) or at_goal
    return done, reward_at(done, at_goal, 1000, 100 if closer else -100)


def cube(seen, before):
    """Return whether an episode of the cube is over, and the reward."""
    _, y, _, pitch, speed, yaw = seen
    if abs(pitch) > 0.3 or abs(yaw) > 0.3:
        return True, 10.0
    parts = ((y - before) * 100.0, speed * 100.0, -1 * abs(math.sin(yaw)) * 100.0)
    return False, sum(round(each, 0) for each in parts)


def cartpole(seen):
    """Return whether an episode of the cart and pole is over."""
    return seen[0] <= -1.0 or seen[0] >= 1.0 or seen[2] <= -0.7 or seen[2] >= 0.7


def hopper(seen, roll, pitch):
    """Return whether an episode of the leg is over, and the reward; its tilt is not rounded for it."""
    reward = 100.0 - 1.0 * sum(abs(each) for each in seen[5:8])
    reward = reward - 1.0 * abs(seen[4] - 7.08)
    reward = reward - 1.0 * (abs(seen[1]) + abs(seen[2]) + abs(seen[3] - 0.0))
    reward = reward - 1.0 * far(seen[8:], (0.0, 0.0, 1.0))
    return not (0.5 <= seen[10] < 3.0 and abs(roll) < 1.57 and abs(pitch) < 1.57), reward
