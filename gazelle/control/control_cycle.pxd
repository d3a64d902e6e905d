cimport cython

from gazelle.control.control_law cimport ControlLaw
from gazelle.control.joint_law cimport JointLaw
from gazelle.native.joint_system cimport JointSystem

cdef class ControlCycle(JointSystem):
    cdef JointLaw hardware
    cdef list laws
    cdef long long[::1] table
    cdef readonly object updated_ns, written_ns
    cdef long long[::1] updated, written
    cdef long long period, step
    cdef Py_ssize_t nworld
    @cython.locals(w=Py_ssize_t, last_update="long long", last_write="long long")
    cpdef begin(self, long long updated, long long written)
    @cython.locals(w=Py_ssize_t, updated="long long", written="long long")
    cpdef tuple times(self)
    @cython.locals(before="long long", written="long long", passed="long long", since="long long")
    cdef void advance(self, Py_ssize_t world, double* measured, double* rates, long long time) noexcept nogil
    @cython.locals(index=Py_ssize_t, place="void*")
    cdef void control(self, Py_ssize_t world, long long time, double period) noexcept nogil
