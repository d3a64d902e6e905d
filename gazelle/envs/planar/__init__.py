"""Tasks on the planar engine, stepped by native kernels from action to observation."""
