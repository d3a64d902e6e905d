from gazelle.engines.mujoco.contact_laws.contact_data cimport Touch

cdef void stand_in_the_middle(Touch *touch) noexcept nogil
cdef bint is_upright_wheel(size_t model, int geom, double lean, double half) noexcept nogil
