# The simulated bin and depth camera: Bullet, Embree and the core's types, no ROS. Only the simulator's programs link it.
# Embree by its files: the CMake package of Ubuntu 20.04 defines no target.
find_path(embree_include_dir embree3/rtcore.h)
find_library(embree_library embree3)
if(NOT embree_include_dir OR NOT embree_library)
  message(FATAL_ERROR "Embree 3 is missing: install libembree-dev, or run scripts/setup")
endif()
# Bullet through pkg-config: its CMake package names folders of the machine that built it.
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet)

set(sim_dir "${CMAKE_CURRENT_LIST_DIR}")
add_library(
  ${PROJECT_NAME}_sim
  ${sim_dir}/bin.cpp
  ${sim_dir}/bullet_shapes.cpp
  ${sim_dir}/cell_layout.cpp
  ${sim_dir}/convex_hull.cpp
  ${sim_dir}/convex_hulls.cpp
  ${sim_dir}/cut_planes.cpp
  ${sim_dir}/depth_camera.cpp
  ${sim_dir}/depth_sensor.cpp
  ${sim_dir}/hull_cache.cpp
  ${sim_dir}/mass_properties.cpp
  ${sim_dir}/part_pile.cpp
  ${sim_dir}/pick_judge.cpp
  ${sim_dir}/pile_drop.cpp
  ${sim_dir}/pile_world.cpp
  ${sim_dir}/random.cpp
  ${sim_dir}/ray_caster.cpp
  ${sim_dir}/simulated_cell.cpp
  ${sim_dir}/triangle_points.cpp
  ${sim_dir}/void_search.cpp)
target_include_directories(${PROJECT_NAME}_sim PRIVATE ${embree_include_dir})
target_link_libraries(${PROJECT_NAME}_sim PUBLIC ${PROJECT_NAME}_core PRIVATE ${embree_library}
                                                                              PkgConfig::bullet)
