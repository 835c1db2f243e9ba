# `make package`: a .deb of everything that is installed. The libraries it needs are found by dpkg-shlibdeps; pictures need
# Python with Matplotlib, which apt installs unless told otherwise.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scabo)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Scabo maintainers <maintainers@scabo.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "frictional contact by the scaled boundary finite element method")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, python3-numpy")
if(SCABO_PYTHON_MODULE_FOUND)  # the extension module is for one version of Python
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next})")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview")
string(JOIN "\n" CPACK_PACKAGE_DESCRIPTION
       "Scabo computes where joints between elastic bodies in the plane open,"
       "stick and slip, and which forces they transmit. Every increment is"
       "certified. With headers and a static library for C++ programs.")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package_files.cmake)
include(CPack)
