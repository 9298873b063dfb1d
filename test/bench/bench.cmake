# Programs that measure, run by hand. They are built with the tests, or with everything, so that they stay alive.
add_executable(measure_camera EXCLUDE_FROM_ALL test/bench/measure_camera.cpp)
target_include_directories(measure_camera PRIVATE test)
target_link_libraries(measure_camera ${PROJECT_NAME}_io ${PROJECT_NAME}_sim opencv_core
                      opencv_imgcodecs)
add_dependencies(tests measure_camera)

add_executable(measure_piles EXCLUDE_FROM_ALL test/bench/measure_piles.cpp)
target_include_directories(measure_piles PRIVATE test)
target_link_libraries(measure_piles PRIVATE ${PROJECT_NAME}_sim ${PROJECT_NAME}_io)
add_dependencies(tests measure_piles)

find_package(benchmark REQUIRED)
add_executable(measure_stages test/bench/bench_pile.cpp test/bench/measure_stages.cpp)
target_include_directories(measure_stages PRIVATE test)
target_compile_definitions(measure_stages PRIVATE PACKAGE_FOLDER="${PROJECT_SOURCE_DIR}")
target_link_libraries(measure_stages PRIVATE ${PROJECT_NAME}_io benchmark::benchmark)

# scripts/compare builds this one, where PCL's registration and OpenCV's contributed module are
# installed; nothing else needs them.
find_package(PCL QUIET COMPONENTS common features filters io registration)
find_library(surface_matching_library opencv_surface_matching)
if(TARGET pcl_registration AND surface_matching_library)
  set(compare_dir test/bench/compare)
  add_executable(
    compare_detectors EXCLUDE_FROM_ALL
    ${compare_dir}/compare_detectors.cpp ${compare_dir}/contained.cpp
    ${compare_dir}/opencv_peer.cpp ${compare_dir}/own_peer.cpp ${compare_dir}/pcl_peer.cpp
    ${compare_dir}/peers.cpp)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  target_compile_definitions(
    compare_detectors
    PRIVATE BUILD_TYPE="${CMAKE_BUILD_TYPE}"
            BUILD_FLAGS="${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}"
            BUILD_COMPILER="${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
  target_include_directories(compare_detectors SYSTEM PRIVATE ${PCL_INCLUDE_DIRS}
                                                              ${OpenCV_INCLUDE_DIRS})
  target_link_libraries(
    compare_detectors
    PRIVATE ${PROJECT_NAME}_tools
            opencv_core
            ${surface_matching_library}
            pcl_common
            pcl_features
            pcl_filters
            pcl_registration)
endif()
