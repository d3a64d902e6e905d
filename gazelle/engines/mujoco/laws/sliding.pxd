from gazelle.engines.mujoco.laws.touch cimport Touch

cdef void stay_down(Touch *touch) noexcept nogil
