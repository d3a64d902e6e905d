cimport cython

from gazelle.engines.planar.bodies cimport Bodies

cdef double TOUCH, ROOM_MEASURED

cdef bint reaches(
    double x, double y, double x0, double y0, double x1, double y1, double radius) noexcept nogil
cdef bint separates(
    Bodies w, Py_ssize_t i, Py_ssize_t j, double x0, double y0, double x1, double y1
) noexcept nogil
@cython.locals(low=double, high=double, i=Py_ssize_t)
cdef bint crosses(
    Bodies w, Py_ssize_t first, Py_ssize_t count, double x0, double y0, double x1, double y1
) noexcept nogil
@cython.locals(inside=bint, i=Py_ssize_t, j=Py_ssize_t)
cdef bint near_polygon(
    Bodies w, Py_ssize_t first, Py_ssize_t count, double x, double y, double radius) noexcept nogil
cdef bint piece_meets(
    Bodies w, Py_ssize_t p, Py_ssize_t s, double x0, double y0, double x1, double y1) noexcept nogil
@cython.locals(level=bint, circle=bint, p=Py_ssize_t)
cdef bint static_meets(Bodies w, Py_ssize_t b, Py_ssize_t k, Py_ssize_t s) noexcept nogil
@cython.locals(near=int, i=Py_ssize_t)
cdef bint any_near(Bodies w, double x, double y, double radius) noexcept nogil
@cython.locals(kind=int)
cdef double distance_of(Bodies w, Py_ssize_t s, double x, double y) noexcept nogil
@cython.locals(i=Py_ssize_t, room=double)
cdef double room_at(
    Bodies w, Py_ssize_t b, double radius, double x, double y, double wanted) noexcept nogil
cdef bint has_room(Bodies w, Py_ssize_t b, double radius) noexcept nogil
@cython.locals(i=Py_ssize_t)
cdef bint statics_meet(Bodies w, Py_ssize_t b, Py_ssize_t k) noexcept nogil
@cython.locals(apart=bint, i=Py_ssize_t, j=Py_ssize_t, q=Py_ssize_t)
cdef bint outside(
    Bodies w, Py_ssize_t first, Py_ssize_t count, double cos, double sin, double x, double y,
    Py_ssize_t start, Py_ssize_t number) noexcept nogil
cdef bint pieces_meet(
    Bodies w, Py_ssize_t p, Py_ssize_t q, double x, double y, double cos, double sin) noexcept nogil
@cython.locals(p=Py_ssize_t, q=Py_ssize_t, over=bint, under=bint)
cdef bint bodies_meet(
    Bodies w, Py_ssize_t a, Py_ssize_t ka, Py_ssize_t b, Py_ssize_t kb, bint gone) noexcept nogil
@cython.locals(ordered=bint, row=Py_ssize_t, cell=Py_ssize_t)
cdef bint obstructed(Bodies w, Py_ssize_t a, double reach) noexcept nogil
@cython.locals(b=Py_ssize_t)
cdef bint bars_in(
    Bodies w, Py_ssize_t a, Py_ssize_t k, Py_ssize_t world, Py_ssize_t cell, bint ordered
) noexcept nogil
@cython.locals(ahead=bint, gone=bint)
cdef bint bars(
    Bodies w, Py_ssize_t a, Py_ssize_t k, Py_ssize_t b, Py_ssize_t kb, bint ordered) noexcept nogil
