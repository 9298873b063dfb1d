# Unit tests of the core, one file each; built by the catkin package and by the core alone.
set(core_tests
    test_ambiguity
    test_boundary
    test_dbscan
    test_detector
    test_detector_config
    test_mismatch
    test_neighbor_search
    test_paper_experiments
    test_parallel
    test_pca
    test_pose_clustering
    test_pose_errors
    test_ppf
    test_ppf_matcher
    test_ppf_model
    test_symmetry)
