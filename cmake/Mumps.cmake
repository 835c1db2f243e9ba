# SCABO_MUMPS: MUMPS as another library for sparse factorisations (linalg/mumps_factor.cpp). Like Gmsh's library, it is
# loaded when a model asks for it, not linked.
scabo_loaded_library(SCABO_MUMPS "MUMPS without MPI" header dmumps_c.h library dmumps_seq package libmumps-seq-dev group mumps)
