"""MoveIt's package of that name: its four modules are C++ there, and Python here."""
