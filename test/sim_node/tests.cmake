# Tests of what the simulator's node reads.
set(sim_node_tests test_cell_params test_sensor_params)
