# Files: meshes, clouds, depth images, models, YAML and JSON. No ROS.
find_package(assimp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgcodecs imgproc)
find_package(PCL REQUIRED COMPONENTS common io)
find_package(yaml-cpp REQUIRED)
find_package(ZLIB REQUIRED)

# VTK comes with PCL, which is built on it and finds it; its libraries have other names before VTK 9.
if(TARGET VTK::FiltersCore)
  set(vtk_prefix "VTK::")
elseif(TARGET vtkFiltersCore)
  set(vtk_prefix "vtk")
else()
  message(
    FATAL_ERROR
      "VTK is missing: install libvtk9-dev (libvtk7-dev on Ubuntu 20.04), or run scripts/setup")
endif()

set(io_libraries
    assimp::assimp
    nlohmann_json::nlohmann_json
    opencv_core
    opencv_imgcodecs
    pcl_common
    pcl_io
    ${vtk_prefix}CommonCore
    ${vtk_prefix}CommonDataModel
    ${vtk_prefix}CommonExecutionModel
    ${vtk_prefix}FiltersCore
    ZLIB::ZLIB)
set(io_dir "${CMAKE_CURRENT_LIST_DIR}")
add_library(
  ${PROJECT_NAME}_io
  ${io_dir}/cloud_check.cpp
  ${io_dir}/cloud_header.cpp
  ${io_dir}/cloud_io.cpp
  ${io_dir}/config_io.cpp
  ${io_dir}/depth_io.cpp
  ${io_dir}/file_bytes.cpp
  ${io_dir}/key_check.cpp
  ${io_dir}/length_unit.cpp
  ${io_dir}/mesh_io.cpp
  ${io_dir}/mesh_simplification.cpp
  ${io_dir}/model_io.cpp
  ${io_dir}/package_path.cpp
  ${io_dir}/part_io.cpp
  ${io_dir}/part_training.cpp
  ${io_dir}/ply_check.cpp
  ${io_dir}/png_check.cpp
  ${io_dir}/result_io.cpp
  ${io_dir}/rigid_pose.cpp
  ${io_dir}/stl_tidy.cpp
  ${io_dir}/surface.cpp
  ${io_dir}/yaml_map.cpp)
target_include_directories(${PROJECT_NAME}_io PUBLIC "${io_dir}/../../include" PRIVATE ${io_dir})
target_include_directories(${PROJECT_NAME}_io SYSTEM PRIVATE ${PCL_INCLUDE_DIRS}
                                                             ${OpenCV_INCLUDE_DIRS})
target_link_libraries(${PROJECT_NAME}_io PUBLIC ${PROJECT_NAME}_core yaml-cpp
                      PRIVATE ${io_libraries})
