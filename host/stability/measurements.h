// What the cases measure, one function each, in the order of the table (cases.cpp).
#pragma once

#include "stability/suite.h"
#include "stability/traced_scene.h"

namespace pellucid::stability {

// rehits.cpp: 1
void spawned_rays_leave(const Lab& lab, Findings& findings);
// leaks.cpp: 2
void closed_meshes_are_tight(const Lab& lab, Findings& findings);
// known_values.cpp: 3, 11, 12, 13, 24
void light_through_glass_is_found_or_told(const Lab& lab, Findings& findings);
void small_lights_keep_their_power(const Lab& lab, Findings& findings);
void roughness_goes_to_zero_smoothly(const Lab& lab, Findings& findings);
void panes_let_through_what_they_must(const Lab& lab, Findings& findings);
void long_paths_lose_nothing(const Lab& lab, Findings& findings);
// all_scenes.cpp: 4
void nothing_is_dropped(const Lab& lab, Findings& findings);
// roulette.cpp: 24, called by known_values.cpp
void roulette_changes_no_mean(const Lab& lab, Findings& findings);
// float_modes.cpp: 5
void relaxed_modes_keep_the_picture(const Lab& lab, Findings& findings);
// strategies.cpp: 6
void strategies_agree(const Lab& lab, Findings& findings);
// wild_weights.cpp: 7
void weights_stay_in_range(const Lab& lab, Findings& findings);
// shading_normals.cpp: 8
void shading_normals_are_symmetric(const Lab& lab, Findings& findings);
// rigid.cpp: 9, 31
void far_away_is_as_near(const Lab& lab, Findings& findings);
void mirrored_is_the_same(const Lab& lab, Findings& findings);
// exact.cpp: 10, 19, 22
void scale_changes_no_bit(const Lab& lab, Findings& findings);
void short_buffers_drop_nothing(const Lab& lab, Findings& findings);
void work_groups_change_no_bit(const Lab& lab, Findings& findings);
// fireflies.cpp: 14
void near_vertices_make_no_fireflies(const Lab& lab, Findings& findings);
// thin_glass.cpp: 15
void thin_panes_let_light_through(const Lab& lab, Findings& findings);
// thin_walls.cpp: 16
void merging_stays_on_its_side(const Lab& lab, Findings& findings);
// merge_radius.cpp: 17
void radius_shrinks_by_its_law(const Lab& lab, Findings& findings);
// photon_cloud.cpp: 18
void photons_are_found_once(const Lab& lab, Findings& findings);
// splats.cpp: 20
void splats_fall_where_rays_come_from(const Lab& lab, Findings& findings);
// film_sums.cpp: 21
void sums_never_stall(const Lab& lab, Findings& findings);
// noise.cpp: 23
void noise_is_independent(const Lab& lab, Findings& findings);
// explained.cpp: 25
void faults_are_named(const Lab& lab, Findings& findings);
// file_scales.cpp: 10, called by exact.cpp
void files_have_no_scale(const Lab& lab, Findings& findings);
// degenerate.cpp: 26
void degenerate_triangles_do_no_harm(const Lab& lab, Findings& findings);
// coplanar.cpp: 27
void coplanar_faces_do_no_harm(const Lab& lab, Findings& findings);
// traversal.cpp: 28
void traversal_misses_nothing(const Lab& lab, Findings& findings);
// quadrics.cpp: 29
void spheres_stay_round(const Lab& lab, Findings& findings);
// frames.cpp: 33
void frames_and_directions_do_not_drift(const Lab& lab, Findings& findings);
// extreme_cameras.cpp: 35
void cameras_keep_their_rays(const Lab& lab, Findings& findings);
// image_files.cpp: 36
void files_keep_values(const Lab& lab, Findings& findings);
// hangs.cpp: 37
void everything_ends(const Lab& lab, Findings& findings);
// many_lights.cpp: 38
void lights_add_up(const Lab& lab, Findings& findings);

// Parts of these in one way to build the traversal, for tests that try them all, and whether all
// ways give the same bits.
void aimed_rays_hit(const Lab& lab, Findings& findings, const RayConfig& config);
void lowest_of_duplicates_wins(const Lab& lab, Findings& findings, const RayConfig& config);
void layouts_agree(const Lab& lab, Findings& findings);

}  // namespace pellucid::stability
