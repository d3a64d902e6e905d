"""MoveIt's node ``move_group``: planning for the arm of any robot on a graph."""
