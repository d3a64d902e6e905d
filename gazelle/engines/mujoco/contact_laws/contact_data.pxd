cdef struct Touch:
    # Of a step.
    size_t model, data, users, velocities, references, all_terms, jacobians
    double step, weight
    bint cone, sparse
    double *before
    # Of a contact.
    size_t contact
    int dim, row, width
    int *geoms
    int *columns
    double *frame
    double *friction
    double *velocity
    double *reference
    double *terms
    double *jacobian
