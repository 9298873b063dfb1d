# Tests with a ROS master, one .test file each; limits and replay take longest.
set(integration_tests clock demo limits start statuses stream)
set(integration_data_tests replay)
