cimport cython


@cython.final
cdef class Lighting:
    cdef readonly double[:, ::1] lamps
    cdef readonly double[::1] ambient, top, horizon
    cdef readonly bint sky
    cdef public bint local
    cdef public Py_ssize_t caster
    cdef double share
    cdef readonly unsigned char[::1] tones
    cdef double[:, ::1] seen
    cdef double[::1] up

    @cython.locals(place=double, along=double, right=Py_ssize_t, i=Py_ssize_t)
    cdef void look(self, double[:, ::1] cameras, Py_ssize_t n) noexcept nogil
    @cython.locals(shine=double, height=double, i=Py_ssize_t)
    cdef void light_up(
        self, double x, double y, double z, double[::1] normal, double[::1] out) noexcept nogil
    @cython.locals(dx=double, dy=double, dz=double, away=double, fade=double, along=double, cosine=double,
                   share=double)
    cdef double reaching(
        self, Py_ssize_t k, double x, double y, double z, double[::1] normal) noexcept nogil
    @cython.locals(at=double, most=Py_ssize_t)
    cdef unsigned char tone(self, double value) noexcept nogil
    @cython.locals(share=double)
    cdef void backdrop(self, double up, double[::1] out) noexcept nogil
