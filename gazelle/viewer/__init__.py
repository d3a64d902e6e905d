"""Look instead of read: pictures and films of a simulation."""

from gazelle.viewer.picture import take_picture

__all__ = ["LiveView", "TopView", "film_plan", "take_picture", "take_plan"]


def __getattr__(name: str) -> object:
    """What draws worlds in the plane, imported with the planar engine when it is used."""
    if name in {"film_plan", "take_plan"}:
        from gazelle.viewer import film

        return getattr(film, name)
    if name == "LiveView":
        from gazelle.viewer.live import LiveView

        return LiveView
    if name == "TopView":
        from gazelle.viewer.plan import TopView

        return TopView
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
