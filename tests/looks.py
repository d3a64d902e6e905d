"""Count how many rows of an engine are read at once."""

from __future__ import annotations

from gazelle.engines.mujoco import joint_rows, link_rows, model_rows

_ROWS = {
    "links": (link_rows.MujocoLinkRows, link_rows.MujocoLinkRow),
    "joints": (joint_rows.MujocoJointRows, joint_rows.MujocoJointRow),
    "models": (model_rows.MujocoModelRows, model_rows.MujocoModelRow),
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
