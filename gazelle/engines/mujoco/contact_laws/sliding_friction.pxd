from gazelle.engines.mujoco.contact_laws.contact_data cimport Touch

cdef void stay_down(Touch *touch) noexcept nogil
