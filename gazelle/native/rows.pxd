# What rows.py says, for compiled modules.

cdef inline double* start(double[:, ::1] array) noexcept nogil:
    return &array[0, 0] if array.shape[0] and array.shape[1] else NULL


cdef inline double* block_start(double[:, :, ::1] array) noexcept nogil:
    return &array[0, 0, 0] if array.shape[0] and array.shape[1] and array.shape[2] else NULL


cdef inline double* column(double[::1] array) noexcept nogil:
    return &array[0] if array.shape[0] else NULL


cdef inline double* offset(double* numbers, Py_ssize_t first) noexcept nogil:
    return numbers + first


cdef inline unsigned char* bytes_start(unsigned char[:, ::1] array) noexcept nogil:
    return &array[0, 0] if array.shape[0] and array.shape[1] else NULL


cdef inline unsigned char* bytes_offset(unsigned char* numbers, Py_ssize_t first) noexcept nogil:
    return numbers + first


cdef inline Py_ssize_t* places_column(Py_ssize_t[::1] array) noexcept nogil:
    return &array[0] if array.shape[0] else NULL
