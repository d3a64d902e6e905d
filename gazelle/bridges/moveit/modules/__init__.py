"""Python packages of MoveIt, as scripts import them; ``gazelle exec`` makes them importable."""
