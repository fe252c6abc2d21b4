// Programs other than the fuzzer that contain counted blocks (block_counters.cpp): here nobody counts.
extern "C" void __sanitizer_cov_trace_pc() {}
