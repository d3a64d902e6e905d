cimport cython
from gazelle.geometry.air_probes cimport AirProbes
from gazelle.geometry.pair_queue cimport PairQueue


cdef class PieceMerger:
    cdef AirProbes probes
    cdef PairQueue queue
    cdef int links, next_number
    cdef double[:, ::1] points, box, cloud
    cdef int[::1] following, first, number, member, begins, touching, owner, after, before
    cdef unsigned char[::1] refused

    @cython.locals(count=Py_ssize_t, row=int, other=int, free=bint, swapped=bint)
    cdef Py_ssize_t scan(self, Py_ssize_t[:, ::1] pairs, double reach) noexcept nogil
    @cython.locals(axis=int)
    cdef bint overlap(self, int one, int other, double reach) noexcept nogil
    @cython.locals(end=int)
    cdef void mark(self, int piece) noexcept nogil
    @cython.locals(end=int)
    cdef void unmark(self, int piece) noexcept nogil
    @cython.locals(link=int, one=int, other=int, count=int, kept=int)
    cdef void merge_from(self, int first) noexcept nogil
    @cython.locals(size=double, side=double, axis=int)
    cdef void wait_for(self, int link, int one, int other) noexcept nogil
    @cython.locals(point=int, axis=int)
    cdef int gather(self, int piece, int count) noexcept nogil
    @cython.locals(rows=int[::1], last=int, k=int, axis=int, point=int, place=double)
    cdef void take(self, int piece, int kept) noexcept nogil
    @cython.locals(end=int, after=int, beyond=int, third=int)
    cdef void join(self, int one, int other) noexcept nogil
    @cython.locals(end=int)
    cdef void relink(self, int piece) noexcept nogil
    @cython.locals(piece=int, head=int)
    cdef void add(self, int end) noexcept nogil
    @cython.locals(after=int, before=int)
    cdef void drop(self, int end) noexcept nogil
