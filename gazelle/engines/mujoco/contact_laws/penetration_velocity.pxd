from gazelle.engines.mujoco.contact_laws.contact_data cimport Touch

cdef void leave_slowly(Touch *touch) noexcept nogil
