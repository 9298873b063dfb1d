# Tests of the readers and writers, one file each; those of the second list read PPF_BIN_PICKING_DATA.
set(io_tests)
set(io_data_tests)
