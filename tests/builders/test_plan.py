"""Floor plans become walls and places."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.builders import BuildError, plan_places, plan_size, plan_walls

PLAN = """
    ######
    #  d #
    ## ###
"""


def test_a_plan_keeps_north_up():
    assert plan_size(PLAN) == (3.0, 1.5)
    assert plan_places(PLAN, "d") == [(0.25, 0.0)]
    assert plan_places("a\n#", "a", cell=2.0) == [(0.0, 1.0)]


rows = st.lists(st.text("# ", min_size=1, max_size=8), min_size=1, max_size=8)


@settings(max_examples=100, deadline=None)
@given(rows)
def test_walls_cover_each_cell_once(lines):
    plan = "\n".join(lines)
    if "#" not in plan:
        with pytest.raises(BuildError):
            plan_walls(plan)
        return
    cells = plan_places(plan, "#", cell=1.0)
    blocks = [(c.pose, c.geometry.size) for c in plan_walls(plan, cell=1.0).links[0].collisions]
    assert sum(x * y for _, (x, y, _) in blocks) == pytest.approx(len(cells))
    for x, y in cells:
        holders = [
            1
            for pose, size in blocks
            if abs(x - pose.x) < size[0] / 2 and abs(y - pose.y) < size[1] / 2
        ]
        assert len(holders) == 1


def test_long_walls_are_one_box():
    plan = "##########\n#        #\n#        #\n##########"
    assert len(plan_walls(plan).links[0].collisions) == 4


def test_impossible_plans_are_refused():
    with pytest.raises(BuildError, match="empty"):
        plan_walls("  \n ")
    with pytest.raises(BuildError, match="no walls"):
        plan_walls("ab\ncd")
    with pytest.raises(BuildError, match="one letter"):
        plan_places(PLAN, "desk")
    with pytest.raises(BuildError, match="cell"):
        plan_walls(PLAN, cell=0.0)
