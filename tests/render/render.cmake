# Render tests: closed forms, equality of methods, exact invariances, goldens. Included by
# tests/CMakeLists.txt; PELLUCID_TIER=full narrows the verdicts from +-1.5 % to +-0.5 %.
set(render_dir ${CMAKE_SOURCE_DIR}/tests/render)
set(render_sources ${CMAKE_SOURCE_DIR}/tests/support/statistics.cpp
    ${CMAKE_SOURCE_DIR}/tests/support/facets.cpp)
foreach(name render_harness closed_form_cases closed_form_sheets closed_form_test equality equality_test
             depth_cut_test error_test exact_test footprint_test furnace_merge_test
             passes_test rigid_test texture_test golden_test filter_test aov_test layers_test
             light_test merging_test photons_test reciprocity_test replay_test study_test twin_device_test
             vertices_test)
  list(APPEND render_sources ${render_dir}/${name}.cpp)
endforeach()
pellucid_gtest(render_tests render
  SOURCES ${render_sources}
  DEPS pellucid_study pellucid_stability pellucid_integrators pellucid_scene pellucid_image pellucid_test_support fmt::fmt)
target_include_directories(render_tests PRIVATE ${render_dir})

pellucid_script_test(threads render ${render_dir}/threads_test.py $<TARGET_FILE:pellucid>)

add_test(NAME slow.render_full
         COMMAND render_tests --gtest_filter=*ClosedForm*:*Equality*:*Rigid*:*Golden*:*TwinDevice*)
# 34 minutes where seven others were at work.
add_test(NAME slow.render_full_merging
         COMMAND render_tests --gtest_filter=Merging*:FurnaceMerge*:Sobol.*)
# How often --error keeps its word: 200 renders of each method and scene; prints its figures.
add_test(NAME slow.error_coverage COMMAND render_tests --gtest_filter=ErrorCoverage.*)
set_tests_properties(slow.render_full slow.render_full_merging slow.error_coverage PROPERTIES LABELS slow TIMEOUT 3600
                     ENVIRONMENT PELLUCID_TIER=full)
