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
@cython.locals(pairs=Py_ssize_t, large=cython.bint)
cdef void fill_normal(
    unsigned long long key, unsigned long long start, Py_ssize_t size,
    double[::1] drawn) noexcept nogil
cpdef void draw_uniform(
    unsigned long long[:] keys, unsigned long long[:] counters, double[:, ::1] drawn) noexcept
cpdef void draw_normal(
    unsigned long long[:] keys, unsigned long long[:] counters, Py_ssize_t size,
    double[:, ::1] drawn) noexcept
