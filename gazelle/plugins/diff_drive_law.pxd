cimport cython

from gazelle.native.system cimport System

cdef double RAMP_DEADBAND

cdef class DiffDriveLaw(System):
    cdef public double half, radius, acceleration
    cdef public double[:, ::1] linear, angular, speeds, targets
    cdef public long long[::1] last_ns
    cdef public Py_ssize_t left, right
    cpdef void apply(self, long long time)
    @cython.locals(w=Py_ssize_t, most=double)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
