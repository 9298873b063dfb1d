# The core library: Eigen, nanoflann and TBB, no ROS. Included by the package and by src/core/CMakeLists.txt,
# which find Eigen first.
# TBB through pkg-config: Ubuntu 20.04 ships no CMake package for it.
find_package(PkgConfig REQUIRED)
pkg_check_modules(tbb REQUIRED IMPORTED_TARGET tbb)

set(core_dir "${CMAKE_CURRENT_LIST_DIR}")

add_library(
  ${PROJECT_NAME}_core
  ${core_dir}/alignment_kernel.cpp
  ${core_dir}/ambiguity.cpp
  ${core_dir}/boundary.cpp
  ${core_dir}/boundary_kernel.cpp
  ${core_dir}/boundary_matcher.cpp
  ${core_dir}/boundary_table.cpp
  ${core_dir}/candidate_search.cpp
  ${core_dir}/candidate_verification.cpp
  ${core_dir}/canonical_pose.cpp
  ${core_dir}/dbscan.cpp
  ${core_dir}/depth_noise.cpp
  ${core_dir}/detection_message.cpp
  ${core_dir}/detector.cpp
  ${core_dir}/detector_config.cpp
  ${core_dir}/draw_kernel.cpp
  ${core_dir}/evidence_climb.cpp
  ${core_dir}/explanation.cpp
  ${core_dir}/look_alikes.cpp
  ${core_dir}/mismatch.cpp
  ${core_dir}/model_renderer.cpp
  ${core_dir}/neighbor_search.cpp
  ${core_dir}/normal_kernel.cpp
  ${core_dir}/normals.cpp
  ${core_dir}/orbits.cpp
  ${core_dir}/organised_image.cpp
  ${core_dir}/outline.cpp
  ${core_dir}/pair_kernel.cpp
  ${core_dir}/parallel.cpp
  ${core_dir}/pca.cpp
  ${core_dir}/percent.cpp
  ${core_dir}/points_image.cpp
  ${core_dir}/pose_clustering.cpp
  ${core_dir}/pose_covariance.cpp
  ${core_dir}/pose_errors.cpp
  ${core_dir}/pose_information.cpp
  ${core_dir}/pose_refinement.cpp
  ${core_dir}/pose_report.cpp
  ${core_dir}/pose_verdict.cpp
  ${core_dir}/ppf.cpp
  ${core_dir}/ppf_matcher.cpp
  ${core_dir}/ppf_model.cpp
  ${core_dir}/range_image.cpp
  ${core_dir}/reliability.cpp
  ${core_dir}/sample_balance.cpp
  ${core_dir}/selection.cpp
  ${core_dir}/self_distance.cpp
  ${core_dir}/sparse_fit.cpp
  ${core_dir}/surface_discrepancy.cpp
  ${core_dir}/surface_sampling.cpp
  ${core_dir}/symmetry.cpp
  ${core_dir}/symmetry_axes.cpp
  ${core_dir}/symmetry_check.cpp
  ${core_dir}/symmetry_search.cpp
  ${core_dir}/unreliable_reason.cpp
  ${core_dir}/verification.cpp
  ${core_dir}/viewpoints.cpp
  ${core_dir}/vote_kernel.cpp)
target_include_directories(${PROJECT_NAME}_core PUBLIC "${core_dir}/../../include")
target_link_libraries(${PROJECT_NAME}_core PUBLIC Eigen3::Eigen PRIVATE PkgConfig::tbb)

# Vectorised for several instruction sets, with the same results on each: hence no fused operations.
# They share no type with the rest whose layout depends on the instruction set.
set(kernel_flags -ffp-contract=off -fno-math-errno -fno-trapping-math -Wno-psabi)
set_source_files_properties(
  ${core_dir}/alignment_kernel.cpp ${core_dir}/boundary_kernel.cpp ${core_dir}/draw_kernel.cpp
  ${core_dir}/normal_kernel.cpp ${core_dir}/pair_kernel.cpp ${core_dir}/vote_kernel.cpp
  PROPERTIES COMPILE_OPTIONS "${kernel_flags}")
set_source_files_properties(${core_dir}/boundary_table.cpp ${core_dir}/ppf.cpp
                            PROPERTIES COMPILE_OPTIONS -ffp-contract=off)
