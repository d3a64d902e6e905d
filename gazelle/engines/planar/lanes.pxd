cimport cython
from gazelle.engines.planar.beams cimport Beams
from gazelle.engines.planar.bodies cimport Bodies
from gazelle.engines.planar.clear_space cimport ClearSpace
from gazelle.engines.planar.viewpoint cimport Viewpoint


@cython.final
cdef class Lanes:
    cdef double[::1] table
    cdef double[::1] fine
    cdef double near
    cdef readonly ClearSpace space
    cdef readonly Bodies bodies

    cdef void put(
        self, Py_ssize_t first, double[::1] dx, double[::1] dy, Py_ssize_t base, Py_ssize_t count,
        Viewpoint at, double reach) noexcept nogil
    cdef (double, double) cell_of(self, Py_ssize_t i, double columns, double rows) noexcept nogil
    cdef double beyond(self, Py_ssize_t i, double u, double v, double wide) noexcept nogil
    cdef void look_around(self, Py_ssize_t count) noexcept nogil
    @cython.locals(go=cython.bint)
    cdef void march(self, Py_ssize_t count) noexcept nogil
    @cython.locals(go=cython.bint)
    cdef void march_bundles(self, Py_ssize_t count, double spread) noexcept nogil
    cdef void meet_segment(
        self, Py_ssize_t i, double c0, double c1, double cross, double name) noexcept nogil
    @cython.locals(facing=cython.bint)
    cdef void meet_disc(
        self, Py_ssize_t i, double dx, double dy, double x, double y, double radius,
        double name) noexcept nogil
    cdef void meet_static(self, Py_ssize_t i, Py_ssize_t p) noexcept nogil
    cdef void meet_body(self, Py_ssize_t i, Py_ssize_t k, Py_ssize_t b) noexcept nogil
    @cython.locals(begun=cython.bint, solid=cython.bint)
    cdef void meet_statics(self, Py_ssize_t count) noexcept nogil
    @cython.locals(base=Py_ssize_t, count=Py_ssize_t)
    cdef void begin_bundles(
        self, double[::1] dx, double[::1] dy, double[::1] begins, double rate, Viewpoint at,
        double reach) noexcept nogil
    @cython.locals(narrow=cython.bint, base=Py_ssize_t, count=Py_ssize_t)
    cdef void meet_ahead(
        self, Beams beams, double[::1] dx, double[::1] dy, double[::1] begins,
        Viewpoint at) noexcept nogil
    cdef void report(
        self, Py_ssize_t first, Py_ssize_t count, Py_ssize_t m, double reach, double missing,
        bint signed, double[:, ::1] ranges, double[:, ::1] names) noexcept nogil
