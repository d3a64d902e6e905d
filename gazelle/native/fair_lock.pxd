cdef extern from "pythread.h":
    unsigned long get_ident "PyThread_get_thread_ident" ()

cdef extern from "Python.h":
    int check_signals "PyErr_CheckSignals" () except -1


cdef class Turn:
    cdef unsigned long thread
    cdef object work
    cdef object granted


cdef class FairLock:
    cdef readonly unsigned long owner
    cdef readonly object waiting
    cdef public bint closed
    cdef Py_ssize_t depth
    cdef object _enter(self)
    cdef object _take(self)
    cdef object _drop(self)
    cdef object _wait(self, Turn turn)
    cdef object _pass_on(self)
