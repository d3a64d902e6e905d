cimport cython


@cython.final
cdef class TiledMaps:
    cdef int[:, ::1] _tables
    cdef float[:, ::1] pool
    cdef int[::1] _users
    cdef int _used, _rows, _columns
    cdef double x0, y0, cell

    cdef Py_ssize_t find(self, int particle, int column, int row) noexcept
    cdef void _draw(self, int particle, double[::1] pose, double[:, ::1] beams, double most) noexcept
    cdef void _line(self, int particle, int x, int y, int end_x, int end_y) noexcept
    cdef void _visit(self, int particle, int column, int row, bint hit, double x, double y) noexcept
    cdef int _own(self, int particle, int n, int shared) noexcept
