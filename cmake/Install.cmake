# What `make build` builds and `cmake --install` installs:
#   bin/scabo, lib/libscabo, include/scabo/<part>/*.hpp, lib/cmake/scabo (find_package(scabo)),
#   share/scabo/model.schema.json, share/scabo/examples, share/scabo/scabo_plot (pictures), scabo_report and
#   report_template.html (reports), share/doc/scabo,
#   share/man/man1/scabo.1, completion for bash, zsh and fish.
#   the Python package (python/CMakeLists.txt).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/scabo)

install(TARGETS scabo EXPORT scaboTargets)
install(DIRECTORY src/scabo TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp")

# A static library hands its own dependencies on; a shared one only Eigen, which its headers include.
get_target_property(library_type scabo TYPE)
if(library_type STREQUAL STATIC_LIBRARY)
  set(SCABO_STATIC ON)
  install(FILES cmake/NumericalLibraries.cmake DESTINATION ${package_dir})
else()
  set(SCABO_STATIC OFF)
endif()
install(EXPORT scaboTargets NAMESPACE scabo:: DESTINATION ${package_dir})
configure_package_config_file(cmake/scaboConfig.cmake.in ${PROJECT_BINARY_DIR}/cmake/scaboConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/scaboConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cmake/scaboConfig.cmake
              ${PROJECT_BINARY_DIR}/cmake/scaboConfigVersion.cmake DESTINATION ${package_dir})

# The program finds a shared library beside itself.
file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(scabo_program PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
install(TARGETS scabo_program)
if(SCABO_MPI_FOUND)
  set_target_properties(scabo_mpi PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
  install(TARGETS scabo_mpi)
endif()

set(schema ${PROJECT_BINARY_DIR}/model.schema.json)
add_custom_command(OUTPUT ${schema} COMMAND scabo_program schema > ${schema} DEPENDS scabo_program VERBATIM)
install(FILES ${schema} DESTINATION ${CMAKE_INSTALL_DATADIR}/scabo)

# Texts that the program writes about itself: `scabo ARGUMENTS... > FILE`, installed in FOLDER under NAME.
set(own_texts "")
function(scabo_own_text folder name)
  set(file ${PROJECT_BINARY_DIR}/own_texts/${folder}/${name})
  get_filename_component(place ${file} DIRECTORY)
  file(MAKE_DIRECTORY ${place})
  add_custom_command(OUTPUT ${file} COMMAND scabo_program ${ARGN} > ${file} DEPENDS scabo_program VERBATIM)
  install(FILES ${file} DESTINATION ${folder})
  set(own_texts ${own_texts} ${file} PARENT_SCOPE)
endfunction()
scabo_own_text(${CMAKE_INSTALL_MANDIR}/man1 scabo.1 manual)
scabo_own_text(${CMAKE_INSTALL_DATADIR}/bash-completion/completions scabo completion bash)
scabo_own_text(${CMAKE_INSTALL_DATADIR}/zsh/site-functions _scabo completion zsh)
scabo_own_text(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d scabo.fish completion fish)
add_custom_target(product ALL DEPENDS scabo scabo_program ${schema} ${own_texts})
if(SCABO_MPI_FOUND)
  add_dependencies(product scabo_mpi)
endif()

install(DIRECTORY python/scabo/plot/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scabo/scabo_plot FILES_MATCHING PATTERN "*.py")

install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/scabo
        PATTERN "*.results" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY docs TYPE DOC PATTERN "site" EXCLUDE PATTERN "__pycache__" EXCLUDE)  # as beside README.md, whose links then lead there
install(FILES cmake/copyright TYPE DOC)  # where Debian looks for it
install(FILES README.md ARCHITECTURE.md CHANGELOG.md CITATION.cff LICENSE TYPE DOC)
