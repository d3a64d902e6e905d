cimport cython

cdef class ControlLaw:
    cdef readonly Py_ssize_t nworld
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
    @cython.locals(w=Py_ssize_t, when="long long", passed=double)
    cpdef act(self, long long now, double period)
