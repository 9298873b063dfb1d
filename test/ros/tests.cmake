# Unit tests of the ROS layer, one file each; they need no master.
set(ros_tests
    test_cloud_keeper
    test_conversions
    test_conversions_pose
    test_debug_clouds
    test_detection_view
    test_frame_lookup
    test_markers
    test_params
    test_request_steps
    test_result_merging)
