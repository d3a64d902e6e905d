"""Geometry without robotics: polygons, outlines of bitmaps, parts of a plane."""
