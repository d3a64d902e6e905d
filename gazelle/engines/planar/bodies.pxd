cdef class Bodies:
    cdef public Py_ssize_t nbody, nworld
    cdef public double dt, widest
    cdef public bint euler, sweep
    cdef public double[:, ::1] rows, goal, command, velocity
    cdef public double[:, ::1] kinds, drives, pieces, corners, visuals
    cdef public double[:, ::1] statics, lanes
    cdef public double[::1] grid, near_grid
    cdef public int[::1] start, items, near_start, near_items, follow, cell
    cdef public int[:, ::1] head
    cdef public signed char[::1] state
    cdef public unsigned char[::1] stalled
    cdef public double[::1] way
    cdef public double[:, ::1] memory
