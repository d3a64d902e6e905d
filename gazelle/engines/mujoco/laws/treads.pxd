from gazelle.engines.mujoco.laws.touch cimport Touch

cdef void stand_in_the_middle(Touch *touch) noexcept nogil
