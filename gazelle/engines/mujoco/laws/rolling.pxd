from gazelle.engines.mujoco.laws.touch cimport Touch

cdef void hold_loosely(Touch *touch) noexcept nogil
