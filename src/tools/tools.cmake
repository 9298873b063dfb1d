# Command-line programs; no ROS master needed.
set(tools_dir "${CMAKE_CURRENT_LIST_DIR}")
add_library(${PROJECT_NAME}_tools STATIC ${tools_dir}/tool_support.cpp)
target_link_libraries(${PROJECT_NAME}_tools PUBLIC ${PROJECT_NAME}_io)

set(tools detect_poses train_model)
foreach(name IN LISTS tools)
  add_executable(${name} ${tools_dir}/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${PROJECT_NAME}_tools)
endforeach()
