cimport cython


cdef enum:
    WIDE = 16  # beams that are compared at once


cdef double angle_of(double y, double x) noexcept nogil


@cython.final
cdef class Beams:
    cdef readonly Py_ssize_t count
    cdef readonly double start, rate, reach, near, slack
    cdef public double[::1] dx, dy, best, who

    cdef void clear(self) noexcept nogil
    @cython.locals(met=cython.bint)
    cdef void draw_segment(
        self, Py_ssize_t lo, Py_ssize_t hi, double x0, double y0, double x1, double y1,
        double inverse, double name) noexcept nogil
    @cython.locals(met=cython.bint, facing=cython.bint)
    cdef void draw_circle(
        self, Py_ssize_t lo, Py_ssize_t hi, double x, double y, double square, double inverse,
        double name) noexcept nogil
    @cython.locals(met=cython.bint)
    cdef void draw_front(
        self, Py_ssize_t lo, Py_ssize_t hi, double x0, double y0, double x1, double y1,
        double inverse) noexcept nogil
    @cython.locals(met=cython.bint)
    cdef void draw_two(
        self, double ax, double ay, double bx, double by, double i, double cx, double cy,
        double dx, double dy, double j) noexcept nogil
    @cython.locals(met=cython.bint)
    cdef void draw_disc(
        self, Py_ssize_t lo, Py_ssize_t hi, double x, double y, double radius, double inverse
    ) noexcept nogil
    cdef (Py_ssize_t, Py_ssize_t) between(self, double first, double span, int turn) noexcept nogil
    cdef bint hidden(self, Py_ssize_t lo, Py_ssize_t hi, double inverse) noexcept nogil
    @cython.locals(k=Py_ssize_t, nearer=Py_ssize_t)
    cdef bint too_near(self) noexcept nogil
    @cython.locals(k=Py_ssize_t, j=Py_ssize_t, whole=Py_ssize_t, nearest=double)
    cdef double farthest(self) noexcept nogil
    cdef void report(
        self, Py_ssize_t m, double missing, bint signed, double[:, ::1] ranges,
        double[:, ::1] names) noexcept nogil


@cython.final
cdef class Candidates:
    cdef public double[::1] table

    @cython.locals(inside=cython.bint)
    cdef void solve(self, Py_ssize_t n) noexcept nogil
    @cython.locals(inside=cython.bint, left=cython.bint)
    cdef void cover(self, Py_ssize_t n, Beams beams) noexcept nogil
    cdef void draw_one(self, Py_ssize_t i, Py_ssize_t lo, Py_ssize_t hi, Beams beams) noexcept nogil
    cdef void draw(self, Py_ssize_t n, Beams beams) noexcept nogil
    cdef void solve_and_draw(self, Py_ssize_t n, Beams beams) noexcept nogil
