"""The parts of ``urllib``."""

from gazelle.compat.six.moves.urllib import error, parse, request

__all__ = ["error", "parse", "request"]
