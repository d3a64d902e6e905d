cimport cython

from gazelle.engines.planar.bodies cimport Bodies

cdef double MOST_LOOKS, PI, MOST_TURN

cdef double bounded(Bodies w, double value, Py_ssize_t k, Py_ssize_t axis) noexcept nogil
cdef double toward(
    Bodies w, double now, double target, Py_ssize_t k, Py_ssize_t axis, double dt) noexcept nogil
cdef (double, double, double, double) turned(double angle) noexcept nogil
cdef void go(Bodies w, Py_ssize_t b, double vx, double vy, double turn, double dt) noexcept nogil
cdef void remember_turn(Bodies w, Py_ssize_t b, double angle) noexcept nogil
cdef (double, double) stride(
    Bodies w, Py_ssize_t b, double vx, double vy, double dt) noexcept nogil
@cython.locals(target=double)
cdef double wanted(Bodies w, Py_ssize_t b, Py_ssize_t k, Py_ssize_t axis) noexcept nogil
@cython.locals(target=double)
cdef double driven(
    Bodies w, Py_ssize_t b, Py_ssize_t k, Py_ssize_t axis, double dt) noexcept nogil
cdef (double, double, double) twist_of(Bodies w, Py_ssize_t b, Py_ssize_t k) noexcept nogil
@cython.locals(b=Py_ssize_t, k=Py_ssize_t, axis=Py_ssize_t, longest=double)
cdef double propose(Bodies w, Py_ssize_t first, Py_ssize_t last, double dt) noexcept nogil
@cython.locals(target=double)
cdef double fastest(Bodies w, Py_ssize_t b, Py_ssize_t k, Py_ssize_t axis) noexcept nogil
@cython.locals(b=Py_ssize_t, k=Py_ssize_t, d=Py_ssize_t, most=double)
cdef Py_ssize_t count_substeps(Bodies w, Py_ssize_t first, Py_ssize_t last) noexcept nogil
@cython.locals(b=Py_ssize_t, c=Py_ssize_t, moved=Py_ssize_t)
cdef Py_ssize_t commit(Bodies w, Py_ssize_t first, Py_ssize_t last) noexcept nogil
@cython.locals(sideways=bint)
cdef bint keeps_velocity(Bodies w, Py_ssize_t b, Py_ssize_t k) noexcept nogil
@cython.locals(sideways=bint, axis=Py_ssize_t, speed=double)
cdef bint expect_move(Bodies w, Py_ssize_t b, Py_ssize_t k) noexcept nogil
@cython.locals(b=Py_ssize_t, k=Py_ssize_t, longest=double)
cdef double longest_move(
    Bodies w, Py_ssize_t first, Py_ssize_t last, bint fresh) noexcept nogil
