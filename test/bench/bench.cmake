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
