// What preprocess makes of simulated scans.
#include <gtest/gtest.h>
TEST(ScanSurface, Placeholder) {}
