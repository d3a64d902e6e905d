cdef extern from "processor.h":
    int gazelle_has_avx2() noexcept nogil
