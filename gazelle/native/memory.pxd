# What memory.py says, for compiled modules.

cdef inline double* floats(size_t address) noexcept nogil:
    return <double*>address


cdef inline float* singles(size_t address) noexcept nogil:
    return <float*>address


cdef inline int* integers(size_t address) noexcept nogil:
    return <int*>address


cdef inline long long* longs(size_t address) noexcept nogil:
    return <long long*>address


cdef inline size_t word(size_t address) noexcept nogil:
    return (<size_t*>address)[0]


ctypedef void (*Two)(size_t, size_t) noexcept nogil
ctypedef void (*Four)(size_t, size_t, int, size_t) noexcept nogil
ctypedef void (*Five)(size_t, size_t, size_t, size_t, int) noexcept nogil


cdef inline void call_two(size_t function, size_t a, size_t b) noexcept nogil:
    (<Two>function)(a, b)


cdef inline void call_four(size_t function, size_t a, size_t b, int c, size_t d) noexcept nogil:
    (<Four>function)(a, b, c, d)


cdef inline void call_five(
    size_t function, size_t a, size_t b, size_t c, size_t d, int e
) noexcept nogil:
    (<Five>function)(a, b, c, d, e)


ctypedef double (*Ray)(
    size_t, size_t, size_t, size_t, size_t, unsigned char, int, size_t, size_t) noexcept nogil


cdef inline double call_ray(
    size_t function, size_t a, size_t b, size_t c, size_t d, size_t e, unsigned char f, int g,
    size_t h, size_t i
) noexcept nogil:
    return (<Ray>function)(a, b, c, d, e, f, g, h, i)
