# The ROS layer, the nodelet and the node that loads it.
add_library(
  ${PROJECT_NAME}_ros
  src/ros/cloud_keeper.cpp
  src/ros/conversions.cpp
  src/ros/debug_clouds.cpp
  src/ros/detection_view.cpp
  src/ros/frame_lookup.cpp
  src/ros/markers.cpp
  src/ros/params.cpp
  src/ros/part_store.cpp
  src/ros/pose_server.cpp
  src/ros/request_steps.cpp
  src/ros/result_merging.cpp
  src/ros/result_publisher.cpp
  src/ros/server_diagnostics.cpp)
add_dependencies(${PROJECT_NAME}_ros ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_link_libraries(${PROJECT_NAME}_ros PUBLIC ${PROJECT_NAME}_io ${catkin_LIBRARIES})

add_library(${PROJECT_NAME}_nodelet src/nodelet/pose_detector_nodelet.cpp)
target_link_libraries(${PROJECT_NAME}_nodelet ${PROJECT_NAME}_ros)

add_executable(pose_detector_node src/nodelet/pose_detector_node.cpp)
target_link_libraries(pose_detector_node ${catkin_LIBRARIES})
