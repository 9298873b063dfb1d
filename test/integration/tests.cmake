# Tests with a ROS master, one .test file each; limits and replay take longest.
set(integration_tests
    cell
    clock
    demo
    limits
    recordings
    start
    statuses
    stream)
set(integration_data_tests replay)
