# Programs that measure. They are built with the tests, so that they stay alive, and run by hand.
add_executable(measure_camera EXCLUDE_FROM_ALL test/bench/measure_camera.cpp)
target_include_directories(measure_camera PRIVATE test)
target_link_libraries(measure_camera ${PROJECT_NAME}_io ${PROJECT_NAME}_sim opencv_core
                      opencv_imgcodecs)
add_dependencies(tests measure_camera)

add_executable(measure_piles EXCLUDE_FROM_ALL test/bench/measure_piles.cpp)
target_include_directories(measure_piles PRIVATE test)
target_link_libraries(measure_piles PRIVATE ${PROJECT_NAME}_sim ${PROJECT_NAME}_io)
add_dependencies(tests measure_piles)
