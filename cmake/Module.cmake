# pellucid_module(name SOURCES ... DEPS ...): a static library per folder of host/, linked to exactly
# the modules it may see. tests/lint/check_floors.cmake enforces the same edges on every #include.
function(pellucid_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_library(pellucid_${name} STATIC ${ARG_SOURCES})
  target_include_directories(pellucid_${name} PUBLIC ${CMAKE_SOURCE_DIR}/host
                                                     ${CMAKE_SOURCE_DIR}/kernels)
  target_link_libraries(pellucid_${name} PUBLIC ${ARG_DEPS} PRIVATE pellucid_options)
endfunction()
