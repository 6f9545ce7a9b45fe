#include <seam/arm.hpp>

int main() {}
