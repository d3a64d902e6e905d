"""The cube moved by a wheel."""
