"""Count how many rows of an engine are read at once."""

from __future__ import annotations

from gazelle.engines.mujoco.tables import joints, links, models

_ROWS = {
    "links": (links.MujocoLinkRows, links.MujocoLinkRow),
    "joints": (joints.MujocoJointRows, joints.MujocoJointRow),
    "models": (models.MujocoModelRows, models.MujocoModelRow),
}


def count_looks(monkeypatch, table, method, *, allow_one=True):
    """Return a list that gets the number of rows of each call of a method.

    A call for a single row is an error, if it is not allowed.
    """
    looks = []
    many, one = _ROWS[table]
    look = getattr(many, method)

    def counted(self, *args):
        assert allow_one or not isinstance(self, one), f"{method} of one of the {table}"
        looks.append(len(self._names))
        return look(self, *args)

    def refused(self, *args):
        raise AssertionError(f"{method} of one of the {table}")

    monkeypatch.setattr(many, method, counted)
    if not allow_one and method in vars(one):
        monkeypatch.setattr(one, method, refused)
    return looks
