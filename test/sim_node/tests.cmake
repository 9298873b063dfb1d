# Tests of what the simulator's node reads.
set(sim_node_tests test_sensor_params)
