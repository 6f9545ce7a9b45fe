#include <seam/bullet.hpp>

int main() {}
