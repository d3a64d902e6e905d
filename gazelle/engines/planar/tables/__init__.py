"""Rows of links, joints and models in the arrays of planar worlds."""
