# OpenBLAS provides BLAS and LAPACK; LAPACKE, CHOLMOD and UMFPACK use it; HDF5 reads and writes files, PNG reads images,
# ISA-L compresses fields. None of them has a CMake package on every Debian and Ubuntu (FindHDF5 of CMake fails in a project without C), so each becomes the target
# scabo::<name> here. The file is installed beside scaboConfig.cmake, because a static Scabo needs the same targets.
set(SCABO_NUMERICAL_LIBRARIES_MISSING "")
# A target with the property SCABO_LIBRARIES_INSIDE contains those that take long to load, where the files named here are
# installed: the shared HDF5 loads forty other libraries, for files on other hosts, and OpenBLAS, LAPACKE, CHOLMOD and UMFPACK
# have 16,000 symbols to look up (docs/decisions/0068-time-to-build-and-to-start.md).
set(SCABO_INSIDE_openblas libopenblas.a libgfortran.so.5)
set(SCABO_INSIDE_lapacke liblapacke.a)
set(SCABO_INSIDE_cholmod libcholmod.a libamd.a libcolamd.a libccolamd.a libcamd.a libsuitesparseconfig.a libmetis.so.5 libgomp.so.1)
set(SCABO_INSIDE_umfpack libumfpack.a)
set(SCABO_INSIDE_hdf5 libhdf5.a|libhdf5_serial.a libsz.so libz.so)
foreach(name umfpack cholmod lapacke openblas hdf5 png isal)
  string(TOUPPER SCABO_${name} variable)
  find_library(${variable} NAMES ${name} ${name}_serial)  # Debian calls HDF5 without MPI hdf5_serial
  mark_as_advanced(${variable})
  if(NOT ${variable})
    list(APPEND SCABO_NUMERICAL_LIBRARIES_MISSING ${name})
    continue()
  elseif(TARGET scabo::${name})
    continue()
  endif()
  set(inside $<BOOL:$<TARGET_PROPERTY:SCABO_LIBRARIES_INSIDE>>)
  set(shared "$<$<NOT:${inside}>:${${variable}}>")
  set(contained "")
  foreach(file IN LISTS SCABO_INSIDE_${name})
    string(REPLACE "|" ";" names ${file})
    find_library(SCABO_${file} NAMES ${names})
    mark_as_advanced(SCABO_${file})
    list(APPEND contained "$<${inside}:${SCABO_${file}}>")
  endforeach()
  if(contained STREQUAL "" OR contained MATCHES NOTFOUND)
    set(shared ${${variable}})
    set(contained "")
  endif()
  add_library(scabo::${name} INTERFACE IMPORTED)
  set_target_properties(scabo::${name} PROPERTIES INTERFACE_LINK_LIBRARIES "${shared};${contained}")
endforeach()
