cimport cython

from gazelle.control.control_law cimport ControlLaw

cdef class ForwardLaw(ControlLaw):
    cdef double[:, ::1] desired, command
    cdef Py_ssize_t[::1] columns
    @cython.locals(i=Py_ssize_t)
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
