# Tests on the twin (the kernel core as C++): the same sources once with real = float, once with
# double; and tests of the BVH and of packing. Included by tests/CMakeLists.txt.
set(support_dir ${CMAKE_CURRENT_LIST_DIR}/../support)

# fma as one instruction: without it every fma is a library call. The bits are the same either way.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-march=native PELLUCID_HAS_MARCH_NATIVE)
set(twin_flags $<$<BOOL:${PELLUCID_HAS_MARCH_NATIVE}>:-march=native>)

add_library(pellucid_test_support STATIC
  ${support_dir}/audit_scenes.cpp
  ${support_dir}/bsdf_cases.cpp
  ${support_dir}/double_twin.cpp
  ${support_dir}/path_log_double.cpp
  ${support_dir}/path_log_float.cpp
  ${support_dir}/statistics.cpp)
target_include_directories(pellucid_test_support PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(pellucid_test_support
  PUBLIC pellucid_stability pellucid_pack pellucid_scene pellucid_bvh PRIVATE pellucid_options)
target_compile_options(pellucid_test_support PRIVATE ${twin_flags})
set_source_files_properties(${support_dir}/double_twin.cpp ${support_dir}/path_log_double.cpp
  PROPERTIES COMPILE_DEFINITIONS PELLUCID_REAL=double)
set_source_files_properties(${support_dir}/path_log_float.cpp
  PROPERTIES COMPILE_DEFINITIONS "PELLUCID_REAL=float;PELLUCID_REAL_IS_FLOAT=1")

function(pellucid_twin_executable name prefix)
  add_executable(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
  target_link_libraries(${name} PRIVATE pellucid_test_support GTest::gtest_main pellucid_options)
  gtest_discover_tests(${name} TEST_PREFIX "${prefix}" PROPERTIES LABELS unit TIMEOUT 600)
endfunction()

file(GLOB twin_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/twin_*_test.cpp)
file(GLOB film_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/film_*_test.cpp)
file(GLOB pack_sources CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/bvh_*_test.cpp ${CMAKE_CURRENT_LIST_DIR}/pack_*_test.cpp)

pellucid_twin_executable(twin_float_tests "float." ${twin_sources} ${film_sources})
target_compile_definitions(twin_float_tests PRIVATE PELLUCID_REAL=float PELLUCID_REAL_IS_FLOAT=1)
pellucid_twin_executable(twin_double_tests "double." ${twin_sources})
target_compile_definitions(twin_double_tests PRIVATE PELLUCID_REAL=double)

# The walks of `bdpt`: all its strategies, their weights, and what is stored of them.
file(GLOB audit_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/audit_*_test.cpp)
pellucid_twin_executable(audit_float_tests "float." ${audit_sources})
target_compile_definitions(audit_float_tests PRIVATE PELLUCID_REAL=float PELLUCID_REAL_IS_FLOAT=1
  TWIN_CONNECT=1)
pellucid_twin_executable(audit_double_tests "double." ${audit_sources})
target_compile_definitions(audit_double_tests PRIVATE PELLUCID_REAL=double TWIN_CONNECT=1)

# The same with merges as in `vcm`: weights, and what is stored of vertices.
set(merge_sources audit_weights_test.cpp audit_partials_test.cpp audit_vertex_test.cpp
    audit_compact_test.cpp)
list(TRANSFORM merge_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
pellucid_twin_executable(audit_merge_float_tests "float.merge." ${merge_sources})
target_compile_definitions(audit_merge_float_tests PRIVATE PELLUCID_REAL=float
  PELLUCID_REAL_IS_FLOAT=1 TWIN_CONNECT=1 TWIN_MERGE=1)
pellucid_twin_executable(audit_merge_double_tests "double.merge." ${merge_sources})
target_compile_definitions(audit_merge_double_tests PRIVATE PELLUCID_REAL=double TWIN_CONNECT=1
  TWIN_MERGE=1)

# Merges alone, as in `bpm`: weights.
pellucid_twin_executable(audit_bpm_float_tests "float.bpm."
  ${CMAKE_CURRENT_LIST_DIR}/audit_weights_test.cpp)
target_compile_definitions(audit_bpm_float_tests PRIVATE PELLUCID_REAL=float
  PELLUCID_REAL_IS_FLOAT=1 TWIN_MERGE=1)
pellucid_twin_executable(audit_bpm_double_tests "double.bpm."
  ${CMAKE_CURRENT_LIST_DIR}/audit_weights_test.cpp)
target_compile_definitions(audit_bpm_double_tests PRIVATE PELLUCID_REAL=double TWIN_MERGE=1)

foreach(twin twin_float_tests twin_double_tests audit_float_tests audit_double_tests
        audit_merge_float_tests audit_merge_double_tests audit_bpm_float_tests
        audit_bpm_double_tests)
  target_compile_options(${twin} PRIVATE ${twin_flags})
endforeach()
pellucid_twin_executable(pack_tests "" ${pack_sources})
