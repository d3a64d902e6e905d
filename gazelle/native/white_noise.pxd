cimport cython

cdef extern from *:
    """
    #include <string.h>
    static inline unsigned long long gazelle_bits(double x) {
        unsigned long long b; memcpy(&b, &x, sizeof b); return b;
    }
    static inline double gazelle_double(unsigned long long b) {
        double x; memcpy(&x, &b, sizeof x); return x;
    }
    """
    unsigned long long gazelle_bits(double value) noexcept nogil
    double gazelle_double(unsigned long long bits) noexcept nogil


cdef double uniform_of(
    unsigned long long key, unsigned long long place) noexcept nogil
@cython.locals(large=cython.bint)
cdef double logarithm(double value) noexcept nogil
@cython.locals(pairs=Py_ssize_t)
cdef void fill_normal(
    unsigned long long key, unsigned long long start, Py_ssize_t size, double[::1] drawn,
    double[::1] angles) noexcept nogil
cpdef void draw_uniform(
    unsigned long long[::1] keys, unsigned long long[::1] counters, double[:, ::1] drawn) noexcept
@cython.locals(k=Py_ssize_t)
cpdef void draw_normal(
    unsigned long long[::1] keys, unsigned long long[::1] counters, Py_ssize_t size,
    double[:, ::1] drawn, double[::1] row, double[::1] room) noexcept
