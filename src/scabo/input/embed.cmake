# Puts schema.json into scabo_input.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/schema.json)
file(READ ${CMAKE_CURRENT_LIST_DIR}/schema.json SCABO_MODEL_SCHEMA)
configure_file(${CMAKE_CURRENT_LIST_DIR}/schema.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/input/schema.cpp @ONLY)
target_sources(scabo_input PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/input/schema.cpp)
