# SCABO_SICONOS: solvers of Siconos (compare/siconos.hpp), from Debian's libsiconos-numerics-dev, which has no CMake package.
if(SCABO_SICONOS)
  find_path(SCABO_SICONOS_INCLUDE SiconosConfig.h PATH_SUFFIXES siconos)
  find_library(SCABO_SICONOS_NUMERICS siconos_numerics)
  mark_as_advanced(SCABO_SICONOS_INCLUDE SCABO_SICONOS_NUMERICS)
  if(NOT SCABO_SICONOS_INCLUDE OR NOT SCABO_SICONOS_NUMERICS)
    message(FATAL_ERROR "SCABO_SICONOS needs libsiconos-numerics-dev, which was not found.\n"
                        "Install it, or configure with -DSCABO_SICONOS=OFF.")
  endif()
  target_compile_definitions(scabo_compare PRIVATE SCABO_SICONOS)
  target_include_directories(scabo_compare SYSTEM PRIVATE ${SCABO_SICONOS_INCLUDE} ${SCABO_SICONOS_INCLUDE}/numerics)
  target_link_libraries(scabo_compare PRIVATE ${SCABO_SICONOS_NUMERICS})
endif()
