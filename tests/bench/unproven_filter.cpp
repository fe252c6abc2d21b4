#include "tests/bench/unproven_filter.h"

#define VEX_FILTER_WITHOUT_PROOFS
#define filter_overlap filter_overlap_unproven
#include "engine/query/search/overlap_filter.cpp"  // NOLINT(bugprone-suspicious-include): the same source once more
