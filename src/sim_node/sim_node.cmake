# The node of the simulated cell; it alone joins the simulator and ROS.
add_executable(simulated_camera src/sim_node/simulated_camera_node.cpp)
target_link_libraries(simulated_camera ${PROJECT_NAME}_sim ${PROJECT_NAME}_ros ${catkin_LIBRARIES})
catkin_install_python(PROGRAMS src/sim_node/demo_client.py DESTINATION
                      ${CATKIN_PACKAGE_BIN_DESTINATION})
