# SCABO_REPORT: the page that `scabo report` fills (report/), built by npm and Vite. AUTO: if Node.js 18 or newer and npm are
# found (cmake/install_packages.sh report), and no sanitizer is in use; if npm cannot fetch its packages, the build goes on
# without. The packages are fetched once, those of package-lock.json.
#   ${SCABO_BUILD_DATA}/report_template.html    beside the program, as it is installed in share/scabo
#   python/scabo/report/template.html           in the Python package of the build
scabo_optional(SCABO_REPORT "The page of scabo report (nodejs, npm)")
set(why_not "")
if(SCABO_REPORT STREQUAL "AUTO" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(why_not "not with sanitizers")
elseif(SCABO_REPORT)
  find_program(SCABO_NODE NAMES node nodejs)
  find_program(SCABO_NPM npm)
  mark_as_advanced(SCABO_NODE SCABO_NPM)
  set(version "")
  if(SCABO_NODE)
    execute_process(COMMAND ${SCABO_NODE} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    string(REGEX REPLACE "^v" "" version "${version}")
  endif()
  if(NOT SCABO_NODE)
    set(why_not "Node.js was not found (nodejs)")
  elseif(version VERSION_LESS 18)
    set(why_not "${SCABO_NODE} is version '${version}', not 18 or newer")
  elseif(NOT SCABO_NPM)
    set(why_not "npm was not found (npm)")
  else()
    set(SCABO_REPORT_FOUND YES)
  endif()
endif()
if(why_not)
  scabo_not_built(SCABO_REPORT "The page for reports" "${why_not}")
endif()

set(report_page ${SCABO_BUILD_DATA}/report_template.html)
if(SCABO_REPORT_FOUND)
  set(SCABO_REPORT_MODULES ${PROJECT_BINARY_DIR}/report/node_modules)
  file(GLOB_RECURSE report_sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/report ${PROJECT_SOURCE_DIR}/report/src/*)
  list(APPEND report_sources index.html package.json package-lock.json tsconfig.json vite.config.ts)
  set(absolute ${report_sources})
  list(TRANSFORM absolute PREPEND ${PROJECT_SOURCE_DIR}/report/)
  string(REPLACE ";" "," listed "${report_sources}")
  add_custom_command(OUTPUT ${report_page} DEPENDS ${absolute} ${PROJECT_SOURCE_DIR}/cmake/build_report.cmake
                     COMMAND ${CMAKE_COMMAND} -DSOURCES=${listed} -DFROM=${PROJECT_SOURCE_DIR}/report -DIN=${PROJECT_BINARY_DIR}/report
                             -DNODE=${SCABO_NODE} -DNPM=${SCABO_NPM} -DPAGE=${report_page} -DMODE=${SCABO_REPORT}
                             -DCOPY=${PROJECT_BINARY_DIR}/python/scabo/report/template.html
                             -P ${PROJECT_SOURCE_DIR}/cmake/build_report.cmake
                     COMMENT "Building the page for reports" VERBATIM)
  add_custom_target(report_page DEPENDS ${report_page})
  add_dependencies(product report_page)
endif()
install(FILES ${report_page} DESTINATION ${CMAKE_INSTALL_DATADIR}/scabo OPTIONAL)
install(DIRECTORY python/scabo/report/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scabo/scabo_report FILES_MATCHING PATTERN "*.py"
        PATTERN "__pycache__" EXCLUDE)
