from gazelle.engines.mujoco.contact_laws.contact_data cimport Touch

cdef void hold_loosely(Touch *touch) noexcept nogil
