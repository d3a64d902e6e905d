cimport cython
from gazelle.engines.planar.beams cimport Beams, Candidates
from gazelle.engines.planar.bodies cimport Bodies




@cython.final
cdef class Viewpoint:
    cdef readonly Bodies bodies
    cdef readonly Beams beams
    cdef Candidates walls, others, sorted
    cdef double[:, ::1] outline, view
    cdef double[::1] rings
    cdef long long[::1] stamp
    cdef readonly double x, y, cos, sin, z
    cdef readonly Py_ssize_t owner, world
    cdef readonly double family

    cdef void aim(self, double[:, ::1] mounts, Py_ssize_t m, Py_ssize_t owner) noexcept nogil
    cdef void put_view(self, double share) noexcept nogil
    @cython.locals(left=double, right=double)
    cdef (double, double) extent(self, double low, double high) noexcept nogil
    @cython.locals(low=double, high=double)
    cdef (Py_ssize_t, Py_ssize_t) rows_of(self, double widest) noexcept nogil
    cdef (Py_ssize_t, Py_ssize_t) cells_of(self, double widest, Py_ssize_t r) noexcept nogil
    cdef bint is_crowded(self, Py_ssize_t most) noexcept nogil
    cdef void draw(self, bint drawn) noexcept nogil
    cdef Py_ssize_t find_static(
        self, Py_ssize_t n, Py_ssize_t s, double x, double y) noexcept nogil
    @cython.locals(disc=cython.bint, seen=cython.bint)
    cdef void find_lanes(self, double x, double y) noexcept nogil
    cdef Py_ssize_t find_statics(
        self, Py_ssize_t n, Py_ssize_t first, Py_ssize_t last, double x, double y) noexcept nogil
    cdef Py_ssize_t find_body(self, Py_ssize_t n, Py_ssize_t k, Py_ssize_t b) noexcept nogil
    cdef void sort_others(self, Py_ssize_t n) noexcept nogil
    @cython.locals(many=cython.bint, away=cython.bint)
    cdef void draw_others(self, Py_ssize_t n) noexcept nogil
    @cython.locals(circle=cython.bint, back=cython.bint)
    cdef void draw_visuals(
        self, Py_ssize_t lo, Py_ssize_t hi, Py_ssize_t k, double height, Py_ssize_t i, bint away,
        double name) noexcept nogil
