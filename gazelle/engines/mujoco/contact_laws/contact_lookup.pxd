from gazelle.engines.mujoco.contact_laws.contact_data cimport Touch

cdef void begin_step(Touch *touch, size_t model, size_t data) noexcept nogil
cdef bint begin_contact(Touch *touch, size_t contact) noexcept nogil
