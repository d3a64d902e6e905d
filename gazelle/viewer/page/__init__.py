"""The web page of a simulation: 3D view, panels and tools."""
