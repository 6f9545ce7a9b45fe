// The bench's plays on two threads beside one.

#include <memory>

#include "bench/compare.hpp"
#include "bench/micro/benchmarks.hpp"
#include "bench/micro/pair.hpp"
#include "scenes/own_folders.hpp"

namespace seam::micro {

namespace {

Timed plays(const std::shared_ptr<const Scene>& scene, int jobs) {
  return timed_on_the_wall([=] {
    compare({*scene}, {all_joins.begin(), all_joins.end()}, jobs,
            [](int, int, const std::string&) {});
  });
}

}  // namespace

void add_jobs_benchmarks() {
  add_pair("scene line with all methods, 2 jobs / 1 job", no_bar, 10, [] {
    const auto scene =
        std::make_shared<const Scene>(Scene::read(own_folder() + "/scenes/line.yaml"));
    return Pair{plays(scene, 2), plays(scene, 1)};
  });
}

}  // namespace seam::micro
