# Tests of the readers and writers, one file each; those of the second list read
# PPF_BIN_PICKING_DATA.
set(io_tests
    test_cloud_io
    test_config_io
    test_depth_io
    test_file_bytes
    test_key_check
    test_mesh_io
    test_mesh_simplification
    test_model_io
    test_package_path
    test_part_io
    test_part_training
    test_result_io
    test_shipped_parts
    test_yaml_map)
set(io_data_tests test_mesh_io_data)
