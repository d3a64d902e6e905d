from gazelle.engines.mujoco.laws.touch cimport Touch

cdef void leave_slowly(Touch *touch) noexcept nogil
