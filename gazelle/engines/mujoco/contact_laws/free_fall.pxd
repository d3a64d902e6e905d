from gazelle.engines.mujoco.contact_laws.contact_data cimport Touch

cdef double fall(Touch *touch, int way) noexcept nogil
cdef bint never_moved(Touch *touch) noexcept nogil
