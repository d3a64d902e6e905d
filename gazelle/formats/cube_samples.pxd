cimport cython


cdef class CubeSampler:
    cdef double[::1] low
    cdef double side
    cdef long long rows, columns
    cdef Py_ssize_t count
    cdef unsigned char[::1] full
    cdef double[:, ::1] points
    cdef long long[::1] cubes

    @cython.locals(n=Py_ssize_t, i=cython.longlong, j=cython.longlong, wide=cython.longlong,
                   high=cython.longlong, s=double, first=double, second=double, third=double)
    cdef void walk(
        self, double[:, :, ::1] corners, long long[::1] along, long long[::1] aside
    ) noexcept nogil
    @cython.locals(i=cython.longlong, j=cython.longlong, k=cython.longlong, cube=cython.longlong)
    cdef void put(self, double x, double y, double z) noexcept nogil
