cdef struct Places:
    size_t ncon, ne, nf, contact, kind, owner, softness, stiffness, frictionloss, userdata
    size_t mocap_pos, mocap_quat
    size_t nisland, to_island, island_softness, island_stiffness
    size_t bias, applied, constraint, smooth, acceleration, rownnz, rowadr, colind, jacobian
    size_t velocity, reference, qpos, qvel, warmstart, passive, xmat, geom_xmat, geom_xpos, xaxis
    size_t cdof, cvel, terms, contact_size, contact_dist, contact_frame, contact_margin
    size_t contact_pos, contact_friction, contact_mu, contact_solref, contact_solreffriction
    size_t contact_dim, contact_geom, contact_address, model_nv, model_njnt, model_nnumeric
    size_t model_numeric, model_timestep, model_gravity, model_cone, model_impratio
    size_t model_bodyid, model_rootid, model_parentid, model_dofnum, model_dofadr
    size_t model_dof_parentid, model_jntadr, model_jntnum, model_jnt_type, model_jnt_bodyid
    size_t model_jnt_dofadr, model_inertia, model_iquat, model_gravcomp, model_nuser_geom
    size_t model_geom_user, model_geom_size


cdef Places AT
