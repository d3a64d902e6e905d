cimport cython


cdef class PairQueue:
    cdef readonly int length
    cdef int[::1] heap, place
    cdef double[::1] size
    cdef int[:, ::1] numbers

    cdef void push(self, int pair, double size, int one, int other) noexcept nogil
    @cython.locals(pair=int)
    cdef int pop(self) noexcept nogil
    @cython.locals(place=int, last=int)
    cdef void remove(self, int pair) noexcept nogil
    cdef bint is_before(self, int one, int other) noexcept nogil
    @cython.locals(above=int)
    cdef void rise(self, int place, int pair) noexcept nogil
    @cython.locals(below=int)
    cdef void sink(self, int place, int pair) noexcept nogil
    cdef void put(self, int place, int pair) noexcept nogil
