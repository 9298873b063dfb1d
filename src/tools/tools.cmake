# Command-line programs; no ROS master needed.
set(tools_dir "${CMAKE_CURRENT_LIST_DIR}")
add_library(
  ${PROJECT_NAME}_tools STATIC
  ${tools_dir}/bop_recall.cpp
  ${tools_dir}/evaluation_files.cpp
  ${tools_dir}/evaluation_report.cpp
  ${tools_dir}/evaluation_summary.cpp
  ${tools_dir}/pose_check.cpp
  ${tools_dir}/pose_drawing.cpp
  ${tools_dir}/pose_explanation.cpp
  ${tools_dir}/pose_judgement.cpp
  ${tools_dir}/tool_support.cpp)
target_include_directories(${PROJECT_NAME}_tools PUBLIC ${tools_dir})
target_link_libraries(${PROJECT_NAME}_tools PUBLIC ${PROJECT_NAME}_io nlohmann_json::nlohmann_json
                                                   opencv_core opencv_imgcodecs opencv_imgproc)

set(tools check_poses detect_poses evaluate_poses train_model)
foreach(name IN LISTS tools)
  add_executable(${name} ${tools_dir}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${PROJECT_NAME}_tools)
endforeach()
