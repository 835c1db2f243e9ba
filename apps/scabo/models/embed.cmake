# Puts the models of `scabo new` into the program.
set(models_dir ${CMAKE_CURRENT_LIST_DIR})
foreach(kind beam dam wall hertz crack growth earthquake axisymmetric part3d)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${models_dir}/${kind}.yaml)
  file(READ ${models_dir}/${kind}.yaml SCABO_MODEL_${kind})
endforeach()
configure_file(${models_dir}/models.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/models.cpp @ONLY)
target_sources(scabo_command_line PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/models.cpp)
target_include_directories(scabo_command_line PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
