cimport cython

from gazelle.native.system cimport System

cdef double RAMP_DEADBAND

cdef class DiffDriveLaw(System):
    cdef double[::1] half, radius, acceleration
    cdef double[:, :, :] linear, angular, speeds, sent
    cdef double[:, :] targets
    cdef long long[:, :] last_ns
    cdef Py_ssize_t[::1] columns, sides, start
    @cython.locals(_=Py_ssize_t, w=Py_ssize_t, i=Py_ssize_t, wheel=Py_ssize_t, most=double)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
