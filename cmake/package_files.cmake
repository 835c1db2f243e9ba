# What Debian's policy asks of a package beyond what is installed: a compressed manual page, a changelog, and modules for
# Python where Debian's Python looks below /usr. CPack runs this on the files that it is about to pack.
find_program(gzip gzip REQUIRED)
set(share ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changelog ${share}/doc/${CPACK_PACKAGE_NAME}/changelog)
file(WRITE ${changelog} "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Release ${CPACK_PACKAGE_VERSION}; CHANGELOG.md in this folder lists what has changed.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(GLOB pages ${share}/man/man1/*.1)
execute_process(COMMAND ${gzip} -9 -n -f ${changelog} ${pages} COMMAND_ERROR_IS_FATAL ANY)

file(GLOB modules ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/lib/python3.*/dist-packages/scabo)
if(modules)
  set(packages ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/lib/python3/dist-packages)
  file(MAKE_DIRECTORY ${packages})
  file(RENAME ${modules} ${packages}/scabo)
  get_filename_component(folder ${modules}/../.. ABSOLUTE)
  file(REMOVE_RECURSE ${folder})
endif()

# `scabo-mpi` needs PETSc and an MPI, which few who install the package want: 410 MB.
file(REMOVE ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/bin/scabo-mpi)
