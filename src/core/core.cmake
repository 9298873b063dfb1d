# The core library: Eigen, nanoflann and TBB, no ROS. Included by the package and by src/core/CMakeLists.txt.
# TBB through pkg-config: Ubuntu 20.04 ships no CMake package for it.
find_package(Eigen3 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(tbb REQUIRED IMPORTED_TARGET tbb)

set(core_dir "${CMAKE_CURRENT_LIST_DIR}")
get_filename_component(package_root "${core_dir}/../.." ABSOLUTE)

add_library(ppf_bin_picking_core
  ${core_dir}/detector_config.cpp
  ${core_dir}/symmetry.cpp)
target_include_directories(ppf_bin_picking_core PUBLIC "${package_root}/include")
target_link_libraries(ppf_bin_picking_core PUBLIC Eigen3::Eigen PRIVATE PkgConfig::tbb)
