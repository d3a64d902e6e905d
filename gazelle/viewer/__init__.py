"""Look instead of read: pictures of a simulation."""

from gazelle.viewer.picture import take_picture

__all__ = ["take_picture"]
