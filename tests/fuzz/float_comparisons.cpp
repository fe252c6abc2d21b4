// g++ tells of comparisons of floating-point numbers, too (-fsanitize-coverage=trace-cmp), of which libFuzzer and the
// sanitizers' libraries know nothing.
extern "C" void __sanitizer_cov_trace_cmpf(float, float) {}
extern "C" void __sanitizer_cov_trace_cmpd(double, double) {}
