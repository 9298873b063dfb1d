# The node of the simulated cell; it alone joins the simulator and ROS. What it reads from YAML knows no ROS.
set(sim_node_dir "${CMAKE_CURRENT_LIST_DIR}")
add_library(${PROJECT_NAME}_sim_node STATIC ${sim_node_dir}/sensor_params.cpp)
target_include_directories(${PROJECT_NAME}_sim_node PUBLIC ${sim_node_dir})
target_link_libraries(${PROJECT_NAME}_sim_node PUBLIC ${PROJECT_NAME}_io ${PROJECT_NAME}_sim)

add_executable(simulated_camera ${sim_node_dir}/simulated_camera_node.cpp)
target_link_libraries(simulated_camera ${PROJECT_NAME}_sim_node ${PROJECT_NAME}_ros
                      ${catkin_LIBRARIES})
catkin_install_python(PROGRAMS src/sim_node/demo_client.py DESTINATION
                      ${CATKIN_PACKAGE_BIN_DESTINATION})
