// For touched.sh: two arms' ticks, one after the other, and marks around them for valgrind's log.

#include <valgrind/valgrind.h>

#include "bench/micro/arms.hpp"

int main() {
  using namespace seam::micro;
  Arms arms(2, joint_movement(), seam::Join::dmp3);
  for (int i = 0; i < 5; ++i) arms.step();
  for (int arm = 0; arm < 2; ++arm) {
    VALGRIND_PRINTF("tick begins\n");
    arms.tick(arm);
    VALGRIND_PRINTF("tick ends\n");
  }
}
