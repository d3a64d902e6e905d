"""The parts of ``urllib``."""

from gazelle_ros.drop_in.six.moves.urllib import error, parse, request

__all__ = ["error", "parse", "request"]
