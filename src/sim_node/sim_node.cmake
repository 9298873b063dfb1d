# The simulated cell's node, recorder and robot; they alone join the simulator and ROS. simulate_scene, what is read from
# YAML and what is written for files know no ROS.
set(sim_node_dir "${CMAKE_CURRENT_LIST_DIR}")
add_library(
  ${PROJECT_NAME}_sim_node STATIC ${sim_node_dir}/cell_params.cpp ${sim_node_dir}/scene_files.cpp
                                  ${sim_node_dir}/sensor_params.cpp)
target_include_directories(${PROJECT_NAME}_sim_node PUBLIC ${sim_node_dir})
target_link_libraries(
  ${PROJECT_NAME}_sim_node
  PUBLIC ${PROJECT_NAME}_io ${PROJECT_NAME}_sim nlohmann_json::nlohmann_json opencv_core
         opencv_imgcodecs opencv_imgproc)

add_executable(simulated_cell ${sim_node_dir}/cell_messages.cpp
                              ${sim_node_dir}/simulated_cell_node.cpp)
add_dependencies(simulated_cell ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_link_libraries(simulated_cell ${PROJECT_NAME}_sim_node ${PROJECT_NAME}_ros
                      ${catkin_LIBRARIES})

add_executable(record_cell ${sim_node_dir}/cell_messages.cpp ${sim_node_dir}/record_cell.cpp)
add_dependencies(record_cell ${catkin_EXPORTED_TARGETS})
target_link_libraries(record_cell ${PROJECT_NAME}_sim_node ${PROJECT_NAME}_tools
                      ${catkin_LIBRARIES})

add_executable(simulate_scene ${sim_node_dir}/simulate_scene.cpp)
target_link_libraries(simulate_scene ${PROJECT_NAME}_sim_node ${PROJECT_NAME}_tools)

catkin_install_python(PROGRAMS src/sim_node/robot_client.py DESTINATION
                      ${CATKIN_PACKAGE_BIN_DESTINATION})
