cimport cython

from gazelle.engines.planar.bodies cimport Bodies

cdef double INFINITE

cdef Py_ssize_t place_in(double value, double corner, double side, double count) noexcept nogil
cdef Py_ssize_t cell_of(double[::1] grid, double x, double y) noexcept nogil
cdef (double, double) stretch(
    double low, double high, double y0, double y1, double x0, double x1) noexcept nogil
@cython.locals(circle=bint, s=Py_ssize_t, r=Py_ssize_t, c=Py_ssize_t)
cpdef void list_statics(
    double[:, ::1] statics, double[::1] grid, int[::1] start, int[::1] items, double margin) noexcept
cdef void link(Bodies w, Py_ssize_t world, int body, Py_ssize_t cell) noexcept nogil
cdef void unlink(Bodies w, Py_ssize_t world, int body, Py_ssize_t cell) noexcept nogil
cdef void relink_one(Bodies w, Py_ssize_t b) noexcept nogil
cpdef void relink(Bodies w, Py_ssize_t first, Py_ssize_t last) noexcept nogil
cpdef void relink_some(Bodies w, Py_ssize_t[::1] which) noexcept nogil
@cython.locals(i=Py_ssize_t, k=Py_ssize_t, b=Py_ssize_t, c=Py_ssize_t, axis=Py_ssize_t)
cpdef void put_back(Bodies w, Py_ssize_t[::1] worlds, double[:, ::1] initial) noexcept
