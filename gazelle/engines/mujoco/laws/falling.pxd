from gazelle.engines.mujoco.laws.touch cimport Touch

cdef double fall(Touch *touch, int way) noexcept nogil
cdef bint never_moved(Touch *touch) noexcept nogil
