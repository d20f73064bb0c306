#include <cstddef>

std::size_t count_devices();

int main() { return count_devices() > 0 ? 0 : 1; }
