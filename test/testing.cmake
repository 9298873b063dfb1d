# One call adds one test. DATA marks a test that reads the folder of PPF_BIN_PICKING_DATA:
# scripts/test leaves it out, by name, where that folder is absent.
#
#   add_unit_test(FOLDER NAME LIBRARY... [DATA])   test/FOLDER/NAME.cpp
#   add_script_test(NAME)                          test/scripts/NAME.py
#   add_integration_test(NAME [DATA])              test/integration/NAME.test

function(add_unit_test folder name)
  cmake_parse_arguments(arg "DATA" "" "" ${ARGN})
  catkin_add_gtest(${name} test/${folder}/${name}.cpp)
  target_include_directories(${name} PRIVATE test)
  target_link_libraries(${name} ${arg_UNPARSED_ARGUMENTS} gtest_main)
  if(arg_DATA)
    set_tests_properties(_ctest_${PROJECT_NAME}_gtest_${name} PROPERTIES LABELS data)
  endif()
endfunction()

function(add_script_test name)
  catkin_add_nosetests(test/scripts/${name}.py)
endfunction()

function(add_integration_test name)
  cmake_parse_arguments(arg "DATA" "" "" ${ARGN})
  add_rostest(test/integration/${name}.test)
  if(arg_DATA)
    set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_integration_${name}.test
                         PROPERTIES LABELS data)
  endif()
endfunction()
